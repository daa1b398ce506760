"""Processes forked from one that used amble, which is what multiprocessing does on Linux unless told otherwise; and pickles."""

import copy
import multiprocessing
import operator
import os
import pickle
import signal
import subprocess
import sys
import threading
import time

import amble
import numpy as np
import pytest

from conftest import CONFIG, NOVELTY, ROBOT, SMALL, SOURCE

TINY = {"engine": "batch", "population.size": 8, "trial.duration_s": 0.5}


def in_child(work, patience_s=60):
    """What `work` returns in a forked process, 0 to 250; it ends there as a script does. A child that hangs fails."""
    child = os.fork()
    if child == 0:
        signal.alarm(patience_s)
        code = 251
        try:
            code = int(work())
        finally:
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


@pytest.fixture(params=["ode", "batch", "mujoco"])
def engine(request):
    return request.param


@pytest.fixture
def search():
    return amble.Search(amble.load_config(NOVELTY, TINY), seed=5)


def test_evaluate_gives_a_forked_child_the_same_bits(search, engine):
    genomes = search.ask()
    evaluated = amble.evaluate(search, genomes, engine=engine, jobs=2)

    def again():
        other = amble.evaluate(search, genomes, engine=engine, jobs=2)
        return np.array_equal(other.objective, evaluated.objective) and np.array_equal(other.behaviour, evaluated.behaviour)

    assert in_child(again) == 1
    assert np.array_equal(amble.evaluate(search, genomes, engine=engine, jobs=2).objective, evaluated.objective)


def test_processes_of_multiprocessing_share_an_evaluation(search):
    genomes = search.ask()
    whole = amble.evaluate(search, genomes).objective
    parts = []
    for part in (0, 1):
        queue = multiprocessing.get_context("fork").SimpleQueue()
        process = multiprocessing.get_context("fork").Process(
            target=lambda: queue.put(amble.evaluate(search, genomes[part::2], jobs=1).objective))
        process.start()
        process.join(60)
        assert process.exitcode == 0
        parts.append(queue.get())
    assert np.array_equal(parts[0], whole[0::2]) and np.array_equal(parts[1], whole[1::2])


def test_all_that_has_no_robots_goes_on_in_a_child(search, tmp_path):
    config = amble.load_config(CONFIG, {**TINY, "generations": 2})
    run = amble.evolve(config, 1, out=tmp_path / "run")
    champion = run.champion()
    typical = champion.typical(trials=3)
    search.tell(amble.evaluate(search, search.ask()))
    controllers = amble.Controllers(search, search.ask()[:2])

    def work():
        search.tell(amble.evaluate(search, search.ask()))
        controllers.step(np.zeros((2, 12)), np.zeros((2, 4)))
        longer = amble.resume(run, generations=3)
        return champion.typical(trials=3) == typical and len(longer.generations()["best"]) == 3 and search.round == 2

    assert in_child(work) == 1
    assert search.round == 1


def test_objects_with_threads_are_given_up_by_a_child_that_ends_as_scripts_do(search):
    amble.evaluate(search, search.ask(), jobs=3)
    objects = [search, amble.Robots(ROBOT, 40, threads=2)]
    started = time.monotonic()

    def work():
        del objects[:]
        return 1

    assert in_child(work) == 1 and time.monotonic() - started < 30
    script = ("import amble, os, sys\n"
              f"search = amble.Search(amble.load_config({str(NOVELTY)!r}, {TINY!r}))\n"
              f"robots = amble.Robots({str(ROBOT)!r}, 40, threads=2)\n"
              "amble.evaluate(search, search.ask(), jobs=2)\n"
              "child = os.fork()\n"
              "if child: sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
              "amble.evaluate(search, search.ask(), jobs=2)\n"
              "sys.exit(17)\n")
    assert subprocess.run([sys.executable, "-c", script], timeout=60).returncode == 17


def test_robots_say_that_they_stay_behind_and_how_to_go_on():
    robots = amble.Robots(ROBOT, 40, threads=2)

    def work():
        for use in (lambda: robots.step(np.zeros((40, 12))), robots.reset, robots.state_hashes):
            try:
                use()
                return 2
            except RuntimeError as error:
                if "make new ones" not in str(error) or "spawn" not in str(error):
                    return 3
        amble.Robots(ROBOT, 40, threads=2).step(np.zeros((40, 12)))
        return 1

    assert in_child(work) == 1


def test_a_child_forked_in_the_middle_of_a_call_gets_an_error_and_does_not_hang(search):
    slow = amble.Problem(search.config.replace({"trial.duration_s": 20.0, "engine": "ode"}))
    genomes = search.ask()
    thread = threading.Thread(target=lambda: amble.evaluate(slow, genomes * 20, jobs=1))
    thread.start()
    time.sleep(0.3)

    def work():
        try:
            amble.evaluate(slow, genomes[:1], jobs=1)
            return 2
        except RuntimeError as error:
            return "forked while another thread" in str(error)

    busy = thread.is_alive()
    code = in_child(work)
    thread.join()
    assert busy and code == 1


@pytest.mark.parametrize("preset, overrides", [("authors/supg-objective", {}), ("authors/supg-novelty", {}), ("quick/oscillators", {}), (
    "repertoire/quadruped", {"search.kind": "map-elites", "search.map_elites.batch": 8, "search.map_elites.initial": 8})])
def test_a_pickled_search_goes_on_to_the_bit(preset, overrides):
    search = amble.Search(amble.load_config(SOURCE / f"configs/{preset}.toml", {**TINY, **overrides}), seed=9)
    for _ in range(3):
        search.tell(amble.evaluate(search, search.ask()))
    other, twin = pickle.loads(pickle.dumps(search)), copy.deepcopy(search)
    assert other.round == 3 and other.config["seed"] == 9
    assert any(search.metrics.values()) and other.metrics == twin.metrics == search.metrics
    for _ in range(2):
        assert other.ask() == search.ask() == twin.ask()
        for each in (search, other, twin):
            each.tell(amble.evaluate(each, each.ask()))
    assert other.metrics == search.metrics and pickle.dumps(other) == pickle.dumps(search)


def test_a_spoilt_pickle_is_refused(search):
    constructor, arguments, *rest = search.__reduce_ex__(2)
    state = rest[0]
    for spoilt in (state[:2], (state[0], state[1][:-1], state[2]), (state[0], state[1], []),
                   (state[0].replace({"population.size": 9}), state[1], state[2])):
        with pytest.raises((amble.Error, ValueError)):
            constructor(*arguments).__setstate__(spoilt)


def test_pickles_need_no_files_and_keep_everything(run, recording, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    config = amble.load_config(NOVELTY, {**TINY, "name": 'a "b" \\ ü'})
    other = pickle.loads(pickle.dumps(config))
    assert other.to_toml() == config.to_toml()
    assert other.replace({"population.size": 50}).to_toml() == config.replace({"population.size": 50}).to_toml()
    problem = pickle.loads(pickle.dumps(amble.Problem(config, seed=2)))
    assert problem.config["seed"] == 2
    champion = pickle.loads(pickle.dumps(run.champion()))
    assert champion.facts == run.champion().facts and champion.trial() == run.champion().trial()
    assert pickle.loads(pickle.dumps(run)).folder == run.folder
    walk = pickle.loads(pickle.dumps(recording))
    assert np.array_equal(walk.frames, recording.frames) and amble.gait(walk) == amble.gait(recording)
    with pytest.raises(TypeError):
        pickle.dumps(amble.Robots(ROBOT))
    for each in (config, champion, run, walk, amble.Robots(ROBOT)):
        for protocol in (0, 1):  # which make an instance of the base of all classes
            with pytest.raises(TypeError, match="protocol of 2 or more"):
                pickle.dumps(each, protocol)


def test_spawned_processes_take_what_can_be_pickled(run, search):
    champion = run.champion()
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        assert pool.apply_async(operator.methodcaller("trial"), (champion,)).get(60) == champion.trial()
        assert pool.apply_async(operator.methodcaller("ask"), (search,)).get(60) == search.ask()


def test_functions_of_the_module_are_called_in_other_processes(run, search):
    for name in amble.__all__:
        assert pickle.loads(pickle.dumps(getattr(amble, name))) is getattr(amble, name), name
    assert pickle.loads(pickle.dumps([3, 1].count))(3) == 1 and pickle.loads(pickle.dumps(len)) is len
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply_async(amble.evaluate, (search, search.ask()[:3]), {"jobs": 1}).get(60)
        assert pool.apply_async(amble.compare, ([run.champion()], [1.0], ["batch"])).get(60)
        with pytest.raises(amble.Error, match="no/such.toml"):
            pool.apply_async(amble.load_config, ("no/such.toml",)).get(60)
    np.testing.assert_array_equal(there.objective, amble.evaluate(search, search.ask()[:3], jobs=1).objective)
