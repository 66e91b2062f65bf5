"""The package as a whole: its names, docstrings and stubs."""

import ast
import inspect
import re
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


def _stubs():
    stub = Path(facemap.__file__).with_name("_facemap.pyi").read_text()
    return ast.parse(stub).body


def _parameters_said(node):
    return [argument.arg for argument in node.args.args if argument.arg != "self"]


def _parameters_there(function):
    """Of the signature that begins a docstring of pybind11: name(self: Type, first: Type, ...) -> Type."""
    listed = re.search(r"\((.*)\)", function.__doc__.splitlines()[0])[1]
    return [name for name in re.findall(r"(?:^|, )(\w+)(?=: )", listed) if name != "self"]


def test_stubs_name_the_parameters_that_the_module_has():
    functions = [(getattr(_facemap, node.name), node) for node in _stubs() if isinstance(node, ast.FunctionDef)]
    for of_class in (node for node in _stubs() if isinstance(node, ast.ClassDef) and hasattr(_facemap, node.name)):
        held = vars(getattr(_facemap, of_class.name))
        functions += [(getattr(held[node.name], "__func__", held[node.name]), node) for node in of_class.body
                      if isinstance(node, ast.FunctionDef) and not isinstance(held.get(node.name), property)
                      and node.name in held]
    assert len(functions) > 40
    assert [f"{node.name}: {_parameters_said(node)}, but {_parameters_there(function)}" for function, node in functions
            if _parameters_said(node) != _parameters_there(function)] == []


def test_stubs_say_which_attributes_are_read_only():
    wrong = []
    for of_class in (node for node in _stubs() if isinstance(node, ast.ClassDef) and hasattr(_facemap, node.name)):
        held = vars(getattr(_facemap, of_class.name))
        said = {node.name: True for node in of_class.body if isinstance(node, ast.FunctionDef)}
        said.update({node.target.id: False for node in of_class.body if isinstance(node, ast.AnnAssign)})
        wrong += [f"{of_class.name}.{name}" for name, is_fixed in said.items()
                  if isinstance(held.get(name), property) and is_fixed != (held[name].fset is None)]
    assert wrong == []


def test_stubs_have_what_the_module_has():
    said = _names(_stubs())
    there = {name for name in dir(_facemap) if not name.startswith("_") or name == "__version__"}
    assert set(said) == there
    for name in there:
        value = getattr(_facemap, name)
        if inspect.isclass(value):
            members = getattr(value, "__members__", {})
            held = {key for key in vars(value) if not key.startswith("_") and key not in members}
            assert said[name] - set(members) - {"name"} == held - {"name", "value"}, name
