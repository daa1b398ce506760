import gc
import os
import threading

import amble
import numpy as np
import pytest

from conftest import CONFIG, ROBOT


def swing(robots, tick, n=None):
    n = n or len(robots)
    middle, half = (robots.upper_rad + robots.lower_rad) / 2, (robots.upper_rad - robots.lower_rad) / 2
    phase = np.arange(n)[:, None] * 0.1 + np.arange(len(middle)) * 0.7 + tick * 0.06
    return (middle + 0.6 * half * np.sin(phase)).astype(np.float32)


@pytest.mark.parametrize("engine", ["batch", "ode", "mujoco"])
def test_recorded_targets_give_the_recorded_walk_to_the_bit(run, config, engine, tmp_path):
    run.champion().trial(record=tmp_path / "walk.rec", engine=engine)
    recording = amble.Recording(tmp_path / "walk.rec")
    robots = amble.Robots(config, 3, engine)
    targets, angles = recording.matching("target."), recording.matching("angle.")
    com = np.stack([recording["com." + axis] for axis in "xyz"], axis=1)
    for frame in range(len(recording)):
        robots.step(np.repeat(targets[frame:frame + 1], 3, axis=0))
        for robot in range(3):
            assert np.array_equal(robots.angle_rad[robot], angles[frame])
            assert np.array_equal(robots.com_m[robot], com[frame])


@pytest.mark.parametrize("engine", ["batch", "ode"])
def test_no_bit_depends_on_threads_or_neighbours(engine):
    n = 37
    groups = [amble.Robots(ROBOT, n, engine, threads=threads) for threads in (1, 2, 3)]
    alone = amble.Robots(ROBOT, 1, engine)
    for tick in range(60):
        targets = swing(groups[0], tick)
        for robots in groups:
            robots.step(targets)
        alone.step(targets[20:21])
    hashes = [robots.state_hashes().tolist() for robots in groups]
    assert hashes[0] == hashes[1] == hashes[2] and hashes[0][20] == alone.state_hashes()[0]
    assert len(set(hashes[0])) == n


@pytest.mark.parametrize("engine", ["batch", "ode", "mujoco"])
def test_forces_are_measured_where_asked_for_and_change_no_bit(engine):
    plain, measured = amble.Robots(ROBOT, 3, engine), amble.Robots(ROBOT, 3, engine, forces=True)
    torque, load = measured.torque_nm, measured.load_n
    assert torque.shape == (3, len(measured.joints)) and load.shape == (3, len(measured.legs))
    for tick in range(200):
        targets = swing(plain, tick, 3) * (tick > 100)  # it stands, then moves
        plain.step(targets)
        measured.step(targets)
        if tick == 99:  # at rest the ground carries the weight
            assert load.sum(axis=1) == pytest.approx(5.4 * 9.81, rel=0.2)
    assert plain.state_hashes().tolist() == measured.state_hashes().tolist()
    assert np.abs(torque).max() > 0.1 and not torque.flags.writeable
    for name in ("torque_nm", "load_n"):
        with pytest.raises(ValueError, match="forces=True"):
            getattr(plain, name)


def test_amble_s_own_robots_go_by_name():
    own = amble.robots()
    assert {"quadruped", "quadruped/paper", "biped", "hexapod", "octopod", "servo"} <= set(own)
    for name, path in own.items():
        assert np.array_equal(amble.Robots(name).state_hashes(), amble.Robots(path).state_hashes())
    assert len(amble.Robots("hexapod").legs) == 6
    with pytest.raises(amble.Error, match="no robot 'heptapod': expected the path of a robot file, or one of biped, "):
        amble.Robots("heptapod")


def test_a_folder_of_a_robot_s_name_does_not_hide_it(tmp_path, monkeypatch):
    (tmp_path / "hexapod").mkdir()
    monkeypatch.chdir(tmp_path)
    assert len(amble.Robots("hexapod").legs) == 6


def test_an_engine_that_cannot_damage_a_robot_refuses_a_config_that_does():
    config = amble.load_config(CONFIG, {"damage.parts": [{"kind": "missing", "leg": "FL"}]})
    assert amble.Robots(config).touch.tolist() == [[0.0, 1.0, 1.0, 1.0]]
    with pytest.raises(amble.Error, match="mujoco-model simulates the robot's own model, which is whole"):
        amble.Robots(config, engine="mujoco-model")


def test_views_are_live_and_without_copies():
    robots = amble.Robots(ROBOT, 20)
    observations, angle, com, fallen = robots.observations, robots.angle_rad, robots.com_m, robots.fallen
    before = observations.copy()
    returned = robots.step(swing(robots, 0))
    for view in (angle, com, robots.touch, robots.attitude_rad, returned):
        assert np.shares_memory(view, observations) and not view.flags.writeable and not view.flags.owndata
    assert not np.array_equal(before, observations) and np.array_equal(angle, observations[:, :12])
    assert fallen.dtype == bool and fallen.shape == (20,)


def test_views_outlive_their_robots():
    robots = amble.Robots(ROBOT, 64)
    robots.step(swing(robots, 0))
    com, diverged = robots.com_m, robots.diverged
    expected = com.copy()
    del robots
    gc.collect()
    junk = [np.ones(64 * 22, np.float32) for _ in range(100)]
    assert np.array_equal(com, expected) and not diverged.any() and len(junk) == 100


def test_reset_places_only_the_masked():
    robots, fresh = amble.Robots(ROBOT, 20), amble.Robots(ROBOT, 20)
    for tick in range(30):
        robots.step(swing(robots, tick))
    mask = np.arange(20) % 3 == 0
    moved = robots.state_hashes()
    robots.reset(mask)
    after = robots.state_hashes()
    assert np.array_equal(after[mask], fresh.state_hashes()[mask]) and np.array_equal(after[~mask], moved[~mask])
    assert np.array_equal(robots.reset(), fresh.observations)


def test_strides_and_types_of_targets_make_no_difference():
    plain, other = amble.Robots(ROBOT, 20), amble.Robots(ROBOT, 20)
    for tick in range(5):
        targets = swing(plain, tick)
        plain.step(targets)
        wide = np.zeros((40, 24), np.float64)
        wide[::2, ::2] = targets
        other.step([np.asfortranarray(targets), wide[::2, ::2], targets.tolist(), targets[::-1][::-1],
                    targets.astype(">f4")][tick])
    assert np.array_equal(plain.state_hashes(), other.state_hashes())


def test_robots_lie_low_are_fallen_and_targets_are_clamped():
    robots, bounded = amble.Robots(ROBOT, 16), amble.Robots(ROBOT, 16)
    for _ in range(100):
        robots.step(np.full((16, 12), np.inf, np.float32))
        bounded.step(np.full((16, 12), 1e9, np.float32))
    assert np.array_equal(robots.state_hashes(), bounded.state_hashes())
    assert np.isfinite(robots.observations).all()
    with pytest.raises(ValueError, match="found NaN"):
        robots.step(np.full((16, 12), np.nan))


def test_two_threads_may_step_the_same_robots():
    robots, counted = amble.Robots(ROBOT, 40), amble.Robots(ROBOT, 40)
    targets = swing(robots, 0)

    def work():
        for _ in range(100):
            robots.step(targets)

    threads = [threading.Thread(target=work) for _ in range(3)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    for _ in range(300):
        counted.step(targets)
    assert np.array_equal(robots.state_hashes(), counted.state_hashes())


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_ten_thousand_steps_leak_nothing():
    robots = amble.Robots(ROBOT, 16)
    targets, mask = swing(robots, 0).astype(np.float64), np.arange(16) < 2

    def work(steps):
        for step in range(steps):
            robots.step(targets)
            robots.com_m, robots.fallen
            if step % 100 == 0:
                robots.reset(mask)
            if step % 500 == 0:
                amble.Robots(ROBOT, 17, threads=2)

    work(1000)
    gc.collect()
    before = resident_bytes()
    work(10000)
    gc.collect()
    assert resident_bytes() - before < 4 << 20


def test_a_child_process_is_refused():
    robots = amble.Robots(ROBOT, 40, threads=2)
    child = os.fork()
    if child == 0:
        try:
            robots.step(swing(robots, 0))
        except RuntimeError:
            os._exit(0)
        os._exit(1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
