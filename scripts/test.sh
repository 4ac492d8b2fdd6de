#!/bin/sh
# Runs every test. Where there is no Vulkan driver, installs software Vulkan first (Debian, Ubuntu).
set -eu
cd "$(dirname "$0")/.."

has_vulkan_driver() {
    for folder in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d; do
        ls "$folder"/*.json >/dev/null 2>&1 && return 0
    done
    [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ]
}

has_vulkan_loader() {
    /sbin/ldconfig -p 2>/dev/null | grep -q libvulkan.so.1
}

if [ "$(uname)" = Linux ] && ! { has_vulkan_driver && has_vulkan_loader; }; then
    if ! command -v apt-get >/dev/null; then
        echo "test.sh: no Vulkan driver: install one, or run" \
            "cargo test --workspace --features lensbake-tests/no-gpu,viewer/no-gpu" >&2
        exit 2
    fi
    as_root=""
    [ "$(id -u)" = 0 ] || as_root=sudo
    $as_root apt-get update
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
        mesa-vulkan-drivers libvulkan1
fi

cargo test --workspace
