#!/bin/sh
# Checks that the libraries compile for a browser (wasm32-unknown-unknown).
set -eu
cd "$(dirname "$0")"

exec ./wasm-cargo.sh check --lib -p lensbake-core -p lensbake-tables -p lensbake-render -p lensbake-interactive
