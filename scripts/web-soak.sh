#!/bin/sh
# web-soak.sh [MINUTES [BACKEND …]]
# Uses the web page for MINUTES (10) each with webgpu and with webgl: no error, and memory stays flat. Not in .ci/run,
# because it takes long. Needs what scripts/test.sh installs.
set -eu
cd "$(dirname "$0")/.."

minutes=${1:-10}
[ $# = 0 ] || shift
[ $# -gt 0 ] || set -- webgpu webgl
readers="${CARGO_TARGET_DIR:-target}/readers"
if ! [ -d "$readers/node_modules" ] || ! [ -d web/dist ]; then
    echo "web-soak.sh: run scripts/test.sh once, which installs a browser and builds the page" >&2
    exit 2
fi
cp tests/browser/*.mjs web/tests/*.mjs "$readers"
for backend; do
    echo "$backend"
    xvfb-run -a -s "-screen 0 1600x1200x24" node "$readers/soak.mjs" web/dist "$minutes" "?backend=$backend"
done
