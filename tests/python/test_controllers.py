import amble
import numpy as np
import pytest

from conftest import CONFIG, SMALL, SOURCE, program

ALL = [CONFIG, CONFIG.parent / "sine-objective.toml", CONFIG.parent / "ctrnn-objective.toml",
       CONFIG.parent.parent / "paper/supg-objective.toml", CONFIG.parent.parent / "quick/oscillators.toml"]


@pytest.mark.parametrize("path", ALL)
def test_controllers_and_robots_walk_as_champions_do_to_the_bit(path, tmp_path):
    config = amble.load_config(path, {**SMALL, "generations": 1})
    champion = amble.evolve(config, 3, out=tmp_path / "run").champion()
    champion.trial(record=tmp_path / "walk.rec")
    recording = amble.Recording(tmp_path / "walk.rec")
    targets, com_x = recording.matching("target."), recording["com.x"]
    robots = amble.Robots(config, 3)
    controllers = amble.Controllers(config, [champion.genome] * 3)
    assert len(controllers) == 3
    for frame in range(len(recording)):
        if frame == 0 and config["trial.first_command"] == "after_first_step":
            wanted = np.zeros((3, len(robots.joints)), np.float32)
        else:
            wanted = controllers.step(robots.angle_rad, robots.touch, robots.attitude_rad)
        for robot in range(3):
            assert np.array_equal(wanted[robot], targets[frame])
        robots.step(wanted)
        assert (robots.com_m[:, 0] == com_x[frame]).all()


@pytest.mark.parametrize("first_command", ["before_first_step", "after_first_step"])
def test_controllers_that_sense_walk_as_champions_do_to_the_bit(first_command, tmp_path):
    supg = {"controller.supg.modulation.sensors": ["pitch", "speed.knee", "yaw_rate"], "controller.supg.modulation.rate": 1.0,
            "controller.supg.modulation.shape": 1.0, "controller.supg.seam.residual_s": 0.05}
    config = amble.load_config(CONFIG, {**SMALL, **supg, "generations": 1, "trial.first_command": first_command})
    champion = amble.evolve(config, 3, out=tmp_path / "run").champion()
    champion.trial(record=tmp_path / "walk.rec")
    targets = amble.Recording(tmp_path / "walk.rec").matching("target.")
    robots, controllers = amble.Robots(config, 1), amble.Controllers(config, [champion.genome])
    for frame in range(len(targets)):
        if frame == 0 and first_command == "after_first_step":
            wanted = robots.angle_rad.copy()
        else:
            wanted = controllers.step(robots.angle_rad, robots.touch, robots.attitude_rad)
        assert np.array_equal(wanted[0], targets[frame]), frame
        robots.step(wanted)


def test_controllers_that_sense_their_attitude_are_not_stepped_without(tmp_path):
    config = amble.load_config(CONFIG, {**SMALL, "controller.supg.modulation.sensors": ["pitch"], "controller.supg.modulation.rate": 1.0})
    controllers = amble.Controllers(config, amble.Search(config, 1).ask()[:1])
    with pytest.raises(ValueError, match="attitude_rad is missing: these controllers sense it"):
        controllers.step(np.zeros((1, 12)), np.ones((1, 4)))


STEERED = SOURCE / "robots/hexapod/steered.json"


def told_walk(command, ticks):
    """Targets, ways and headings of the mixed champion, tick by tick, told this in a loop of one's own."""
    config = amble.load_config(SOURCE / "robots/hexapod/steer.toml")
    robots, controllers = amble.Robots(config, 1), amble.Controllers(config, [amble.Champion(STEERED).genome])
    targets, ways_m, headings_rad = [], [], []
    for tick in range(ticks):
        if tick == 0:  # trial.first_command = "after_first_step"
            wanted = robots.angle_rad.copy()
        else:
            wanted = controllers.step(robots.angle_rad, robots.touch, robots.attitude_rad, command=[command(tick)])
        targets.append(wanted[0].copy())
        robots.step(wanted)
        ways_m.append(robots.com_m[0].copy())
        headings_rad.append(float(robots.attitude_rad[0, 2]))
    return np.array(targets), np.array(ways_m), np.unwrap(headings_rad)


def test_a_mixed_champion_that_is_told_walks_as_amble_trial_does_to_the_bit(tmp_path):
    code, said = program("trial", STEERED, "--undisturbed", "--seconds", "6", "--command", "0.2,0.3; 0.15,-0.2; 0,0", "--record",
                         tmp_path / "walk.rec")
    assert code == 0, said
    recording = amble.Recording(tmp_path / "walk.rec")
    assert len(recording) == 600
    targets, ways_m, _ = told_walk(lambda tick: (recording["command.speed"][tick], recording["command.turn"][tick]), 600)
    for tick in range(600):
        assert np.array_equal(targets[tick], recording.matching("target.")[tick]), tick
    for axis, name in enumerate(("com.x", "com.y")):
        assert np.array_equal(ways_m[:, axis], recording[name])


def test_a_mixed_champion_turns_as_it_is_told():
    # Told nothing is told to stop.
    turned_rad = {turn: told_walk(lambda tick: (0.2, turn), 800)[2][-1] for turn in (0.3, 0.0, -0.3)}
    assert turned_rad[0.3] > turned_rad[0.0] + 0.5 and turned_rad[-0.3] < turned_rad[0.0] - 0.5, turned_rad
    stood_m, went_m = (told_walk(lambda tick: (speed, 0.0), 800)[1][-1, 0] for speed in (0.0, 0.28))
    assert went_m > stood_m + 0.5, (stood_m, went_m)


def test_controllers_ask_for_readings_that_they_sense(config):
    sensing = amble.load_config(CONFIG, {**SMALL, "controller.supg.modulation.sensors": ["torque.knee", "load"],
                                         "controller.supg.modulation.rate": 1.0})
    controllers = amble.Controllers(sensing, amble.Search(sensing, 3).ask()[:2])
    angles, touch = np.zeros((2, 12)), np.zeros((2, 4))
    with pytest.raises(ValueError, match="torque_nm is missing: these controllers sense it"):
        controllers.step(angles, touch)
    assert controllers.step(angles, touch, torque_nm=angles, load_n=touch).shape == (2, 12)


def test_each_genome_has_its_own_controller_and_its_own_state(config):
    genomes = amble.Search(config, 3).ask()[:5]
    together, random = amble.Controllers(config, genomes), np.random.default_rng(1)
    alone = [amble.Controllers(config, [genome]) for genome in genomes]
    assert len(together.state_names) == 8
    for tick in range(50):
        if tick == 20:
            mask = np.array([True, False, True, False, False])
            together.reset(mask)
            [controllers.reset() for controllers, chosen in zip(alone, mask) if chosen]
        angles, touch = np.zeros((5, 12)), random.integers(0, 2, (5, 4))
        targets = together.step(angles, touch)
        for number, controllers in enumerate(alone):
            assert np.array_equal(controllers.step(angles[:1], touch[number:number + 1])[0], targets[number])
            assert np.array_equal(controllers.states[0], together.states[number])
    assert len(np.unique(targets, axis=0)) == 5 and not targets.flags.writeable


def test_targets_outlive_their_controllers(config):
    controllers = amble.Controllers(config, amble.Search(config, 3).ask())
    targets = controllers.step(np.zeros((24, 12)), np.ones((24, 4)))
    expected = targets.copy()
    del controllers
    junk = [np.ones(24 * 12, np.float32) for _ in range(100)]
    assert np.array_equal(targets, expected) and len(junk) == 100


def test_sensors_must_be_finite(config):
    controllers = amble.Controllers(config, amble.Search(config, 3).ask()[:2])
    for bad in (np.nan, np.inf):
        with pytest.raises(ValueError, match="touch: expected finite numbers"):
            controllers.step(np.zeros((2, 12)), np.full((2, 4), bad))
    with pytest.raises(ValueError, match="genomes: expected at least one"):
        amble.Controllers(config, [])
