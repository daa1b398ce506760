"""The adapter against a stand-in with the few names that it uses: Debian 12 has no Gymnasium."""

import enum
import importlib
import sys
import types

import numpy as np
import pytest

from conftest import ROBOT


class AutoresetMode(enum.Enum):
    NEXT_STEP = "NextStep"


class VectorEnv:
    def reset(self, *, seed=None, options=None):
        self.seed = seed


class Box:
    def __init__(self, low, high, shape=None, dtype=np.float32):
        self.low, self.high, self.shape, self.dtype = low, high, shape or np.shape(low), dtype


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
