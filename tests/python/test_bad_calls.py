"""Seeded calls, each with at least one argument that is wrong: all raise, none crashes, and the objects work on."""

import os
import random

import amble
import numpy as np

from conftest import CONFIG, ROBOT

ANY = [object(), 3.5, b"bytes", {1: 2}, [[1], [2, 3]], lambda: None, np.zeros(3), amble]
NO_NUMBER = [object(), "three", b"x", [], {}, np.zeros(3), 1j, 10**30, -(10**30)]
NO_PATH = [None, 3, 2.5, b"bytes", [], "no/such/file", "a\0b", "", "/proc/self/mem"]


def no_array(rows, columns):
    return [None, "text", object(), 3.0, [], np.zeros((rows, columns + 1)), np.zeros((rows + 1, columns)), np.zeros(rows),
            np.zeros((rows, columns, 1)), np.zeros((0, columns)), np.full((rows, columns), np.nan),
            np.full((rows, columns), "a"), np.zeros((rows, columns), complex), np.zeros((rows, columns), object),
            np.zeros((rows, columns), "datetime64[s]"), np.zeros((columns, rows)).T[::2], [[1.0] * columns, [1.0]],
            np.zeros((rows, columns), [("x", float)])]


def no_vector(n):
    return [None, "text", 1.0, [], np.zeros(n + 1), np.zeros((n, 1)), np.full(n, np.nan), np.full(n, np.inf),
            np.full(n, -1.0), np.zeros(n, complex), ["a"] * n, [None] * n, object(), np.zeros((1, n))]


def calls(config, run, recording):
    """(function, right arguments by name, wrong values by name)."""
    search, problem, robots = amble.Search(config, 1), amble.Problem(config), amble.Robots(ROBOT, 5)
    genomes, genome = search.ask(), search.ask()[0].to_dict()
    controllers = amble.Controllers(problem, genomes[:5])
    no_config = [None, 3, [], b"x", "no/such.toml", {}, object()]
    no_engine = ["bullet", "", 3, [], object(), "batch\0"]
    endless, endless_table = [], {}
    endless.append(endless)
    endless_table["size"] = endless_table
    bad_overrides = [3, "population.size=3", [], {"population.size": "many"}, {"no.such": 1}, {1: 2}, {"engine": None},
                     {"": 1}, {"population.size": object()}, {"population..size": 1}, {"population.size": float("nan")},
                     {"population.size": np.longdouble(3)}, {"population.size": endless}, {"population": endless_table},
                     {"population.size=7 # more": 9}, {"damage.parts": [{'kind = "missing", leg': "FL"}]}, {"name": "\ud800"}]
    bad_jobs = [0, -1, 5000] + NO_NUMBER
    bad_genomes = [None, 3, [1], ["a"], [genome], [None], "text", [genomes[0], 3], np.zeros(3), object()]
    bad_genome = [None, 3, [], {}, {"nodes": []}, {"links": []}, {**genome, "nodes": 3}, {**genome, "links": [3]}, "text",
                  {**genome, "nodes": [{"id": -1}]}, {"nodes": {1, 2}}, {"nodes": float("nan")}]
    bad_mask = [np.zeros(4, bool), np.zeros(5), [1, 0, 1, 0, 1], "text", np.zeros((5, 1), bool), 3, object(), True]
    return [
        (amble.load_config, {"path": CONFIG, "overrides": {}}, {"path": NO_PATH, "overrides": bad_overrides}),
        (config.replace, {"overrides": {}}, {"overrides": bad_overrides}),
        (config.__getitem__, {"key": "name"}, {"key": ["no", "name.name", 3, None, "", ".", b"x"]}),
        (amble.Run, {"folder": run.folder}, {"folder": NO_PATH}),
        (amble.Champion, {"path": run.folder}, {"path": NO_PATH}),
        (amble.Recording, {"path": recording.path}, {"path": NO_PATH}),
        (recording.__getitem__, {"column": "com.x"}, {"column": ["com.w", 3, None, -1, b"x", slice(2), ""]}),
        (recording.matching, {"prefix": "a"}, {"prefix": [3, None, [], b"\xff"[1:] or 2.5]}),
        (amble.gait, {"recording": recording, "seconds": 1.0}, {"recording": NO_PATH + [config],
                                                               "seconds": [0.0, -1.0, float("nan"), "x", [], 1e9]}),
        (run.champion().trial, {"seconds": 0.5, "engine": "batch", "record": None},
         {"seconds": [0, -1.0, float("nan"), float("inf"), "x", []], "engine": no_engine,
          "record": [3, b"x", "/dev/null/x", "a\0b", run.folder, str(ROBOT)]}),
        (run.champion().export, {"path": run.folder + "-walker.json"},
         {"path": [3, b"x", "/dev/null/x.c", "a\0b", run.folder, str(ROBOT), run.folder + "-2 legs.c", run.folder + "-walker.h"]}),
        (amble.evolve, {"config": config, "seed": 1, "out": run.folder + "-new", "jobs": 1},
         {"config": no_config, "seed": [-1, 1 << 60] + NO_NUMBER, "jobs": bad_jobs, "on_generation": [3, "x", []],
          "out": [3, None, b"x", "/proc/no", "a\0b", CONFIG]}),
        (amble.resume, {"run": run}, {"run": NO_PATH, "generations": [0, -1, 1, 1 << 40, "x"], "jobs": bad_jobs,
                                      "on_generation": [3, "x"]}),
        (amble.Search, {"config": config, "seed": 1}, {"config": no_config, "seed": [-1, 1 << 60] + NO_NUMBER}),
        (amble.Problem, {"config": config, "seed": 1}, {"config": no_config, "seed": [-1, 1 << 60] + NO_NUMBER}),
        (search.tell, {"fitness": np.ones(24)}, {"fitness": no_vector(24), "viable": no_vector(24)[1:]}),
        (amble.evaluate, {"problem": problem, "genomes": genomes[:2], "jobs": 1},
         {"problem": no_config + [run], "genomes": bad_genomes, "engine": no_engine, "jobs": bad_jobs,
          "generation": [-1, 1 << 40, "x", 10**9]}),
        (amble.Genome, {"dict": genome}, {"dict": bad_genome}),
        (amble.Robots, {"robot": ROBOT, "n": 2, "engine": "batch"},
         {"robot": NO_PATH + [run, CONFIG], "n": [0, -1, 1 << 30] + NO_NUMBER, "engine": no_engine + [None],
          "timestep_s": [0.0, -1.0, float("nan"), 1e9, "x"], "threads": [0, -1, 5000, "x"]}),
        (amble.Controllers, {"problem": problem, "genomes": genomes[:2]},
         {"problem": no_config + [run], "genomes": bad_genomes + [[]]}),
        (controllers.step, {"angle_rad": np.zeros((5, 12)), "touch": np.ones((5, 4))},
         {"angle_rad": no_array(5, 12), "touch": no_array(5, 4), "attitude_rad": no_array(5, 3)[1:]}),
        (controllers.reset, {"mask": None}, {"mask": bad_mask}),
        (amble.view, {"champion": recording}, {"champion": NO_PATH, "seconds": [0, -1.0, float("nan"), "x", [], 1.0],
                                               "engine": no_engine, "height": [0, -1, "x", 1.5, None],
                                               "level": ["x", 1, [], "micro"], "noise": NO_PATH + [run, CONFIG],
                                               "trials": [-1, "x", 1 << 40, 5], "history": [True, "x"],
                                               "title": [1, []]}),
        (robots.step, {"targets": np.zeros((5, 12))}, {"targets": no_array(5, 12)}),
        (robots.reset, {"mask": None}, {"mask": bad_mask}),
    ]


def test_a_thousand_wrong_calls_raise_and_none_crashes(config, run, recording):
    chance = random.Random(15)
    table = calls(config, run, recording)
    robots = amble.Robots(ROBOT, 5)
    before = robots.state_hashes().tolist()
    for number in range(1000):
        function, right, wrong = chance.choice(table)
        arguments = dict(right)
        for name in chance.sample(sorted(wrong), chance.randint(1, len(wrong))):
            arguments[name] = chance.choice(wrong[name])
        if chance.random() < 0.05:
            arguments["no_such_argument"] = chance.choice(ANY)
        try:
            function(**arguments)
        except (amble.Error, TypeError, ValueError, KeyError, IndexError, OverflowError) as error:
            assert str(error), (function, arguments)
        else:
            raise AssertionError((number, function, arguments))
    assert not os.path.exists(run.folder + "-new")
    assert robots.state_hashes().tolist() == before
    for function, right, _ in table:
        function(**right)


def test_objects_that_were_never_made_raise():
    for kind in (amble.Config, amble.Run, amble.Champion, amble.Recording, amble.Search, amble.Problem, amble.Genome,
                 amble.Robots, amble.Controllers):
        empty = kind.__new__(kind)
        for name in ("to_dict", "generations", "trial", "frames", "ask", "config", "digest", "step", "observations"):
            try:
                member = getattr(empty, name)
                member(*([] if name != "step" else [np.zeros((1, 12))]))
            except (TypeError, AttributeError, RuntimeError):
                continue
            raise AssertionError((kind, name))
