#!/bin/sh
# Reads a picture with layers in Blender's compositor, compares every layer with what OpenEXR's own library reads, and
# swaps the sky as docs/layers.md says. Not a part of scripts/test.sh, because it fetches Blender (scripts/fetch-blender.sh).
set -eu
cd "$(dirname "$0")/.."

python=$(scripts/fetch-blender.sh)
scripts/fetch-readers.sh
target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')

cargo build -p viewer
"$python" tests/blender/layers.py --viewer "$target/debug/viewer" --python "$target/readers/venv/bin/python" \
    --work "$target/blender/layers"
