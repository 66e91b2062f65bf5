#!/bin/sh
# installed_test.sh PYTHON CMAKE BUILD PYTHON_DIR: what cmake --install puts below a prefix is imported from there.
set -eu
python=$1 cmake=$2 build=$3 python_dir=$4

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$cmake" --install "$build" --component python --prefix "$folder/prefix" >/dev/null
cd "$folder"
PYTHONPATH=$folder/prefix/$python_dir "$python" - <<'END'
import pathlib, facemap
folder = pathlib.Path(facemap.__file__).parent
assert "prefix" in folder.parts, folder
for name in ("py.typed", "_facemap.pyi", "uses/__init__.py"):
    assert (folder / name).exists(), name
assert facemap.View(facemap.generate("bust"), (0, 1, 3)).visible([0, 1, 3])
END
