"""Paths that are not UTF-8, as os.fsdecode() has them."""

import os
import pickle

import amble
import pytest

from conftest import CONFIG, SOURCE

TINY = {"engine": "batch", "population.size": 8, "trial.duration_s": 0.5, "generations": 1}


@pytest.fixture
def folder(tmp_path):
    path = tmp_path / os.fsdecode(b"d\xe9")
    path.mkdir()
    return path


def test_a_run_and_what_it_leaves_have_the_paths_that_were_given(folder):
    run = amble.evolve(amble.load_config(CONFIG, TINY), out=folder / "run")
    assert run.folder == str(folder / "run") and str(folder) in repr(run)
    assert pickle.loads(pickle.dumps(run)).folder == run.folder
    assert run.config["robot"] == str(folder / "run/robot.json")
    assert pickle.loads(pickle.dumps(run.config)).to_dict() == run.config.to_dict()
    champion = run.champion()
    assert champion.path.startswith(run.folder) and champion.path in repr(champion)
    assert pickle.loads(pickle.dumps(champion)).path == champion.path
    assert champion.save(folder / "mine.json") == str(folder / "mine.json")
    assert champion.export(folder / "walker.c") == str(folder / "walker.c")
    champion.trial(record=folder / "walk.rec")
    walk = amble.Recording(folder / "walk.rec")
    assert walk.path == pickle.loads(pickle.dumps(walk)).path == str(folder / "walk.rec") and walk.path in repr(walk)
    assert amble.gait(walk.path) == amble.gait(walk)
    assert amble.view([run, walk.path]).save(folder / "walk.html") == folder / "walk.html"
    assert amble.compare([run], engines=["batch"], trials=1)[0]["champion"] == run.champion().path


def test_a_robot_of_one_s_own_may_be_there(folder):
    made = amble.new_robot(SOURCE / "robots/servo/servo.urdf", folder / "mine")
    assert made["config"] == str(folder / "mine/evolve.toml") and str(folder) in made["text"]
    assert len(amble.Robots(made["robot"]).legs) == 4


def test_messages_name_the_path(folder):
    champion = amble.Champion(SOURCE / "robots/hexapod/champion.json")
    for kind, call in ((amble.Error, lambda: amble.Run(folder / "none")), (amble.Error, lambda: amble.load_config(folder / "no.toml")),
                       (ValueError, lambda: champion.save(folder / "no.txt"))):
        with pytest.raises(kind) as raised:
            call()
        assert str(folder) in str(raised.value)


def test_an_empty_path_is_refused_in_words():
    for call in (amble.load_config, amble.Run, amble.Champion, amble.Recording, amble.Map, amble.gait, amble.view, amble.new_robot,
                 lambda path: amble.evolve(CONFIG, out=path)):
        with pytest.raises(ValueError, match="expected"):
            call("")
