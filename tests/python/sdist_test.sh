#!/bin/sh
# sdist_test.sh PYTHON SOURCE: a source distribution holds what CMake needs for a wheel, and an editable installation
# is refused with the reason.
set -eu
python=$1 source=$2
unset PYTHONPATH

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$source"
"$python" setup.py --quiet sdist --dist-dir "$folder"
tar -xzf "$folder"/facemap-*.tar.gz -C "$folder"
cd "$folder"/facemap-*/
for part in include src cmake python; do
  (cd "$source" && git ls-files "$part") | while read -r file; do
    [ -e "$file" ] || { echo "the source distribution has no $file" >&2; exit 1; }
  done
done
cmake -S . -B "$folder/build" -DFACEMAP_BUILD_PYTHON=ON -DFACEMAP_BUILD_TESTS=OFF -DFACEMAP_BUILD_APPS=OFF \
  -DPython3_EXECUTABLE="$python" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }

if "$python" -m pip install --no-index --no-deps --no-build-isolation --prefix "$folder/prefix" --editable . \
  >"$folder/log" 2>&1; then
  echo "an editable installation is not refused" >&2
  exit 1
fi
grep -q "cannot be installed editable" "$folder/log" || { cat "$folder/log" >&2; exit 1; }
