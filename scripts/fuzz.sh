#!/bin/sh
# Fuzzes everything that reads untrusted input: fuzz.sh [SECONDS [TARGET…]] runs each target (default: all) for
# SECONDS (default: 60), starting from its seeds. Ends with 1 if a target finds something; the findings are in
# fuzz/artifacts.
set -eu
cd "$(dirname "$0")/../fuzz"

seconds=${1:-60}
[ $# -eq 0 ] || shift

command -v cargo-fuzz >/dev/null || cargo install cargo-fuzz --locked

# The sanitizer needs a nightly compiler; with this the stable one accepts its flags too.
export RUSTC_BOOTSTRAP=1
cargo fuzz build

targets=${*:-$(cargo fuzz list)}
log=$(mktemp -d)
trap 'rm -r "$log"' EXIT
touch "$log/start"
status=0
for target in $targets; do
    mkdir -p "corpus/$target" "artifacts/$target"
    dictionary=
    [ ! -f "$target.dict" ] || dictionary=-dict=$target.dict
    # shellcheck disable=SC2086 # without a dictionary there must be no argument
    if ! cargo fuzz run "$target" "corpus/$target" "seeds/$target" -- -max_total_time="$seconds" \
        -rss_limit_mb=2048 -malloc_limit_mb=1024 -timeout=20 -max_len=16384 -print_final_stats=1 \
        $dictionary >"$log/$target" 2>&1; then
        status=1
        tail -n 60 "$log/$target"
    fi
done

printf '%-16s %12s %10s %9s\n' target executions features findings
for target in $targets; do
    executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log/$target")
    features=$(sed -n 's/.* ft: \([0-9]*\).*/\1/p' "$log/$target" | tail -n 1)
    findings=$(find "artifacts/$target" -type f -newer "$log/start" | wc -l)
    printf '%-16s %12s %10s %9s\n' "$target" "${executions:--}" "${features:--}" "$findings"
done
exit $status
