#!/bin/sh
# Runs every test. On Debian and Ubuntu, first installs what is missing: software Vulkan if there is no driver, a
# virtual screen for the window's tests, other readers of OpenEXR files, and a browser. Builds the web page.
set -eu
cd "$(dirname "$0")/.."

has_vulkan_driver() {
    for folder in /usr/share/vulkan/icd.d /etc/vulkan/icd.d /usr/local/share/vulkan/icd.d; do
        ls "$folder"/*.json >/dev/null 2>&1 && return 0
    done
    [ -n "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ]
}

has_library() {
    /sbin/ldconfig -p 2>/dev/null | grep -q "$1"
}

has_program() {
    command -v "$1" >/dev/null
}

has_header() {
    echo "#include <$1>" | g++ -E -x c++ - >/dev/null 2>&1
}

has_python_module() {
    python3 -c "import $1" 2>/dev/null
}

without="cargo test --workspace --features"
without="$without lensbake-render/no-gpu,lensbake-tests/no-gpu,lensbake-tests/no-readers,viewer/no-gpu,viewer/no-window,viewer/no-web"

missing=""
if [ "$(uname)" = Linux ]; then
    has_vulkan_driver || missing="$missing mesa-vulkan-drivers"
    has_library libvulkan.so.1 || missing="$missing libvulkan1"
    has_program Xvfb || missing="$missing xvfb"
    has_program xdotool || missing="$missing xdotool"
    has_library libX11.so.6 || missing="$missing libx11-6"
    has_library libX11-xcb.so.1 || missing="$missing libx11-xcb1"
    has_library libXcursor.so.1 || missing="$missing libxcursor1"
    has_library libXi.so.6 || missing="$missing libxi6"
    has_library libXrandr.so.2 || missing="$missing libxrandr2"
    has_library libxkbcommon.so.0 || missing="$missing libxkbcommon0"
    has_library libxkbcommon-x11.so.0 || missing="$missing libxkbcommon-x11-0"
    has_program g++ || missing="$missing g++"
    has_header tinyexr.h || missing="$missing libtinyexr-dev"
    has_program python3 || missing="$missing python3"
    has_python_module ensurepip || missing="$missing python3-venv"
    has_program node || missing="$missing nodejs"
    has_program npm || missing="$missing npm"
    has_program gcc || missing="$missing gcc"
    has_program glslangValidator || missing="$missing glslang-tools"
    has_program chromium || missing="$missing chromium"
    has_program godot3 || missing="$missing godot3"
    has_program xvfb-run || missing="$missing xvfb"
    has_program xauth || missing="$missing xauth"
fi

if [ -n "$missing" ]; then
    if ! has_program apt-get; then
        echo "test.sh: install what these Debian packages hold:$missing; or run $without" >&2
        exit 2
    fi
    as_root=""
    [ "$(id -u)" = 0 ] || as_root=sudo
    $as_root apt-get update
    # shellcheck disable=SC2086 # one word per package
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends $missing
fi

if [ "$(uname)" = Linux ]; then
    scripts/fetch-readers.sh || {
        echo "test.sh: what reads OpenEXR files cannot be fetched; or run $without" >&2
        exit 2
    }
    scripts/web.sh
fi

cargo test --workspace
