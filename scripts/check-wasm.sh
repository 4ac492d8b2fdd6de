#!/bin/sh
# Checks that the libraries compile for a browser (wasm32-unknown-unknown, WebGPU and WebGL2). Where rustup cannot add this
# target, uses Debian's Rust for the web and compiles the standard library with it.
set -eu
cd "$(dirname "$0")/.."

target=wasm32-unknown-unknown
packages="-p lensbake-core -p lensbake-tables -p lensbake-render"

has_target() {
    [ -d "$(rustc --print sysroot)/lib/rustlib/$target/lib" ]
}

if ! has_target && command -v rustup >/dev/null; then
    timeout 300 rustup target add "$target" || true
fi
if has_target; then
    # shellcheck disable=SC2086 # one word per package
    exec cargo check --target "$target" --lib $packages
fi

installed() {
    dpkg -s rustc-web cargo-web rust-web-src lld-22 >/dev/null 2>&1
}

if ! installed; then
    if ! command -v apt-get >/dev/null; then
        echo "check-wasm.sh: install Rust's target $target, for example by rustup target add $target" >&2
        exit 2
    fi
    as_root=""
    [ "$(id -u)" = 0 ] || as_root=sudo
    $as_root apt-get update
    $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends rustc-web cargo-web rust-web-src lld-22
fi
# A folder of its own: two versions of the compiler would recompile each other's files.
export CARGO_TARGET_DIR="${CARGO_TARGET_DIR:-target}/rust-web" RUSTC=/usr/bin/rustc RUSTC_BOOTSTRAP=1
# shellcheck disable=SC2086
exec /usr/bin/cargo check -Zbuild-std=std,panic_abort --target "$target" --lib $packages
