import ast
import inspect
import os
import re
import subprocess
import sys

import amble

from conftest import SOURCE


def test_the_version_is_that_of_the_command_line():
    said = subprocess.run([os.environ["AMBLE_PROGRAM"], "--version"], capture_output=True, text=True).stdout
    lines = dict(line.split(None, 1) for line in said.splitlines())
    assert list(lines) == ["amble", "commit", "build", "engines", "instructions"]
    assert lines["amble"] == amble.__version__ and lines["commit"] == amble.__commit__
    assert lines["engines"].startswith("ode, batch, mujoco") and "(ODE 0.16" in lines["engines"] and "-ffp-contract=off" in lines["build"]
    assert re.match(r"(AVX3(_ZEN4|_DL)?|AVX2|SSE2|NEON|EMU128|SCALAR), of ", lines["instructions"])


def test_everything_public_has_a_docstring():
    for name in amble.__all__:
        assert inspect.getdoc(getattr(amble, name)), name


def test_every_public_member_has_a_docstring_or_a_name_that_says_it():
    plain = {"config", "path", "folder", "threads", "timestep_s", "html", "height", "objective", "behaviour"}
    for name in amble.__all__:
        kind = getattr(amble, name)
        for key, member in vars(kind).items() if inspect.isclass(kind) else ():
            assert key.startswith("_") or key in plain or inspect.getdoc(member), (name, key)


def stubs():
    """Nodes of classes and functions in the stubs of everything public, by name."""
    nodes = {}
    for file in ("_amble", "_data", "_evaluation", "_view"):
        stub = ast.parse((SOURCE / f"python/amble/{file}.pyi").read_text())
        nodes.update({node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))})
    return nodes


def test_stubs_name_exactly_what_the_module_has():
    nodes = stubs()
    assert set(nodes) == set(amble.__all__)
    for name, node in nodes.items():
        if name == "Error" or isinstance(node, ast.FunctionDef):
            continue
        stubbed = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        real = {key for key in vars(getattr(amble, name)) if not key.startswith("_")}
        assert {key for key in stubbed if not key.startswith("_")} == real, name


def parameters_of(function):
    """Names of the parameters, as pybind11's docstrings or Python itself have them."""
    try:
        return [name for name in inspect.signature(function).parameters if name != "self"]
    except ValueError:
        line = function.__doc__.splitlines()[0]
        return [name for name in re.findall(r"[(,] ?\*?(\w+)(?=:)", line) if name != "self"]


def test_stubs_have_the_parameters_of_the_module():
    checked = 0
    for name, node in stubs().items():
        real = getattr(amble, name)
        for item in node.body if isinstance(node, ast.ClassDef) else [node]:
            if not isinstance(item, ast.FunctionDef) or item.decorator_list or item.name == "__eq__":
                continue
            function = getattr(real, item.name) if real is not item and isinstance(node, ast.ClassDef) else real
            stubbed = [argument.arg for argument in item.args.args + item.args.kwonlyargs if argument.arg != "self"]
            assert parameters_of(function) == stubbed, (name, item.name)
            checked += 1
    assert checked > 40


def test_gymnasium_is_imported_only_by_its_adapter():
    assert "gymnasium" not in sys.modules


