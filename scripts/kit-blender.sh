#!/bin/sh
# Draws with Blender's Cycles through kit/blender/lensbake.osl, and compares every pixel with the closed form and two
# pictures with the viewer's. Not a part of scripts/test.sh, because it takes five minutes and fetches Blender
# (scripts/fetch-blender.sh). With --picture it also draws kit/blender/picture.png.
set -eu
cd "$(dirname "$0")/.."

case "${1:-}" in
    "" | --picture) ;;
    *) echo "usage: scripts/kit-blender.sh [--picture]" >&2 && exit 2 ;;
esac
[ "${1:-}" = --picture ] && set -- --picture kit/blender/picture.png

python=$(scripts/fetch-blender.sh)
target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')

cargo build --release -p bake -p viewer
"$python" kit/blender/tests/test_lensbake.py --bake "$target/release/bake" --viewer "$target/release/viewer" \
    --work "$target/blender/work" "$@"
