"""docs/PYTHON.md: each recipe runs, one after the other, as a reader would run them in the project's folder."""

import os
import re
import subprocess
import sys

import amble
import pytest

from conftest import SOURCE

PACKAGES = os.path.dirname(os.path.dirname(os.path.abspath(amble.__file__)))
RECIPES = re.findall(r"^```python\n(.*?)^```", (SOURCE / "docs/PYTHON.md").read_text(), re.M | re.S)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("project")
    for name in ("configs", "robots"):
        (folder / name).symlink_to(SOURCE / name)
    return folder


def test_there_are_seven_recipes():
    assert len(RECIPES) == 7


@pytest.mark.parametrize("number", range(1, 8))
def test_recipe_runs(number, folder):
    done = subprocess.run([sys.executable, "-W", "error", "-c", RECIPES[number - 1]], cwd=folder, capture_output=True,
                          text=True, env={**os.environ, "PYTHONPATH": PACKAGES})
    assert done.returncode == 0, done.stderr
    assert done.stdout and not done.stderr
