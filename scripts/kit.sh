#!/bin/sh
# Writes the generated files of kit/ again: those that kit/exports.txt lists.
set -eu
cd "$(dirname "$0")/.."

cargo build --release -p bake
bake=$(pwd)/${CARGO_TARGET_DIR:-target}/release/bake
cd kit
grep -v '^#' exports.txt | while read -r options; do
    # shellcheck disable=SC2086 # one word an option
    "$bake" export $options
done
