#!/bin/sh
# wheel_test.sh PYTHON SOURCE: makes the wheel, offline, installs it into a fresh virtual environment that sees the
# system's NumPy, and runs README's Python example there.
set -eu
python=$1 source=$2
unset PYTHONPATH

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# As strict as the other builds: what the compiler's cache has of them is used.
cd "$source"
for stale in build/wheel/python-build/lib*/facemap; do
  [ ! -d "$stale" ] || touch "$stale/no_more.py"
done
CMAKE_ARGS=-DFACEMAP_WERROR=ON "$python" -m pip wheel . --no-build-isolation --no-deps --no-index --quiet \
  --wheel-dir "$folder"

"$python" -m venv --system-site-packages "$folder/venv"
"$folder/venv/bin/python" -m pip install --no-index --no-deps --quiet "$folder"/facemap-*.whl
cd "$folder"
awk '/^```python$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$source/README.md" >example.py
[ -s example.py ] || { echo "README.md has no Python example" >&2; exit 1; }
cat example.py
venv/bin/python example.py
venv/bin/python - <<'END'
import pathlib, facemap
folder = pathlib.Path(facemap.__file__).parent
assert "venv" in folder.parts, folder
for name in ("py.typed", "_facemap.pyi"):
    assert (folder / name).exists(), name
assert not (folder / "no_more.py").exists()
END
