#!/bin/sh
# Builds the web page: web/dist, to be served by any static host.
set -eu
cd "$(dirname "$0")/.."

scripts/wasm-cargo.sh build --profile web -p lensbake-web
wasm="${CARGO_TARGET_DIR:-target}/wasm/wasm32-unknown-unknown/web/lensbake_web.wasm"

# Replaced only when everything is there.
new=web/dist.new
rm -rf "$new"
mkdir -p "$new"
cargo run --quiet -p lensbake-bindgen -- "$wasm" "$new"
cp web/page/* "$new"
cp render/assets/hipparcos.stars "$new"
rm -rf web/dist
mv "$new" web/dist
echo "built web/dist; to see it: python3 -m http.server -d web/dist, then http://localhost:8000"
