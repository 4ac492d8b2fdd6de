#!/bin/sh
# Uses the web page for MINUTES (10) each with WebGPU and with WebGL2: no error, and memory stays flat. Not in .ci/run,
# because it takes long. Needs what scripts/test.sh installs.
set -eu
cd "$(dirname "$0")/.."

minutes=${1:-10}
readers="${CARGO_TARGET_DIR:-target}/readers"
if ! [ -d "$readers/node_modules" ] || ! [ -d web/dist ]; then
    echo "web-soak.sh: run scripts/test.sh once, which installs a browser and builds the page" >&2
    exit 2
fi
cp tests/browser/*.mjs web/tests/*.mjs "$readers"
for backend in webgpu webgl; do
    echo "$backend"
    xvfb-run -a -s "-screen 0 1600x1200x24" node "$readers/soak.mjs" web/dist "$minutes" "?backend=$backend"
done
