import pickle
import threading

import amble
import numpy as np
import pytest

from conftest import CONFIG, NOVELTY, SMALL, SOURCE


def evolved(config, seed, folder):
    run = amble.evolve(config, seed, out=folder)
    return run.generations()["best"].tolist(), run.champion().genome, run.generations()


@pytest.mark.parametrize("path, more", [(CONFIG, {}), (NOVELTY, {}),
                                        # The loop below keeps the best evaluation.
                                        (CONFIG.parent.parent / "robust/supg-objective.toml", {"champion.episodes": 0})])
def test_ask_and_tell_evolves_what_evolve_does(path, more, tmp_path):
    config = amble.load_config(path, {**SMALL, **more})
    best, champion, table = evolved(config, 5, tmp_path / "run")
    search = amble.Search(config, 5)
    bests, found = [], (-1.0, None)
    for generation in range(4):
        genomes = search.ask()
        objective, behaviour = amble.evaluate(search, genomes)
        bests.append(objective.max())
        if objective.max() > found[0]:
            found = (objective.max(), genomes[int(objective.argmax())])
        search.tell(objective, behaviour)
        assert search.metrics["species"] == table["species"][generation]
    assert bests == best
    assert found[1].digest == champion.digest and found[1] == champion
    assert search.round == 4


def test_map_elites_by_ask_and_tell_keeps_what_evolve_keeps(tmp_path):
    config = amble.load_config(SOURCE / "configs/repertoire/quadruped.toml",
                               {"trial.duration_s": 2.0, "generations": 3, "search.map_elites.batch": 24,
                                "search.map_elites.initial": 24})
    _, _, table = evolved(config, 5, tmp_path / "run")
    search = amble.Search(config, 5)
    for generation in range(3):
        search.tell(amble.evaluate(search, search.ask()))
        for name, value in search.metrics.items():
            assert value == table[name][generation], name


def test_a_round_is_told_once():
    search = amble.Search(amble.load_config(SOURCE / "configs/authors/supg-objective.toml", SMALL), 5)
    with pytest.raises(ValueError, match="tell: round 0 has not been asked for"):
        search.tell([1.0] * SMALL["population.size"])
    worth = [1.0] * len(search.ask())
    search.tell(worth)
    with pytest.raises(ValueError, match="tell: round 1 has not been asked for"):
        search.tell(worth)
    search.ask()
    search = pickle.loads(pickle.dumps(search))
    search.tell(worth)
    assert search.round == 2


def test_who_is_not_viable_gets_no_cell_of_a_map():
    config = amble.load_config(SOURCE / "configs/repertoire/quadruped.toml",
                               {"trial.duration_s": 2.0, "search.map_elites.batch": 24, "search.map_elites.initial": 24,
                                "search.map_elites.trials": 1})
    filled = []
    for some in (True, False):
        search = amble.Search(config, 5)
        evaluation = amble.evaluate(search, search.ask())
        assert evaluation.viable.dtype == bool and evaluation.viable.all()
        objective, behaviour = evaluation
        search.tell(objective, behaviour, viable=evaluation.viable & some)
        filled.append(search.metrics)
    assert filled[0] != filled[1]
    search.ask()
    with pytest.raises(TypeError, match="viable"):
        search.tell(objective, behaviour, viable=objective)
    with pytest.raises(TypeError, match="has its behaviour and viable already"):
        search.tell(evaluation, behaviour)


def test_evaluate_does_not_depend_on_jobs_or_on_what_else_is_evaluated(config):
    problem = amble.Problem(config, 5)
    genomes = amble.Search(config, 5).ask()
    together, _ = amble.evaluate(problem, genomes, jobs=2)
    assert together.tolist() == amble.evaluate(problem, genomes, jobs=1)[0].tolist()
    assert together[3] == amble.evaluate(problem, genomes[3:4], jobs=3)[0][0]
    assert amble.evaluate(problem, [])[0].shape == (0,)


def test_other_engines_judge_the_same_genomes_otherwise(config):
    problem = amble.Problem(config)
    genomes = amble.Search(config).ask()[:3]
    home, ode = (amble.evaluate(problem, genomes, engine=engine)[0] for engine in ("batch", "ode"))
    assert home.shape == ode.shape == (3,) and not np.array_equal(home, ode)
    with pytest.raises(amble.Error, match="unknown engine 'bullet': expected ode, batch, mujoco"):
        amble.evaluate(problem, genomes, engine="bullet")


def test_behaviours_are_paths_where_the_search_compares_them():
    config = amble.load_config(NOVELTY, SMALL)
    search = amble.Search(config)
    objective, behaviour = amble.evaluate(search, search.ask())
    assert behaviour.shape == (24, search.behaviour_length) and behaviour.dtype == np.float32
    assert search.behaviour_length > 0 and objective.dtype == np.float64
    with pytest.raises(ValueError, match="this search compares behaviours"):
        search.tell(objective)
    search.tell(objective, behaviour.astype(np.float64)[:, ::-1][:, ::-1])  # strides, dtypes: converted
    assert search.round == 1


def test_own_fitness_drives_the_search(config):
    search = amble.Search(config, 3)
    for _ in range(6):
        genomes = search.ask()
        search.tell([len(genome.to_dict()["links"]) for genome in genomes])
    assert search.metrics["mean_links"] > amble.Search(config, 3).metrics["mean_links"]


@pytest.mark.parametrize("damage", [[], [{"kind": "locked", "joint": "FL_knee", "angle_rad": -0.2}, {"kind": "numb", "leg": "FR"},
                                         {"kind": "weak", "joint": "BL_knee", "share": 0.3, "from_s": 0.7},
                                         {"kind": "numb", "leg": "BL", "from_s": 0.7}]])
def test_a_loop_over_robots_that_first_holds_for_a_step_gives_the_distances_of_trials(damage):
    config = amble.load_config(amble.data_folder() / "configs/authors/supg-objective.toml", {
        "engine": "batch", "population.size": 16, "speciation.target_min": 1, "speciation.target_max": 3,
        "trial.duration_s": 2.0, "damage.parts": damage})
    search = amble.Search(config, seed=1)
    genomes = search.ask()
    distance_m, _ = amble.evaluate(search, genomes)
    robots, controllers = amble.Robots(config, n=16), amble.Controllers(search, genomes)
    robots.reset()
    start_m = robots.com_m.copy()
    robots.step(robots.angle_rad)  # first_command = "after_first_step"
    for _ in range(199):
        robots.step(controllers.step(robots.angle_rad, robots.touch, robots.attitude_rad))
        assert not robots.fallen.any()
    np.testing.assert_allclose(np.hypot(*(robots.com_m - start_m)[:, :2].T), distance_m, rtol=1e-6)


def test_wrong_fitness_is_refused_and_changes_nothing(config):
    search = amble.Search(config, 3)
    before = [genome.digest for genome in search.ask()]
    for fitness in ([1.0] * 23, [[1.0]] * 24, [-1.0] * 24, [float("nan")] * 24, ["a"] * 24, None, [1j] * 24):
        with pytest.raises((TypeError, ValueError)):
            search.tell(fitness)
    assert search.round == 0 and [genome.digest for genome in search.ask()] == before


def test_genomes_survive_dicts_and_pickles(config):
    genome = amble.Search(config, 3).ask()[5]
    for copy in (amble.Genome(genome.to_dict()), pickle.loads(pickle.dumps(genome))):
        assert copy == genome and copy.digest == genome.digest and hash(copy) == hash(genome)
    broken = genome.to_dict()
    broken["links"][0]["to"] = 999
    with pytest.raises(amble.Error, match="names node 999"):
        amble.Genome(broken)
    with pytest.raises(amble.Error, match="genomes\\[0\\]"):
        amble.evaluate(config, amble.Search(NOVELTY.parent / "ctrnn-novelty.toml").ask()[:1])


@pytest.mark.parametrize("change, why", [
    (lambda d: {**d, "foo": 1}, "unknown key 'foo': expected nodes, links"),
    (lambda d: {**d, "nodes": [{**d["nodes"][0], "foo": 1}, *d["nodes"][1:]]}, r"nodes\[0\]: unknown key 'foo'"),
    (lambda d: {**d, "links": [{**d["links"][0], "foo": 1}, *d["links"][1:]]}, r"links\[0\]: unknown key 'foo'"),
    (lambda d: {**d, "links": [*d["links"], d["links"][0]]}, "out of order"),
    (lambda d: {**d, "links": [*d["links"], {**d["links"][0], "innovation": 10**6}]}, "a second time"),
    (lambda d: {**d, "links": [d["links"][0], {**d["links"][1], "weight": np.float32("nan")}]}, r"'links\[1\].weight' must be a finite number"),
    (lambda d: {**d, "a\ud800": float("nan")}, r"'a\\ud800' must be a finite number")])
def test_a_genome_of_other_keys_or_numbers_or_with_a_link_twice_is_refused(config, change, why):
    with pytest.raises(amble.Error, match=why):
        amble.Genome(change(amble.Search(config).ask()[0].to_dict()))


def test_a_champion_of_a_search_names_the_round_that_gave_it_or_is_refused(config):
    search = amble.Search(config, 3)
    first = search.ask()
    search.tell([1.0] * 23 + [0.0])
    search = pickle.loads(pickle.dumps(search))
    origins = [(champion.facts["generation"], champion.facts["index"])
               for champion in (search.champion(first[23]), search.champion(search.ask()[7]))]
    assert origins == [(0, 23), (1, 7)]
    stranger = first[0].to_dict()
    stranger["links"][0]["weight"] = 0.125
    for genome in (amble.Genome(stranger), amble.Search(config, 4).ask()[0]):
        with pytest.raises(amble.Error, match="this search never gave it; expected one of ask()"):
            search.champion(genome)


def test_two_threads_share_a_search_and_a_problem(config):
    search, problem = amble.Search(config, 3), amble.Problem(config, 3)
    genomes = search.ask()
    expected = amble.evaluate(problem, genomes)[0].tolist()
    failures, round_ = [], threading.Lock()

    def work():
        try:
            for _ in range(5):
                assert amble.evaluate(problem, genomes, jobs=2)[0].tolist() == expected
                with round_:
                    assert len(search.ask()) == len(expected)
                    search.tell(expected)
        except Exception as error:
            failures.append(error)

    threads = [threading.Thread(target=work) for _ in range(2)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert not failures and search.round == 10
