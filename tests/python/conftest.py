"""What the tests of the Python module share. AMBLE_PROGRAM: the command line of the same build."""

import os
import pathlib
import signal
import subprocess

import amble
import pytest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
CONFIG = SOURCE / "configs/authors/supg-objective.toml"
NOVELTY = SOURCE / "configs/authors/supg-novelty.toml"
ROBOT = SOURCE / "robots/quadruped/authors.toml"
SMALL = {"engine": "batch", "population.size": 24, "trial.duration_s": 2.0, "generations": 4}


def program(*arguments):
    """Runs the command line; (exit code, what it said on stderr)."""
    done = subprocess.run([os.environ["AMBLE_PROGRAM"], *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stderr


def assignments(overrides):
    return [part for key, value in overrides.items() for part in ("--set", f"{key}={value}")]


@pytest.fixture
def ctrl_c():
    """Ctrl-C as in the foreground: a shell's background job ignores it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def config():
    return amble.load_config(CONFIG, SMALL)


@pytest.fixture(scope="session")
def run(config, tmp_path_factory):
    return amble.evolve(config, 7, out=tmp_path_factory.mktemp("run") / "run")


@pytest.fixture(scope="session")
def recording(run, tmp_path_factory):
    path = tmp_path_factory.mktemp("recording") / "walk.rec"
    run.champion().trial(record=path)
    return amble.Recording(path)
