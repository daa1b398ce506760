import json
import os
import shutil
import subprocess

import amble
import numpy as np
import pytest

from conftest import SOURCE

SMALL_MAP = {"search.map_elites.batch": 128, "search.map_elites.initial": 128, "trial.duration_s": 2.0, "generations": 3}


@pytest.fixture(scope="module")
def filled(tmp_path_factory):
    return amble.evolve(amble.load_config(SOURCE / "configs/repertoire/quadruped.toml", SMALL_MAP), 3,
                        out=tmp_path_factory.mktemp("map") / "run")


def said_by_program(*arguments):
    return subprocess.run([os.environ["AMBLE_PROGRAM"], *map(str, arguments)], capture_output=True, text=True, check=True).stdout


def test_a_map_has_what_its_json_file_has(filled, tmp_path):
    gaits = amble.Map(filled)
    said_by_program("repertoire", filled.folder, "-o", tmp_path / "map.json")
    told = json.loads((tmp_path / "map.json").read_text())
    elites = gaits.elites()
    assert elites["cell"].tolist() == [elite["cell"] for elite in told["elites"]]
    assert elites["objective"].tolist() == [elite["objective"] for elite in told["elites"]]
    assert elites["descriptor"].shape == (len(gaits), len(gaits.dimensions))
    assert np.isclose(gaits.qd_score, elites["objective"].sum())
    assert 0 < len(gaits) <= gaits.cells == np.prod([dimension["bins"] for dimension in gaits.dimensions])


def test_new_trials_say_what_the_elites_keep(filled):
    gaits = amble.Map(filled.folder)
    again = gaits.retest(4)
    assert again["trials"] == 4
    assert again["cell"].tolist() == gaits.elites()["cell"].tolist()
    assert np.isclose(again["promised_qd_score"], gaits.qd_score)
    assert np.isclose(again["staying_share"], again["stays"].mean())
    assert again["filled"] <= len(gaits)
    assert gaits.retest(4, jobs=1)["objective"].tolist() == again["objective"].tolist()


def test_the_elite_of_a_cell_is_a_champion(filled, tmp_path):
    gaits = amble.Map(filled)
    elites = gaits.elites()
    best = elites["cell"][elites["objective"].argmax()]
    walker = gaits.champion()
    assert walker.genome.to_dict() == gaits.champion(int(best)).genome.to_dict()
    said_by_program("repertoire", filled.folder, "--cell", best, "-o", tmp_path / "elite.json")
    assert amble.Champion(tmp_path / "elite.json").genome.to_dict() == walker.genome.to_dict()
    with pytest.raises(amble.Error, match="cell"):
        gaits.champion(gaits.cells)


def test_a_map_is_saved_by_the_ending_of_its_name(filled, tmp_path):
    gaits = amble.Map(filled)
    for name in ("map.html", "map.svg", "map.csv", "map.json"):
        walkers = 2 if name.endswith(".html") else None
        assert gaits.save(tmp_path / name, trials=0, walkers=walkers) == str(tmp_path / name)
        said_by_program("repertoire", filled.folder, "-o", tmp_path / ("said-" + name), "--retest", 0, *(("--walkers", 2) if walkers else ()))
        assert (tmp_path / name).read_bytes() == (tmp_path / ("said-" + name)).read_bytes(), name
    with pytest.raises(amble.Error, match="expected FILE.html"):
        gaits.save(tmp_path / "map.png")
    with pytest.raises(ValueError, match="trials: a .json file holds what the map says"):
        gaits.save(tmp_path / "other.json", trials=2)
    with pytest.raises(ValueError, match="walkers: only for a page"):
        gaits.save(tmp_path / "other.svg", walkers=2)


def test_a_map_needs_its_run_no_more(filled, tmp_path):
    shutil.copytree(filled.folder, tmp_path / "run")
    gaits = amble.Map(tmp_path / "run")
    gaits.save(tmp_path / "before.html", trials=0, walkers=1)
    shutil.rmtree(tmp_path / "run")
    gaits.save(tmp_path / "after.html", trials=0, walkers=1)
    assert (tmp_path / "after.html").read_bytes() == (tmp_path / "before.html").read_bytes()


def test_trials_that_are_all_the_same_are_noted(tmp_path):
    config = amble.load_config(SOURCE / "configs/repertoire/quadruped.toml", {
        **SMALL_MAP, "generations": 1, "search.map_elites.trials": 1, "search.map_elites.reevaluate_share": 0.0,
        "search.map_elites.challenger_share": 0.0, "champion.episodes": 0, "noise": {
            "push_m_s": 0.0, "start_joint_rad": 0.0, "start_tilt_rad": 0.0, "start_height_m": 0.0, "touch_flip_probability": 0.0,
            "joint_sensor_rad": 0.0, "attitude_sensor_rad": 0.0, "latency_ticks": 0}})
    gaits = amble.Map(amble.evolve(config, 1, out=tmp_path / "still"))
    with pytest.warns(UserWarning, match="trials: the search was without noise"):
        assert gaits.retest(5)["trials"] == 1


def test_a_damaged_robot_finds_a_gait_as_on_the_command_line(filled, tmp_path):
    found = amble.Map(filled).adapt("missing:FL", trials=4, test_trials=2, page=tmp_path / "found.html")
    said_by_program("adapt", filled.folder, "--damage", "missing:FL", "--trials", 4, "--judge", 2, "-o", tmp_path / "found.json")
    told = json.loads((tmp_path / "found.json").read_text())
    for key in ("intact", "damaged", "adapted", "cell", "done", "trials"):
        assert found[key] == told[key], key
    assert (tmp_path / "found.html").read_text().startswith("<!DOCTYPE html>")
    with pytest.raises(amble.Error):
        amble.Map(filled).adapt("missing:XX")
    for damage in ("", "none.toml"):
        with pytest.raises(amble.Error, match=f'damage "{damage}": no such file; expected damages such as missing:FL'):
            amble.Map(filled).adapt(damage)
    for wrong in ({"page": tmp_path / "found.json"}, {"episodes": 101}, {"test_trials": 100001}):
        with pytest.raises(ValueError, match="expected a"):
            amble.Map(filled).adapt("missing:FL", **wrong)


def test_a_map_goes_on_meaning_what_was_read(filled, tmp_path):
    gaits = amble.Map(filled)
    os.rename(filled.folder, filled.folder + "-elsewhere")
    try:
        assert gaits.champion().typical(trials=2)["distance_m"] >= 0.0
        assert gaits.retest(2)["trials"] == 2
    finally:
        os.rename(filled.folder + "-elsewhere", filled.folder)


def test_a_run_of_another_search_has_no_map(run):
    with pytest.raises(amble.Error, match="map"):
        amble.Map(run)


def test_compare_says_what_the_command_line_says(run):
    rows = amble.compare([run, run.champion()], seconds=[1.0, 2.0], engines=["batch", "mujoco"], level="milli", trials=3)
    assert [(row["trial_s"], row["evolved_in"]) for row in rows] == [(1.0, "batch"), (2.0, "batch")] * 2
    told = json.loads(said_by_program("compare", run.folder, "--seconds", "1,2", "--engines", "batch,mujoco", "--level", "milli",
                                      "--trials", 3, "--format", "json"))
    assert [row["results"] for row in rows[:2]] == [row["results"] for row in told]
    assert rows[2]["results"] == rows[0]["results"]
    alone = amble.compare([run], undisturbed=True, engines=["batch"])[0]
    assert alone["under"] == "without noise" and len(alone["results"][0]["trials"]) == 1


def test_compare_refuses_what_is_not_there(run):
    with pytest.raises(amble.Error, match="engine"):
        amble.compare([run], engines=["bullet"])
    with pytest.raises(TypeError):
        amble.compare([1])
    with pytest.raises(ValueError, match="trials"):
        amble.compare([run], trials=-1)
    with pytest.raises(TypeError, match="champions: expected a list of them, found str"):
        amble.compare(run.folder)


@pytest.mark.parametrize("both", [{"level": "milli", "noise": "windy.toml"}, {"level": "milli", "undisturbed": True},
                                  {"trials": 3, "undisturbed": True}])
def test_compare_refuses_what_contradicts_itself(run, both):
    with pytest.raises(ValueError, match="expected"):
        amble.compare([run], **both)
