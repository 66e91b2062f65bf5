"""Every example runs, small, and writes its picture."""

import os
import pathlib
import subprocess
import sys

import pytest

EXAMPLES = pathlib.Path(__file__).parents[2] / "examples" / "python"
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.py") if path.stem != "shapes")


def test_there_are_examples():
    assert len(NAMES) >= 6


@pytest.mark.parametrize("name", NAMES)
def test_example(name, tmp_path):
    environment = dict(os.environ, FACEMAP_EXAMPLE_SCALE="0.1", FACEMAP_EXAMPLE_FOLDER=str(tmp_path))
    subprocess.run([sys.executable, EXAMPLES / f"{name}.py"], check=True, env=environment)
    assert (tmp_path / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert (EXAMPLES / f"{name}.py").read_text().startswith("# %% [markdown]\n# # ")
