"""docs/python.md is made of the docstrings, and what it, README and the docstrings show works."""

import doctest
import inspect
import pathlib
import re
import subprocess
import sys
import types

import numpy as np
import pytest

import facemap

SOURCE = pathlib.Path(__file__).parents[2]
PAGES = [SOURCE / "README.md", SOURCE / "docs" / "python.md"]


def test_the_reference_is_made_of_the_docstrings():
    subprocess.run([sys.executable, SOURCE / "scripts" / "python-docs", "check"], check=True)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_blocks_of_a_page_work(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```$", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    assert blocks
    names = {}
    for block in blocks:
        exec(compile(block, page.name, "exec"), names)


def test_the_pictures_of_the_page_are_there():
    pictures = re.findall(r"!\[.*\]\((.*?)\)", PAGES[1].read_text())
    assert len(pictures) >= 6 and all((SOURCE / "docs" / picture).exists() for picture in pictures)


def documented():
    """Every public function, class and method that has examples."""
    for name in facemap.__all__:
        thing = getattr(facemap, name)
        members = [(name, thing)]
        if inspect.isclass(thing):
            members += [(f"{name}.{key}", getattr(member, "__func__", member)) for key, member in vars(thing).items()
                        if not key.startswith("_") and not isinstance(member, property)]
        yield from ((key, inspect.getdoc(member)) for key, member in members if ">>>" in (inspect.getdoc(member) or ""))


def a_scene() -> facemap.Scene:
    """A tetrahedron three times over, which hides nothing here, and then a wall at z = 3."""
    near = facemap.Scene([[8, 0, 0], [9, 0, 0], [8, 1, 0], [8, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    scene = facemap.Scene(near.vertices, near.faces)
    for i in (1, 2):
        scene.add(near, [[1, 0, 0, i], [0, 1, 0, 5 * i], [0, 0, 1, 0], [0, 0, 0, 1]])
    return scene.add(facemap.Scene([[-5, -5, 3], [5, -5, 3], [5, 5, 3], [-5, 5, 3]], [[0, 2, 3], [0, 1, 2]]))


@pytest.fixture
def names(tmp_path, monkeypatch):
    """What the examples of docstrings take for granted."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    scene = a_scene()
    mesh = types.SimpleNamespace(vertices=scene.vertices, faces=scene.faces)
    camera = facemap.Camera((0, 2, -9))
    points = np.zeros((2, 3), np.float32)
    return {
        "facemap": facemap, "np": np, "scene": scene, "chair": mesh, "camera": camera, "cameras": [camera],
        "trimesh": types.SimpleNamespace(load=lambda path: mesh), "view": facemap.View(scene, (0, 1.7, 0)),
        "frame": scene.render(camera, width=16, height=16), "directions": points + (0, 0, 1), "lamps": points,
        "desks": points, "mask": np.eye(8) > 0, "land": facemap.terrain(np.zeros((50, 80)), spacing=10),
        "K": [[8, 0, 8], [0, 8, 8], [0, 0, 1]], "D": [0.1, 0, 0, 0], "pose": np.eye(4),
    }


class WhereItSays(doctest.OutputChecker):
    """Compares what an example shows, if it shows anything."""

    def check_output(self, want, got, flags):
        return not want or super().check_output(want, got, flags)


@pytest.mark.parametrize("name, docstring", documented(), ids=lambda value: value.split("\n")[0][:40])
def test_the_examples_of_docstrings_work(name, docstring, names):
    test = doctest.DocTestParser().get_doctest(docstring, names, name, None, 0)
    shown = []
    result = doctest.DocTestRunner(WhereItSays(), verbose=False).run(test, out=shown.append)
    assert result.failed == 0 and result.attempted > 0, "".join(shown)
