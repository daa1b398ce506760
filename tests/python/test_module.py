import ast
import inspect
import os
import subprocess
import sys

import amble

from conftest import SOURCE


def test_the_version_is_that_of_the_command_line():
    said = subprocess.run([os.environ["AMBLE_PROGRAM"], "--version"], capture_output=True, text=True).stdout
    assert amble.__version__ in said


def test_everything_public_has_a_docstring():
    for name in amble.__all__:
        assert inspect.getdoc(getattr(amble, name)), name


def test_stubs_name_exactly_what_the_module_has():
    stub = ast.parse((SOURCE / "python/amble/_amble.pyi").read_text())
    classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    assert set(classes) | functions == set(amble.__all__)
    for name, node in classes.items():
        if name == "Error":
            continue
        stubbed = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        real = {key for key in vars(getattr(amble, name)) if not key.startswith("_")}
        assert {key for key in stubbed if not key.startswith("_")} == real, name


def test_gymnasium_is_imported_only_by_its_adapter():
    assert "gymnasium" not in sys.modules


