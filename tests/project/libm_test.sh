#!/bin/sh
# libm_test.sh LIBRARY COMPILER: results may not depend on a machine's libm, so the library calls of it only what
# IEEE 754 fixes to the last bit, and the control of the floating-point mode.
set -eu
library=$1 compiler=$2

exact='(sqrt|floor|ceil|trunc|round|nearbyint|rint|fabs|copysign)[fl]?'
mode='fe[a-z]+'
libm=$("$compiler" -print-file-name=libm.so.6)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
nm -D --defined-only "$libm" | awk '{ sub(/@.*/, "", $NF); print $NF }' | sort -u >"$folder/libm"
nm --undefined-only "$library" | awk '{ print $NF }' | sort -u >"$folder/imports"
[ "$(wc -l <"$folder/libm")" -gt 500 ] || { echo "no names found in $libm" >&2; exit 1; }
[ "$(wc -l <"$folder/imports")" -gt 50 ] || { echo "no names found in $library" >&2; exit 1; }

if comm -12 "$folder/libm" "$folder/imports" | grep -vxE "$exact|$mode"; then
  echo "the library imports the functions above from libm; src/math/elementary.h has our own" >&2
  exit 1
fi
