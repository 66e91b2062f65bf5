#!/bin/sh
# preset_test.sh PRESET [build-only]: configures and builds a preset and runs its quick tests.
set -eu
preset=$1 only=${2-}

cmake --preset "$preset" >/dev/null
log=$(mktemp)
trap 'rm -f "$log"' EXIT
cmake --build --preset "$preset" >"$log" || { cat "$log"; exit 1; }
[ -z "$only" ] || exit 0

# Slow tests and tests of the project as a whole run once, in the release build, and so do the generators', which
# make every scene a dozen times.
TSAN_OPTIONS=halt_on_error=1 ctest --test-dir "build/$preset" --label-exclude 'slow|project|docs' \
  --exclude-regex GeneratorTest --output-on-failure --parallel "$(nproc)"
