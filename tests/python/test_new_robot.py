import os
import shutil
import subprocess

import amble
import pytest

from conftest import SOURCE, program


@pytest.fixture
def model(tmp_path):
    return shutil.copy(SOURCE / "robots/servo/servo.urdf", tmp_path)


def test_a_model_becomes_what_the_command_line_makes_of_it(model, tmp_path):
    made = amble.new_robot(model, tmp_path / "mine")
    said = subprocess.run([os.environ["AMBLE_PROGRAM"], "robot", "--init", model, "-o", tmp_path / "theirs"],
                          capture_output=True, text=True, check=True).stdout
    assert made["text"].replace("/mine/", "/theirs/") == said
    for name, key in (("servo.toml", "robot"), ("evolve.toml", "config"), ("steer.toml", "steer_config")):
        assert made[key] == str(tmp_path / "mine" / name)
        assert (tmp_path / "mine" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes()
    assert made["ready"] and made["missing"] == made["warnings"] == []
    assert all(line in made["text"] for line in made["settled"])


def test_what_was_made_can_be_evolved_at_once(model, tmp_path):
    made = amble.new_robot(model, tmp_path / "made")
    small = {"population.size": 16, "trial.duration_s": 1.0, "generations": 2}
    run = amble.evolve(amble.load_config(made["config"], small), 1, out=tmp_path / "run")
    assert len(run.generations()["best"]) == 2
    assert len(amble.Robots(made["robot"]).legs) == 4


def test_the_folder_has_the_name_of_the_model_where_none_is_given(model, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    made = amble.new_robot("servo.urdf")
    for key, name in (("robot", "servo.toml"), ("config", "evolve.toml"), ("steer_config", "steer.toml")):
        assert made[key] == str(tmp_path / "servo" / name) and (tmp_path / "servo" / name).is_file()


def test_a_model_without_legs_says_what_is_missing(tmp_path):
    ball = tmp_path / "ball.xml"
    ball.write_text("<mujoco><worldbody><body><freejoint/><geom size='0.1'/></body></worldbody></mujoco>")
    made = amble.new_robot(ball, tmp_path / "ball")
    assert not made["ready"] and made["missing"]
    assert "next: complete it" in made["text"]


def test_refusals_are_those_of_the_command_line(model, tmp_path):
    amble.new_robot(model, tmp_path / "there")
    before = (tmp_path / "there/servo.toml").read_bytes()
    for wrong in (model, tmp_path / "gone.xml", SOURCE / "robots/servo/servo.toml"):
        code, said = program("robot", "--init", wrong, "-o", tmp_path / "there")
        with pytest.raises(amble.Error) as refused:
            amble.new_robot(wrong, tmp_path / "there")
        assert refused.value.exit_code == code != 0
        assert said == f"amble: {refused.value}\n"
    assert (tmp_path / "there/servo.toml").read_bytes() == before
    with pytest.raises(TypeError):
        amble.new_robot(3)
