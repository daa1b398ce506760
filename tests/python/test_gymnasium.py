"""The adapter against a stand-in with the few names that it uses: Debian 12 has no Gymnasium."""

import enum
import importlib
import os
import re
import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest

import amble
from conftest import CONFIG, ROBOT

STEERED = str(Path(__file__).parents[2] / "robots/hexapod/steered.json")


def amble_says(*words):
    return subprocess.run([os.environ["AMBLE_PROGRAM"], *words], check=True, capture_output=True, text=True).stdout


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"


class VectorEnv:
    def reset(self, *, seed=None, options=None):
        self.seed = seed


class Box:
    def __init__(self, low, high, shape=None, dtype=np.float32):
        self.low, self.high, self.shape, self.dtype = low, high, shape or np.shape(low), dtype


class Replayed:
    """One robot that moves as it was recorded."""

    timestep_s = 0.01

    def __init__(self, com_m, yaw):
        self.all_m, self.yaw = com_m, yaw
        self.com_m, self.attitude_rad = np.zeros((1, 3), np.float32), np.zeros((1, 3), np.float32)

    def __len__(self):
        return 1

    def at(self, frame):
        self.com_m[0, :2], self.attitude_rad[0, 2] = self.all_m[frame] - self.all_m[0], self.yaw[frame]


@pytest.fixture
def adapter(monkeypatch):
    names = {"gymnasium": {"spaces": types.SimpleNamespace(Box=Box)},
             "gymnasium.vector": {"AutoresetMode": AutoresetMode, "VectorEnv": VectorEnv},
             "gymnasium.vector.utils": {"batch_space": lambda space, n: (space, n)}}
    for name, content in names.items():
        module = types.ModuleType(name)
        vars(module).update(content)
        monkeypatch.setitem(sys.modules, name, module)
    yield importlib.import_module("amble.gymnasium")
    sys.modules.pop("amble.gymnasium")


def test_episodes_are_truncated_and_begin_anew_with_the_next_step(adapter):
    env = adapter.RobotsEnv(ROBOT, 20, max_ticks=10)
    first, _ = env.reset(seed=1)
    assert first.shape == (20, 19) == (20, *env.single_observation_space.shape)
    still = np.zeros((20, 12), np.float32)
    for tick in range(1, 11):
        observations, rewards, terminated, truncated, _ = env.step(still)
        assert truncated.all() == (tick == 10) and not terminated.any() and rewards.shape == (20,)
    observations, rewards, terminated, truncated, _ = env.step(still)
    assert np.array_equal(observations, first) and not rewards.any() and not (terminated | truncated).any()


def test_rewards_add_up_to_the_way_along_x(adapter):
    env = adapter.RobotsEnv(ROBOT, 20)
    env.reset()
    start = env.robots.com_m.copy()
    targets = np.random.default_rng(1).uniform(env.robots.lower_rad, env.robots.upper_rad, (100, 20, 12))
    total, whole = np.zeros(20), np.ones(20, bool)
    for target in targets:
        _, rewards, terminated, truncated, _ = env.step(target)
        total += rewards
        whole &= ~(terminated | truncated)
    assert whole.any()
    assert np.allclose(total[whole], (env.robots.com_m - start)[whole, 0], atol=1e-5)


def test_rewards_of_commands_are_the_programs_tracking_second_by_second(adapter, tmp_path):
    walk = str(tmp_path / "walk.rec")
    said = amble_says("trial", STEERED, "--undisturbed", "--seconds", "10", "--record", walk, "--command", "0.3,0.4; 0.2,-0.3")
    followed = float(re.search(r"followed to (\S+) of 1", said)[1])
    recording = amble.Recording(walk)
    com_m = np.stack([recording["com.x"], recording["com.y"]], axis=1)
    w, x, y, z = (recording["root.q" + axis].astype(np.float64) for axis in "wxyz")
    yaw = np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    robots = Replayed(com_m, yaw)
    own = {"tracking_speed_m_s": 0.14, "tracking_turn_rad_s": 0.35}  # [score.tracking] of that champion
    commands = adapter.Commands({"stretch_s": 100.0, **own}, robots, np.random.default_rng(1))
    rewards = []
    for tick in range(1, 1001):
        commands.told[:] = (0.3, 0.4) if tick <= 500 else (0.2, -0.3)
        robots.at(tick - 1)
        rewards.append(commands.step(np.array([tick]))[0])
    assert not any(reward for tick, reward in enumerate(rewards, 1) if tick % 100)
    assert abs(sum(rewards) / 10.0 - followed) < 0.0006  # of which three digits are said


def test_a_second_ends_with_the_tick_in_which_it_is_complete(adapter):
    ticks = np.arange(401)
    robots = Replayed(np.stack([0.003 * ticks, 0.0 * ticks], axis=1), 0.0 * ticks)
    robots.timestep_s = 0.015
    commands = adapter.Commands({"stretch_s": 100.0}, robots, np.random.default_rng(1))
    ends = []
    for tick in range(401):
        commands.told[:] = (0.2, 0.0)
        robots.at(tick)
        ends += [tick] if commands.step(np.array([tick]))[0] > 0.0 else []
    assert ends == [67, 134, 200, 267, 334, 400]  # 1.005, 2.01 and 3 s, and so on


def test_who_stands_earns_nothing_but_where_a_stop_is_commanded(adapter):
    still = np.zeros((20, 12), np.float32)
    for stops, earned in ((0.0, 0.0), (1.0, 2.0)):
        env = adapter.RobotsEnv(ROBOT, 20, commands={"stop_share": stops, "straight_share": 0.0, "least_speed_m_s": 0.2})
        first, _ = env.reset(seed=1)
        assert first.shape == (20, 21) and (stops == 0.0) == first[:, 19].all()
        total = sum(env.step(still)[1] for _ in range(200))
        assert np.allclose(total, earned, atol=0.1), total


def test_commands_are_drawn_by_the_seed_and_anew_in_each_stretch(adapter):
    def told(seed):
        env = adapter.RobotsEnv(ROBOT, 50, commands={"stretch_s": 0.1})
        seen = [env.reset(seed=seed)[0][:, 19:]]
        seen += [env.step(np.zeros((50, 12), np.float32))[0][:, 19:] for _ in range(25)]
        return np.array(seen)

    one = told(1)
    assert np.array_equal(one, told(1)) and not np.array_equal(one, told(2))
    changes = [tick for tick in range(1, 26) if not np.array_equal(one[tick], one[tick - 1])]
    assert changes == [10, 20]
    assert np.abs(one[..., 1]).max() <= 0.5 and one[..., 0].min() >= 0.0 and one[..., 0].max() <= 0.4


def test_what_a_reset_and_commands_do_not_know_is_refused(adapter):
    env = adapter.RobotsEnv(ROBOT, 2)
    env.reset(options={})
    with pytest.raises(ValueError, match="all robots begin anew"):
        env.reset(options={"reset_mask": np.array([True, False])})
    for commands in ([], 3, {1: 2}):
        with pytest.raises(ValueError, match="commands"):
            adapter.RobotsEnv(ROBOT, 1, commands=commands)


def test_a_command_that_there_is_not_is_refused(adapter):
    with pytest.raises(ValueError, match="commands has speed: expected stretch_s, "):
        adapter.RobotsEnv(ROBOT, 1, commands={"speed": 1.0})


def test_the_tick_that_begins_an_episode_anew_is_none_of_its_first_second(adapter):
    env = adapter.RobotsEnv(ROBOT, 4, max_ticks=150, commands={"stretch_s": 100.0, "least_speed_m_s": 0.1})
    env.reset(seed=1)
    still = np.zeros((4, 12), np.float32)
    for _ in range(151):
        env.step(still)
    assert not env.commands._sum.any()
    env.step(still)
    assert np.allclose(env.commands._sum, env.commands.told)


def test_forward_is_what_points_along_x_in_the_start_pose(adapter):
    def rewards(start_yaw):
        ticks = np.arange(1000)
        robots = Replayed(np.stack([0.003 * ticks, 0.0 * ticks], axis=1), start_yaw + 0.0 * ticks)
        robots.at(0)
        commands = adapter.Commands({"stretch_s": 100.0}, robots, np.random.default_rng(1))
        commands.told[:] = (0.3, 0.0)
        total = 0.0
        for tick in range(1, 1001):
            robots.at(tick - 1)
            total += commands.step(np.array([tick]))[0]
        return total

    assert abs(rewards(0.0) - 10.0) < 0.1 and abs(rewards(1.5) - rewards(0.0)) < 1e-6


@pytest.mark.parametrize("commands", [
    {"least_speed_m_s": 1.0}, {"stop_share": 0.9, "straight_share": 0.2}, {"stretch_s": -5}, {"stretch_s": 0.002},
    {"stop_share": -0.5, "straight_share": 0.6}, {"most_turn_rad_s": -1.0}, {"tracking_speed_m_s": 0.0}, {"tracking_turn_rad_s": -1},
    {"most_speed_m_s": float("nan")}, {"most_speed_m_s": "0.4"}, {"stop_share": True}])
def test_commands_that_cannot_be_are_refused(adapter, commands):
    with pytest.raises(ValueError, match="commands: "):
        adapter.RobotsEnv(ROBOT, 1, commands=commands)


def test_ranges_of_commands_are_those_of_a_config(adapter):
    names = {"tracking_speed_m_s": "score.tracking.speed_m_s", "tracking_turn_rad_s": "score.tracking.turn_rad_s"}
    for key, (least, most) in adapter.Commands.RANGES.items():
        with pytest.raises(amble.Error) as refused:
            amble.load_config(CONFIG, {names.get(key, f"command.{key}"): 2.0 * most})
        assert [float(number) for number in re.search(r"from (\S+) to (\S+)$", str(refused.value)).groups()] == [least, most]


@pytest.mark.parametrize("ticks", [0, -1, 1.5, True])
def test_an_episode_has_a_tick(adapter, ticks):
    with pytest.raises(ValueError, match="max_ticks: .*expected a whole number, at least 1"):
        adapter.RobotsEnv(ROBOT, 1, max_ticks=ticks)
