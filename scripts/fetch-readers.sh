#!/bin/sh
# Fetches the packages with which tests/tests/readers reads OpenEXR files into the target folder: OpenEXR's own
# for Python, and three.js for Node. Does nothing if they are there.
set -eu
cd "$(dirname "$0")/.."

target=$(cargo metadata --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')
folder="$target/readers"
# Written last, so that an interrupted fetch is repeated.
stamp="$folder/fetched"
wanted=$(cat tests/readers/requirements.txt tests/readers/package.json)

if [ "$(cat "$stamp" 2>/dev/null)" = "$wanted" ] && "$folder/venv/bin/python" -c "import OpenEXR" 2>/dev/null; then
    exit 0
fi
mkdir -p "$folder"
python3 -m venv --clear "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check -r tests/readers/requirements.txt
cp tests/readers/package.json "$folder"
npm install --prefix "$folder" --no-package-lock --no-audit --no-fund --loglevel error
printf '%s\n' "$wanted" >"$stamp"
