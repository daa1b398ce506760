"""Runs that cannot mean anything say so; so does a Python that cannot load the module."""

import pathlib
import shutil
import subprocess
import sys
import warnings

import amble
import pytest

from conftest import CONFIG, SOURCE, assignments, program

TINY = {"engine": "batch", "population.size": 4, "trial.duration_s": 1.0, "generations": 1}


def robot(folder, gravity, more=()):
    """The authors' quadruped under another gravity."""
    model = (SOURCE / "robots/quadruped/authors.xml").read_text()
    at = model.index('gravity="') + len('gravity="')
    (folder / "robot.xml").write_text(model[:at] + gravity + model[model.index('"', at):])
    text = (SOURCE / "robots/quadruped/authors.toml").read_text().splitlines()
    text = ['model = "robot.xml"' if line.startswith("model = ") else line for line in text]
    (folder / "robot.toml").write_text("\n".join(text))
    return amble.load_config(CONFIG, {**TINY, "robot": str(folder / "robot.toml"), **dict(more)})


@pytest.mark.parametrize("gravity, why", [("0 -9.81 0", "has .y up"), ("0 0 0", "nothing walks"), ("0 0 9.81", "points up")])
def test_gravity_that_does_not_point_down_is_refused(gravity, why, tmp_path):
    config = robot(tmp_path, gravity)
    for use in (lambda: amble.evolve(config, out=tmp_path / "run"), lambda: amble.Problem(config), lambda: amble.Search(config)):
        with pytest.raises(amble.Error, match=why) as raised:
            use()
        assert raised.value.exit_code == 2
    assert not (tmp_path / "run").exists()


def test_a_sound_robot_gives_no_warning(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        amble.evolve(robot(tmp_path, "0 0 -9.81"), out=tmp_path / "run")


def said_to_a_user(call):
    """The messages of UserWarnings."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        call()
    return [str(warning.message) for warning in said]


def test_a_config_that_slopes_is_not_told_that_gravity_is_tilted(tmp_path):
    config = amble.load_config(CONFIG, {**TINY, "ground.slope_x": 0.1})
    assert said_to_a_user(lambda: amble.evolve(config, out=tmp_path / "run")) == []


def test_motors_too_weak_for_the_robot_are_named(tmp_path):
    said = said_to_a_user(lambda: amble.evolve(robot(tmp_path, "0 0 -60"), out=tmp_path / "run"))
    assert any("motors too weak to hold the weight on half of the legs: " in line for line in said), said


def test_settings_that_have_no_effect_are_named_as_by_the_command_line(tmp_path):
    idle = {"controller.ctrnn.steps_per_tick": 3, "command.kind": "random"}
    config = amble.load_config(CONFIG, {**TINY, **idle})
    _, program_said = program("evolve", CONFIG, *assignments({**TINY, **idle}), "--out", tmp_path / "theirs")
    said = [f"note: {line.replace('overrides: ', '--set ')}" for line in said_to_a_user(lambda: amble.Search(config))]
    assert len(said) == 2 and "controller.ctrnn.steps_per_tick has no effect" in said[0] and "[command] is not heard" in said[1]
    assert [line for line in program_said.splitlines() if line.startswith("note: ")] == said
    assert said_to_a_user(lambda: amble.evolve(config, out=tmp_path / "ours")) == said_to_a_user(lambda: amble.Search(config))


def test_a_run_without_a_trial_that_counts_warns_at_its_start_and_ends_in_an_error(tmp_path):
    config = robot(tmp_path, "0 0 -1e6")
    with pytest.warns(UserWarning, match="held in its start pose"):
        with pytest.raises(amble.Error, match="of 4 .*so the results mean nothing") as raised:
            amble.evolve(config, out=tmp_path / "run")
    assert raised.value.exit_code == 2
    assert len(amble.Run(tmp_path / "run").generations()["best"]) == 1


@pytest.mark.parametrize("suffix, expected", [("cpython-399-x86_64-linux-gnu.so", "built for cpython 3.99"),
                                              ("pypy39-pp73.so", "built for pypy39"), (None, "make python")])
def test_another_python_is_told_for_which_the_module_was_built(suffix, expected, tmp_path):
    package = pathlib.Path(amble.__file__).parent
    (tmp_path / "amble").mkdir()
    for file in package.glob("*.py"):
        shutil.copy(file, tmp_path / "amble")
    if suffix:
        (tmp_path / f"amble/_amble.{suffix}").write_bytes(b"")
    done = subprocess.run([sys.executable, "-c", "import amble"], capture_output=True, text=True,
                          env={"PYTHONPATH": str(tmp_path)})
    said = done.stderr.strip().splitlines()[-1]
    assert done.returncode == 1 and said.startswith("ImportError: amble")
    assert expected in said and "this is cpython " + ".".join(map(str, sys.version_info[:2])) in said
