#!/bin/sh
# Runs cargo for a browser (wasm32-unknown-unknown), with these arguments; its target folder is target/wasm. Where
# rustup cannot add this target, installs Debian's Rust for the web and compiles the standard library with it.
set -eu
cd "$(dirname "$0")/.."

target=wasm32-unknown-unknown
command=$1
shift
export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-target}/wasm"

has_target() {
    command -v rustc >/dev/null && [ -d "$(rustc --print sysroot)/lib/rustlib/$target/lib" ]
}

if ! has_target && command -v rustup >/dev/null; then
    timeout 300 rustup target add "$target" || true
fi
if has_target; then
    exec cargo "$command" --target "$target" "$@"
fi

installed() {
    dpkg -s rustc-web cargo-web rust-web-src lld-22 >/dev/null 2>&1
}

if ! installed; then
    if ! command -v apt-get >/dev/null; then
        echo "wasm-cargo.sh: install Rust's target $target, for example by rustup target add $target" >&2
        exit 2
    fi
    as_root=""
    [ "$(id -u)" = 0 ] || as_root=sudo
    $as_root apt-get update
    $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src lld-22
fi
export RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1
exec /usr/bin/cargo "$command" -Zbuild-std=std,panic_abort --target "$target" "$@"
