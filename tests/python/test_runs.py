import enum
import json
import os
import shutil
import signal
import subprocess
import threading
import types
from pathlib import Path

import amble
import numpy as np
import pytest

from conftest import CONFIG, NOVELTY, SMALL, assignments, program

CLOCKS = {"wall_s", "outside_s", "physics_s", "decode_s", "control_s", "waiting_s", "search_s", "referees_s", "files_s"}


def without_clocks(table):
    return {name: values.tolist() for name, values in table.items() if name not in CLOCKS}


def test_evolve_gives_the_files_of_the_command_line(run, tmp_path):
    code, said = program("evolve", CONFIG, *assignments(SMALL), "--seed", 7, "--out", tmp_path / "run", "--jobs", 1)
    assert code == 0, said
    other = amble.Run(tmp_path / "run")
    assert without_clocks(run.generations()) == without_clocks(other.generations())
    names = sorted(os.listdir(os.path.join(run.folder, "champions")))
    assert names and names == sorted(os.listdir(tmp_path / "run/champions"))
    for name in names:
        with open(os.path.join(run.folder, "champions", name), "rb") as mine:
            assert mine.read() == (tmp_path / "run/champions" / name).read_bytes()


def test_generations_are_numpy_columns_of_one_length(run):
    table = run.generations()
    assert {"generation", "best", "best_so_far", "mean", "fell", "species", "wall_s"} <= set(table)
    assert all(column.dtype == np.float64 and column.shape == (4,) for column in table.values())
    assert np.array_equal(table["generation"], [0, 1, 2, 3])
    assert np.array_equal(table["best_so_far"], np.maximum.accumulate(table["best"]))


def test_a_row_that_was_being_written_is_no_generation(run, tmp_path):
    shutil.copytree(run.folder, tmp_path / "run")
    table = tmp_path / "run" / "generations.csv"
    *rows, last = table.read_text().splitlines(keepends=True)
    for half in (last[:1], last[:5], last[:-1]):
        table.write_text("".join(rows) + half)
        kept = amble.Run(tmp_path / "run").generations()
        assert len(kept["best"]) == len(rows) - 1 and not np.isnan(kept["mean"]).any()


def test_a_callback_gets_each_generation(config, tmp_path):
    lines, threads = [], set()

    def note(line):
        lines.append(line)
        threads.add(threading.get_ident())

    run = amble.evolve(config, 7, out=tmp_path / "run", on_generation=note)
    table = run.generations()
    assert [line["best"] for line in lines] == table["best"].tolist()
    assert set(lines[0]) == set(table)
    assert threads == {threading.get_ident()}


def test_an_exception_of_the_callback_stops_the_run_which_can_be_resumed(config, run, tmp_path):
    def refuse(line):
        if line["generation"] == 1:
            raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        amble.evolve(config, 7, out=tmp_path / "run", on_generation=refuse)
    assert len(amble.Run(tmp_path / "run").generations()["best"]) == 2
    resumed = amble.resume(tmp_path / "run")
    assert without_clocks(resumed.generations()) == without_clocks(run.generations())


def test_ctrl_c_interrupts_a_long_run_within_a_second(ctrl_c, tmp_path):
    endless = amble.load_config(CONFIG, {**SMALL, "generations": 1000000, "trial.duration_s": 30.0})
    seen = []

    def interrupt(line):
        seen.append(line)
        if len(seen) == 2:
            threading.Timer(0.05, signal.raise_signal, [signal.SIGINT]).start()

    with pytest.raises(KeyboardInterrupt):
        amble.evolve(endless, out=tmp_path / "run", on_generation=interrupt)
    assert len(amble.Run(tmp_path / "run").generations()["best"]) >= 2


@pytest.mark.parametrize("overrides", [{"population.size": "many"}, {"population.sise": 5}, {"engine": "bullet"},
                                       {"trial.duration_s": -1.0}])
def test_errors_have_the_words_and_the_code_of_the_command_line(overrides, tmp_path):
    quoted = {key: f'"{value}"' if isinstance(value, str) else value for key, value in overrides.items()}
    code, said = program("evolve", CONFIG, *assignments(quoted), "--out", tmp_path / "run")
    with pytest.raises(amble.Error) as raised:
        amble.load_config(CONFIG, overrides)
    assert f"amble: {raised.value}\n" == said
    assert raised.value.exit_code == code


def test_missing_files_and_taken_folders_are_errors_with_codes(run, config, tmp_path):
    for call in (lambda: amble.load_config(tmp_path / "no.toml"), lambda: amble.Run(tmp_path / "no"),
                 lambda: amble.Champion(tmp_path / "no.json"), lambda: amble.Recording(tmp_path / "no.rec"),
                 lambda: amble.evolve(config, out=run.folder)):
        with pytest.raises(amble.Error) as raised:
            call()
        assert raised.value.exit_code in (2, 4)


def test_a_config_reads_like_a_dict(config):
    assert config["population.size"] == config["population"]["size"] == 24
    assert dict(config)["engine"] == "batch" and "search.kind" in config and "search.sort" not in config
    assert config.replace({"population": {"size": 30}})["population.size"] == 30
    assert config["population.size"] == 24
    assert amble.load_config(CONFIG, {"population.size": np.int64(9), "name": 'a "b" \\ ü'})["name"] == 'a "b" \\ ü'
    with pytest.raises(KeyError):
        config["population.sise"]


def test_another_config_keeps_a_seed_that_was_an_argument(config):
    seeded = amble.Search(config, seed=7).config
    assert [seeded.replace(change)["seed"] for change in ({"generations": 5}, {"seed": 3})] == [7, 3]


def test_numbers_that_write_themselves_otherwise_are_numbers(config):
    class Size(enum.IntEnum):
        SMALL = 9

    class Seconds(float):
        def __repr__(self):
            return "np.float64(1.5)"  # as numpy 2 writes its own

    changed = config.replace({"population.size": Size.SMALL, "trial.duration_s": Seconds(1.5)})
    assert (changed["population.size"], changed["trial.duration_s"]) == (9, 1.5)


def test_champions_walk_again_as_they_did(run):
    champion = run.champion()
    facts = champion.facts
    assert champion.trial() == {**facts["result"], "events": champion.trial()["events"]}
    assert facts["objective"] == run.generations()["best"].max()
    assert facts["engine"] == "batch" and facts["seed"] == 7
    with open(champion.path) as file:
        assert champion.genome.to_dict() == json.load(file)["genome"]
    assert [c.path for c in run.champions()][-1] == champion.path


def test_what_a_champion_typically_does_is_the_median_of_disturbed_trials(run):
    champion = run.champion()
    typical = champion.typical(trials=5)
    assert typical["level"] == "milli"
    distances = sorted(trial["distance_m"] for trial in typical["trials"])
    assert len(distances) == 5 and typical["distance_m"] == distances[2] and typical["best_m"] == distances[4]
    assert typical["lower_quartile_m"] == distances[1] and typical["upper_quartile_m"] == distances[3]
    assert typical["fell_share"] == sum(t["outcome"] != "completed" for t in typical["trials"]) / 5
    assert champion.typical(trials=5, jobs=2) == typical
    assert champion.typical(level="control", trials=2)["trials"][1]["distance_m"] == champion.trial()["distance_m"]
    for wrong in ({"level": "nano"}, {"level": "own"}):
        with pytest.raises(amble.Error):
            champion.typical(**wrong)
    for trials in (-1, 100001):
        with pytest.raises(ValueError, match="trials: .*expected a whole number from 1 to 100000"):
            champion.typical(trials=trials)


def test_recordings_have_their_columns_as_views(recording):
    assert recording.frames.shape == (len(recording), len(recording.columns)) == (200, len(recording.columns))
    assert recording.frames.dtype == np.float32
    column = recording["com.x"]
    assert np.shares_memory(column, recording.frames) and not column.flags.writeable
    assert np.array_equal(column, recording.frames[:, recording.columns.index("com.x")])
    assert recording.matching("angle.").shape == (200, 12)
    assert recording.robot["name"] and recording.frame_s == 0.01 and recording.outcome == "completed"
    with pytest.raises(KeyError):
        recording["com.w"]


def test_gait_is_that_of_the_command_line(recording, tmp_path):
    code, said = program("gait", recording.path, "--json", tmp_path / "gait.json")
    assert code == 0, said
    with open(tmp_path / "gait.json") as file:
        written = json.load(file)
    assert amble.gait(recording) == amble.gait(recording.path) == written


def test_a_gait_of_more_seconds_than_were_recorded_is_refused_as_by_the_command_line(recording):
    code, said = program("gait", recording.path, "--seconds", 100)
    with pytest.raises(amble.Error, match="seconds = 100: it is 2 s long") as refused:
        amble.gait(recording, seconds=100)
    assert refused.value.exit_code == code and said == f"amble: {refused.value}\n"


def test_gait_takes_all_that_walks(run, tmp_path):
    assert amble.gait(run.folder) == amble.gait(run) == amble.gait(run.champion())
    run.champion().save(tmp_path / "walker.json")
    assert amble.gait(tmp_path / "walker.json") == amble.gait(run)


def test_overrides_may_be_any_mapping_and_paths_be_paths():
    overrides = types.MappingProxyType({"population": types.MappingProxyType({"size": 30}), "robot": amble.robots()["quadruped"]})
    config = amble.load_config(CONFIG, overrides)
    assert config["population.size"] == 30 and Path(config["robot"]).samefile(amble.robots()["quadruped"])


def test_a_champion_is_not_saved_among_those_of_a_run(run, tmp_path):
    champion, before = run.champion(), os.listdir(os.path.join(run.folder, "champions"))
    for name in (before[0], "mine.json", "../champions/mine.json"):
        with pytest.raises(amble.Error, match="a run keeps its own champions there"):
            champion.save(os.path.join(run.folder, "champions", name))
    with pytest.raises(amble.Error, match="a run keeps its own champions there"):
        champion.export(os.path.join(run.folder, "champions/00099.json"))
    assert os.listdir(os.path.join(run.folder, "champions")) == before
    assert run.champion().save(tmp_path / "champions/mine.json") == str(tmp_path / "champions/mine.json")


def test_a_folder_that_this_process_evolves_into_is_not_said_to_be_anothers(config, tmp_path):
    with pytest.raises(amble.Error, match="is in use by this process$"):
        amble.evolve(config, 1, out=tmp_path / "run", on_generation=lambda line: amble.resume(tmp_path / "run"))


def test_views_of_a_recording_outlive_it(recording):
    column = amble.Recording(recording.path)["com.x"]
    assert np.array_equal(column, recording["com.x"])


def test_novelty_runs_have_their_columns(tmp_path):
    run = amble.evolve(amble.load_config(NOVELTY, {**SMALL, "generations": 2}), 1, out=tmp_path / "run")
    assert "archive" in run.generations()


def test_a_champion_is_exported_and_its_gait_measured_as_by_the_command_line(tmp_path):
    config = amble.load_config(CONFIG, {**SMALL, "generations": 1})
    run = amble.evolve(config, 3, out=tmp_path / "run")
    champion = run.champion()
    assert champion.export(tmp_path / "walker.c") == str(tmp_path / "walker.c")
    assert "walker_step" in (tmp_path / "walker.h").read_text()
    assert champion.export(tmp_path / "fixed.c", fixed=True) and "FRACTION_BITS" in (tmp_path / "fixed.h").read_text()
    assert json.loads((tmp_path / champion.export(tmp_path / "walker.json")).read_text())["format"] == "amble-export"
    assert (tmp_path / champion.export(tmp_path / "robot.xml")).read_text().startswith("<!-- Written by amble. -->\n<mujoco")
    assert champion.export(tmp_path / "robot.xml")  # again
    own = tmp_path / "own.xml"
    own.write_text('<mujoco model="mine"/>')
    with pytest.raises(amble.Error, match="is not an MJCF model that amble wrote"):
        champion.export(own)
    assert own.read_text() == '<mujoco model="mine"/>'
    with pytest.raises(ValueError, match="ends in .c, .json or .xml"):
        champion.export(tmp_path / "walker.h")
    with pytest.raises(amble.Error, match="expected a letter"):
        champion.export(tmp_path / "2 legs.c")
    gait = champion.gait(undisturbed=True)
    champion.trial(record=tmp_path / "walk.rec")
    recorded = amble.gait(tmp_path / "walk.rec")  # in single precision
    assert gait["gait"] == recorded["gait"] and gait["distance_m"] == pytest.approx(recorded["distance_m"])
    assert amble.gait(champion) == champion.gait() == amble.gait(run)
