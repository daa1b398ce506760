"""Objects go on meaning what they were made from, wherever the process is and whatever happens to the files later."""

import os
import shutil

import amble
import pytest

from conftest import CONFIG, NOVELTY, SMALL, SOURCE

TINY = {"engine": "batch", "population.size": 8, "trial.duration_s": 0.5, "generations": 2}


@pytest.fixture
def jobs(tmp_path, monkeypatch):
    """Two folders; monkeypatch takes the process back."""
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path / "first")
    return tmp_path


def robot_file(folder, name):
    """A robot file and a config of the same names in each folder, of another robot."""
    text = (SOURCE / f"robots/{name}/{name}.toml").read_text().splitlines()
    model = [f'model = "{SOURCE}/robots/{name}/{name}.xml"' if line.startswith("model = ") else line for line in text]
    (folder / "robot.toml").write_text("\n".join(model))
    (folder / "experiment.toml").write_text(
        f'include = ["{SOURCE}/configs/robust/supg-objective.toml"]\nrobot = "robot.toml"\nengine = "batch"\n'
        'generations = 1\npopulation.size = 4\ntrial.duration_s = 0.2\ncontroller.substrate = "auto"\n')


def test_a_run_made_by_a_relative_path_is_itself_after_chdir(jobs):
    config = amble.load_config(CONFIG, TINY)
    first = amble.evolve(config, 10, out="run")
    os.chdir(jobs / "second")
    second = amble.evolve(config, 11, out="run")
    opened = amble.Run("run")
    os.chdir(jobs)
    assert [run.champion().facts["seed"] for run in (first, second, opened)] == [10, 11, 11]
    assert first.folder == str(jobs / "first/run") and first.config["seed"] == 10
    amble.resume(first, generations=3)
    assert [len(run.generations()["best"]) for run in (first, second)] == [3, 2]
    assert amble.view(first).html != amble.view(second).html


def test_a_callback_that_changes_the_folder_leaves_the_run_where_it_began(jobs):
    run = amble.evolve(amble.load_config(CONFIG, TINY), 3, out="run", on_generation=lambda _: os.chdir(jobs / "second"))
    assert run.folder == str(jobs / "first/run") and len(run.generations()["best"]) == 2
    assert len(run.champions()) >= 1 and os.listdir(jobs / "second") == []


def test_a_run_is_refused_once_another_took_its_place(jobs):
    config = amble.load_config(CONFIG, TINY)
    for overrides, seed in (({}, 2), ({"population.size": 9}, 1)):
        run = amble.evolve(config, 1, out="run")
        shutil.rmtree("run")
        amble.evolve(config.replace(overrides), seed, out="run")
        for use in (run.champion, run.champions, run.generations, lambda: run.config, lambda: amble.resume(run),
                    lambda: amble.view(run)):
            with pytest.raises(amble.Error, match="another run than when this Run was made"):
                use()
        shutil.rmtree("run")


def test_a_run_stays_itself_while_it_grows_and_its_folder_moves(jobs):
    run = amble.evolve(amble.load_config(CONFIG, TINY), 1, out="run")
    amble.resume("run", generations=3)
    assert len(run.generations()["best"]) == 3
    shutil.move("run", jobs / "second/run")
    with pytest.raises(amble.Error):
        run.champion()
    assert amble.Run(jobs / "second/run").champion().facts["seed"] == 1


@pytest.mark.parametrize("use", ["evolve", "search", "problem", "robots", "replace"])
def test_a_config_keeps_the_robot_beside_it(jobs, use):
    robot_file(jobs / "first", "hexapod")
    robot_file(jobs / "second", "octopod")
    config = amble.load_config("experiment.toml")
    os.chdir(jobs / "second")
    if use == "evolve":
        assert amble.evolve(config, out="run").champion().facts["robot"] == "hexapod"
    if use == "search":
        search = amble.Search(config)
        assert search.champion(search.ask()[0]).facts["robot"] == "hexapod"
    if use == "problem":
        assert amble.Problem(config).inputs == amble.Problem(jobs / "first/experiment.toml").inputs
        amble.evaluate(amble.Problem(config), amble.Search(config).ask())
    if use == "robots":
        assert len(amble.Robots(config).legs) == 6
    if use == "replace":
        assert len(amble.Robots(config.replace({"generations": 2})).legs) == 6
        assert len(amble.Robots(config.replace({"robot": "robot.toml"})).legs) == 8


def test_a_config_is_what_its_files_were(jobs):
    robot_file(jobs / "first", "hexapod")
    config = amble.load_config("experiment.toml", {"population.size": 5})
    robot_file(jobs / "first", "octopod")
    (jobs / "first/experiment.toml").write_text("generations = 7\n")
    assert config["generations"] == config.replace({"seed": 9})["generations"] == 1
    assert config.replace({"seed": 9})["population.size"] == 5
    assert len(amble.Robots(config).legs) == len(amble.Robots(config.replace({"seed": 9})).legs) == 6
    for name in ("robot.toml", "experiment.toml"):
        (jobs / "first" / name).unlink()
    assert amble.evolve(config, out="run").champion().facts["robot"] == "hexapod"


def test_a_recording_is_the_walk_that_it_was_read_from(run, jobs):
    champion = run.champion()
    champion.trial(record="walk.rec")
    walk = amble.Recording("walk.rec")
    gait, page = amble.gait(walk), amble.view(walk).html
    champion.trial(seconds=0.5, record="walk.rec")
    other = amble.Recording("walk.rec")
    assert len(other) == 50 and len(walk) == 200
    os.chdir(jobs / "second")
    for _ in range(2):
        assert amble.gait(walk) == gait and amble.view(walk).html == page
        assert amble.gait(other) != gait
        if os.path.exists(walk.path):
            os.unlink(walk.path)


def test_a_champion_needs_its_file_no_more(run, jobs):
    shutil.copy(run.champion().path, "champion.json")
    champion = amble.Champion("champion.json")
    before = champion.trial()
    os.unlink("champion.json")
    os.chdir(jobs / "second")
    assert champion.trial() == before
    assert champion.save("again.json") == str(jobs / "second/again.json") == champion.path
    with open(run.champion().path, "rb") as file:
        assert file.read() == (jobs / "second/again.json").read_bytes()
    (jobs / "second/notes.json").write_text("mine")
    with pytest.raises(amble.Error, match="not a champion"):
        champion.save("notes.json")
    with pytest.raises(ValueError):
        champion.save("again.txt")


def test_paths_of_calls_are_those_of_the_folder_at_the_call(run, jobs):
    champion = run.champion()
    champion.trial(seconds=0.2, record="walk.rec")
    os.chdir(jobs / "second")
    champion.trial(seconds=0.2, record="walk.rec")
    assert (jobs / "first/walk.rec").exists() and (jobs / "second/walk.rec").exists()
    with pytest.raises(amble.Error, match=str(jobs / "second")):
        amble.load_config("none.toml")


def test_a_search_ends_in_a_walker_that_can_be_seen(jobs):
    search = amble.Search(amble.load_config(NOVELTY, {**SMALL, "trial.duration_s": 0.5}), seed=4)
    genome = search.ask()[3]
    champion = search.champion(genome)
    facts = champion.facts
    assert champion.genome == genome and champion.path == "" and "not saved" in repr(champion)
    assert (facts["seed"], facts["generation"], facts["index"]) == (4, 0, 3)
    assert facts["result"]["distance_m"] == amble.evaluate(search, [genome]).objective[0]
    assert champion.trial(record="walk.rec")["distance_m"] == facts["result"]["distance_m"]
    assert amble.gait(amble.Recording("walk.rec")) and "walker" in amble.view(champion).html
    assert amble.Champion(champion.save("walker.json")).facts == facts
    with pytest.raises(amble.Error):
        search.champion(amble.Search(NOVELTY.parent / "ctrnn-novelty.toml").ask()[0])
