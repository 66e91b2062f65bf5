#!/bin/sh
# preset_test.sh PRESET TARGETS [LABELS]: configures a preset, builds these targets of it, and runs its quick tests
# that have one of the labels (a regular expression).
set -eu
preset=$1 targets=$2 labels=${3-}

cmake --preset "$preset" >/dev/null
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# shellcheck disable=SC2086 # a list of targets
cmake --build --preset "$preset" --target $targets >"$log" || { cat "$log"; exit 1; }
[ -n "$labels" ] || exit 0

# The generators' tests make every scene a dozen times: minutes without optimization, and the same in each build.
# Random questions are asked in full numbers by the release build.
FACEMAP_QUERIES=20000 TSAN_OPTIONS=halt_on_error=1 ctest --test-dir "build/$preset" --label-regex "$labels" --label-exclude slow \
  --exclude-regex GeneratorTest --output-on-failure --parallel "$(nproc)"
