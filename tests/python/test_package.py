"""The package as a whole: its names, docstrings and stubs."""

import ast
import inspect
from pathlib import Path

import facemap
from facemap import _facemap


def test_all_is_all_that_is_public():
    public = {name for name, value in vars(facemap).items() if not name.startswith("_") and not inspect.ismodule(value)}
    assert public | {"__version__"} == set(facemap.__all__)


def _documented():
    for name in facemap.__all__:
        value = getattr(facemap, name)
        if inspect.isclass(value) or inspect.isfunction(value):
            yield name, value
        if inspect.isclass(value) and not issubclass(value, Exception):
            for key, member in vars(value).items():
                if not key.startswith("_") and (callable(member) or isinstance(member, (property, classmethod))):
                    yield f"{name}.{key}", member


def test_everything_has_a_docstring():
    assert [name for name, value in _documented() if not inspect.getdoc(value)] == []


def _names(body):
    """Of a stub: classes with what they hold, and functions."""
    found = {}
    for node in body:
        if isinstance(node, ast.ClassDef):
            found[node.name] = set(_names(node.body))
        elif isinstance(node, ast.FunctionDef):
            found[node.name] = set()
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = set()
    return {name: held for name, held in found.items() if not name.startswith("_") or name == "__version__"}


def test_stubs_have_what_the_module_has():
    stub = Path(facemap.__file__).with_name("_facemap.pyi").read_text()
    said = _names(ast.parse(stub).body)
    there = {name for name in dir(_facemap) if not name.startswith("_") or name == "__version__"}
    assert set(said) == there
    for name in there:
        value = getattr(_facemap, name)
        if inspect.isclass(value):
            members = getattr(value, "__members__", {})
            held = {key for key in vars(value) if not key.startswith("_") and key not in members}
            assert said[name] - set(members) - {"name"} == held - {"name", "value"}, name
