#!/bin/sh
# Runs kit/godot/lensbake.gdshaderinc in Godot 3 with software OpenGL: run.sh REPO OUTDIR [RAYS.bin OUT.bin]
#
# Draws OUTDIR/picture.png. With RAYS.bin, records of 8 little-endian 32-bit floats (r, dx, dy, dz, hx, hy, hz, 0), it
# writes the directions of the rays to OUT.bin, 3 floats each, zeros if captured. Needs godot3 (3.2) and xvfb-run.
#
# Godot 3 has neither #include nor structures: the text goes into the shaders, and the structure becomes a vec2. All
# arithmetic stays as it is.
set -eu
if [ $# -ne 2 ] && [ $# -ne 4 ]; then
    echo "usage: $0 REPO OUTDIR [RAYS.bin OUT.bin]" >&2
    exit 2
fi
here=$(cd "$(dirname "$0")" && pwd)
kit=$1/kit/godot
project=$2/project
for program in godot3 xvfb-run; do
    if ! command -v $program >/dev/null; then
        echo "$program is not installed" >&2
        exit 1
    fi
done

rm -rf "$project" "$2/home"
# Godot creates its folder for logs before the one above it, and reports the error.
mkdir -p "$project" "$2/home/godot/app_userdata/lensbake"
cp "$here/project.godot" "$here/main.tscn" "$here/main.gd" "$project"
cp "$kit/lensbake.exr" "$project"
sed -e '/^struct lensbake_ShadowEdge {/,/^};/d' \
    -e 's/lensbake_ShadowEdge/vec2/g' -e 's/\.tan_half/.x/g' -e 's/\.log_weight/.y/g' \
    "$kit/lensbake.gdshaderinc" >"$project/lensbake.txt"
if grep -n '^struct' "$project/lensbake.txt"; then
    echo "a structure that Godot 3 lacks is left" >&2
    exit 1
fi
sed -n '/^vec3 procedural_sky(/,/^}/p' "$kit/lensbake_sky.gdshader" >"$project/sky.txt"
for shader in rays picture; do
    sed -e "/^\/\/ lensbake\$/r $project/lensbake.txt" -e "/^\/\/ procedural_sky\$/r $project/sky.txt" \
        "$here/$shader.shader" >"$project/$shader.shader"
done
if [ $# -eq 4 ]; then
    cp "$3" "$project/rays.bin"
fi

status=0
home=$(cd "$2/home" && pwd)
HOME=$home XDG_DATA_HOME=$home XDG_CONFIG_HOME=$home XDG_CACHE_HOME=$home LANG=en_US.UTF-8 LIBGL_ALWAYS_SOFTWARE=1 \
    timeout 300 xvfb-run -a -s "-screen 0 1280x1024x24" \
    godot3 --path "$project" --video-driver GLES3 --audio-driver Dummy >"$project/log.txt" 2>&1 || status=$?
cat "$project/log.txt"
# Godot goes on after a shader does not compile, and ends with status 0.
if [ $status -ne 0 ] || grep -q 'ERROR' "$project/log.txt"; then
    echo "Godot failed, status $status" >&2
    exit 1
fi
cp "$project/picture.png" "$2/picture.png"
if [ $# -eq 4 ]; then
    cp "$project/out.bin" "$4"
fi
