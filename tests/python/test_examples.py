"""examples/python: each runs, shortened, as a program of its own, and what it searches for gets better."""

import importlib.util
import os
import re
import subprocess
import sys

import amble
import pytest

from conftest import SOURCE

EXAMPLES = SOURCE / "examples/python"
PACKAGES = os.path.dirname(os.path.dirname(os.path.abspath(amble.__file__)))


def output_of(name, *arguments, folder):
    done = subprocess.run([sys.executable, "-W", "error", EXAMPLES / name, *map(str, arguments)], cwd=folder,
                          capture_output=True, text=True, env={**os.environ, "PYTHONPATH": PACKAGES, "MPLBACKEND": "agg"})
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("name, generations, pattern", [("own_fitness.py", 6, r"mean (\S+)"),
                                                        ("own_simulator.py", 8, r"mean (\S+) m"),
                                                        ("cma_es.py", 12, r"mean (\S+) m")])
def test_a_search_of_ones_own_gets_better(name, generations, pattern, tmp_path):
    found = [float(number) for number in re.findall(pattern, output_of(name, generations, folder=tmp_path), re.M)]
    assert len(found) == generations and max(found[generations // 2:]) > 1.2 * found[0] + 0.05, found


def test_cma_es_has_fifty_lines():
    assert len((EXAMPLES / "cma_es.py").read_text().splitlines()) <= 50


@pytest.mark.skipif(importlib.util.find_spec("matplotlib") is None, reason="python3-matplotlib is not installed")
def test_evolve_and_plot_leaves_figure_recording_and_page(tmp_path):
    said = output_of("evolve_and_plot.py", tmp_path / "plotted", 3, folder=tmp_path)
    for name in ("walk.svg", "walk.rec", "walk.html"):
        assert (tmp_path / "plotted" / name).stat().st_size > 10000
    assert "walk.svg" in said
