#!/bin/sh
# Draws with Blender's Cycles through kit/blender/lensbake.osl, and compares every pixel with the closed form and two
# pictures with the viewer's. Not a part of scripts/test.sh, because it takes five minutes and fetches Blender as a
# Python package (0.4 GB, for Python 3.11) to the target folder. With --picture it also draws kit/blender/picture.png.
set -eu
cd "$(dirname "$0")/.."

case "${1:-}" in
    "" | --picture) ;;
    *) echo "usage: scripts/kit-blender.sh [--picture]" >&2 && exit 2 ;;
esac
[ "${1:-}" = --picture ] && set -- --picture kit/blender/picture.png

target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
folder="$target/blender"
python="$folder/venv/bin/python"
# Written last, so that an interrupted fetch is repeated.
stamp="$folder/fetched"
wanted="bpy==5.0.1"

if [ "$(cat "$stamp" 2>/dev/null)" != "$wanted" ] || ! "$python" -c "import bpy" 2>/dev/null; then
    if ! command -v python3.11 >/dev/null; then
        echo "kit-blender.sh: needs python3.11, the version that $wanted is made for" >&2
        exit 2
    fi
    mkdir -p "$folder"
    python3.11 -m venv --clear "$folder/venv"
    "$python" -m pip install --quiet --disable-pip-version-check "$wanted"
    printf '%s\n' "$wanted" >"$stamp"
fi

cargo build --release -p bake -p viewer
"$python" kit/blender/tests/test_lensbake.py --bake "$target/release/bake" --viewer "$target/release/viewer" \
    --work "$folder/work" "$@"
