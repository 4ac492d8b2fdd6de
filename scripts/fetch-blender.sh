#!/bin/sh
# Fetches Blender as a Python package (0.4 GB, for Python 3.11) to the target folder, and prints the path of its Python.
# Does nothing else if it is there.
set -eu
cd "$(dirname "$0")/.."

target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
folder="$target/blender"
python="$folder/venv/bin/python"
# Written last, so that an interrupted fetch is repeated.
stamp="$folder/fetched"
wanted="bpy==5.0.1"

if [ "$(cat "$stamp" 2>/dev/null)" != "$wanted" ] || ! "$python" -c "import bpy" 2>/dev/null; then
    if ! command -v python3.11 >/dev/null; then
        echo "fetch-blender.sh: needs python3.11, the version that $wanted is made for" >&2
        exit 2
    fi
    mkdir -p "$folder"
    python3.11 -m venv --clear "$folder/venv"
    "$python" -m pip install --quiet --disable-pip-version-check "$wanted"
    printf '%s\n' "$wanted" >"$stamp"
fi
printf '%s\n' "$python"
