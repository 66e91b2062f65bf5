#!/bin/sh
# install_test.sh CMAKE BUILD SOURCE COMPILER: installs BUILD under an empty prefix and uses it from there alone.
set -eu
cmake=$1 build=$2 source=$3 compiler=$4

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$cmake" --install "$build" --prefix "$folder/prefix" >/dev/null
# The prefix is moved: nothing installed may name the place it was first put to.
mv "$folder/prefix" "$folder/moved"
if grep -rlE "$source|$build|$folder/prefix" "$folder/moved/lib" --include='*.cmake'; then
  echo 'the package files above name folders of this machine' >&2
  exit 1
fi

"$cmake" -S "$source/tests/install/project" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_PREFIX_PATH="$folder/moved" -DMINIMAL_SOURCE="$source/examples/minimal.cpp" >/dev/null
"$cmake" --build "$folder/build"
output=$("$folder/build/minimal")
echo "$output"
expected='face 0 at distance 5 is lit,
the point below it is dark'
[ "$output" = "$expected" ] || { echo "expected: $expected" >&2; exit 1; }

lines=$(wc -l <"$source/examples/minimal.cpp")
[ "$lines" -lt 40 ] || { echo "examples/minimal.cpp has $lines lines: 39 are enough" >&2; exit 1; }
"$folder/moved/bin/facemap" --version
