"""What the tests share."""

import os
import subprocess

import numpy as np
import pytest

import facemap


@pytest.fixture(scope="session")
def bust() -> facemap.Scene:
    return facemap.generate("bust")


@pytest.fixture
def floor() -> facemap.Scene:
    """A square of two triangles at y = 0, from -1 to 1."""
    return facemap.Scene([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]], [[0, 2, 1], [0, 3, 2]])


@pytest.fixture
def random(request) -> np.random.Generator:
    """A generator whose seed a failing test prints."""
    seed = int(os.environ.get("FACEMAP_SEED", np.random.SeedSequence().entropy % 2**32))
    print(f"FACEMAP_SEED={seed}")
    return np.random.default_rng(seed)


@pytest.fixture
def program():
    """Runs `facemap` with arguments."""
    path = os.environ.get("FACEMAP_PROGRAM", "")
    if not os.path.exists(path):
        pytest.skip("the program is not built")

    def run(*arguments):
        return subprocess.run([path, *map(str, arguments)], check=True, capture_output=True, text=True).stdout

    return run
