"""amble's robots as a gymnasium.vector.VectorEnv. Needs gymnasium, which amble itself does not.

    from amble.gymnasium import RobotsEnv
    env = RobotsEnv("robots/quadruped/authors.toml", num_envs=1024)
    env = RobotsEnv("hexapod", num_envs=1024, commands={"most_speed_m_s": 0.4, "most_turn_rad_s": 0.5})
"""

import numbers
from collections.abc import Mapping

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from ._amble import Robots


class Commands:
    """What each robot is told, drawn anew for each stretch, and how well it obeys, second by second.

    A second is judged as the quantity `tracking` does (docs/SCORES.md), but one in which a stop is commanded by itself: it counts in
    full where nothing moves. Keys and defaults are those of [command], tracking_speed_m_s and tracking_turn_rad_s those of
    [score.tracking]; what a config says of them is not read: pass it here. A robot's forward axis is the one that points along +x in its
    start pose."""

    DEFAULTS = {"stretch_s": 5.0, "least_speed_m_s": 0.0, "most_speed_m_s": 0.4, "most_turn_rad_s": 0.5, "straight_share": 0.2,
                "stop_share": 0.1, "tracking_speed_m_s": 0.2, "tracking_turn_rad_s": 0.5}

    RANGES = {"stretch_s": (1e-3, 1e6), "least_speed_m_s": (-100.0, 100.0), "most_speed_m_s": (-100.0, 100.0),
              "most_turn_rad_s": (0.0, 100.0), "straight_share": (0.0, 1.0), "stop_share": (0.0, 1.0),
              "tracking_speed_m_s": (1e-6, 1e3), "tracking_turn_rad_s": (1e-6, 1e3)}

    def __init__(self, settings, robots, random):
        self._settings, self._robots, self.random = self._checked(settings, robots.timestep_s), robots, random
        self._stretch = max(1, round(self._settings["stretch_s"] / robots.timestep_s))
        count = len(robots)
        self.told = np.zeros((count, 2), np.float32)  # speed along its forward axis, m/s, and turn to the left, rad/s
        self._sum, self._begin_m = np.zeros((count, 2)), np.zeros((count, 2))
        self._ticks = np.zeros(count, int)  # since the second's begin, of which _sum is the sum of what was told
        self._yaw, self._heading, self._turned = np.zeros(count), np.zeros(count), np.zeros(count)
        self.begin(np.ones(count, bool))

    @classmethod
    def _checked(cls, settings, timestep_s):
        """All settings. ValueError where a config's [command] or [score.tracking] would be refused."""
        if not isinstance(settings, Mapping):
            raise ValueError(f"commands: {settings!r}: expected a dict")
        unknown = set(settings) - set(cls.DEFAULTS)
        if unknown:
            raise ValueError(f"commands has {', '.join(sorted(map(str, unknown)))}: expected {', '.join(cls.DEFAULTS)}")
        for key, value in settings.items():
            least, most = cls.RANGES[key]
            if isinstance(value, bool) or not isinstance(value, numbers.Real) or not least <= value <= most:
                raise ValueError(f"commands: {key}: {value!r}: expected a number from {least:g} to {most:g}")
        every = cls.DEFAULTS | dict(settings)
        if every["least_speed_m_s"] > every["most_speed_m_s"]:
            raise ValueError("commands: least_speed_m_s is more than most_speed_m_s")
        if every["stop_share"] + every["straight_share"] > 1.0:
            raise ValueError("commands: stop_share and straight_share: expected shares that are at most 1 together")
        if every["stretch_s"] < timestep_s:
            raise ValueError(f"commands: stretch_s: {every['stretch_s']!r}: expected at least one timestep, {timestep_s:g} s")
        return every

    def begin(self, which):
        """These robots stand in the start pose."""
        self._draw(which)
        self._sum[which], self._turned[which], self._ticks[which] = 0.0, 0.0, 0
        self._begin_m[which] = self._robots.com_m[which, :2]
        self._yaw[which] = self._robots.attitude_rad[which, 2]
        self._heading[which] = 0.0

    def _draw(self, which):
        count, s = int(which.sum()), self._settings
        speed = self.random.uniform(s["least_speed_m_s"], s["most_speed_m_s"], count)
        turn = self.random.uniform(-s["most_turn_rad_s"], s["most_turn_rad_s"], count)
        kind = self.random.random(count)
        turn[kind < s["stop_share"] + s["straight_share"]] = 0.0
        told = np.stack([speed, turn], axis=1)
        told[kind < s["stop_share"]] = 0.0
        self.told[which] = told

    def step(self, ticks):
        """After a tick, the `ticks`-th of each robot's episode (0: it has just begun): its reward, which a second gives in its last
        tick."""
        self._sum[ticks > 0] += self.told[ticks > 0]
        self._ticks[ticks > 0] += 1
        yaw = self._robots.attitude_rad[:, 2].astype(np.float64)
        self._turned += (yaw - self._yaw + np.pi) % (2.0 * np.pi) - np.pi
        self._yaw = yaw
        rewards, over = np.zeros(len(ticks)), (ticks > 0) & (self._seconds(ticks) > self._seconds(ticks - 1))
        if over.any():
            rewards[over] = self._obeyed(over)
            self._begin_m[over] = self._robots.com_m[over, :2]
            self._heading[over] += self._turned[over]
            self._sum[over], self._turned[over], self._ticks[over] = 0.0, 0.0, 0
        renewed = (ticks % self._stretch == 0) & (ticks > 0)
        if renewed.any():
            self._draw(renewed)
        return rewards

    def _seconds(self, ticks):
        """Whole seconds after so many ticks, as trials count them: one ends with the tick in which it is complete."""
        return np.floor(ticks * self._robots.timestep_s + 1e-9)

    def _obeyed(self, over):
        """How well the second that is over obeyed, 0 … 1; 0 is what standing still is worth where there was something to do."""
        told = self._sum[over] / self._ticks[over, None]
        v0, w0 = self._settings["tracking_speed_m_s"], self._settings["tracking_turn_rad_s"]
        heading = self._heading[over] + 0.5 * self._turned[over]  # in the mean of the second's begin and end
        wanted_m = told[:, :1] * np.stack([np.cos(heading), np.sin(heading)], axis=1)
        went_m = self._robots.com_m[over, :2] - self._begin_m[over]

        def mean(way_m, turn_rad):
            a = 1.0 - np.linalg.norm(way_m - wanted_m, axis=1) / np.maximum(np.abs(told[:, 0]), v0)
            b = 1.0 - np.abs(turn_rad - told[:, 1]) / np.maximum(np.abs(told[:, 1]), w0)
            return (np.maximum(a, 0.0) + np.maximum(b, 0.0)) / 2.0

        reached, standing = mean(went_m, self._turned[over]), mean(np.zeros_like(went_m), 0.0)
        above = (reached - standing) / np.where(standing < 1.0, 1.0 - standing, 1.0)
        return np.where(standing < 1.0, np.maximum(above, 0.0), reached)


class RobotsEnv(VectorEnv):
    """Walk forward (+x): the reward of a tick is how far the centre of mass came along x, m. With `commands`, obey: the reward is
    how well each second followed what was told, 0 … 1, in the second's last tick.

    Actions: [num_envs, joints], target angles, rad. Observations: angles, touches and attitude (Robots), with `commands` then speed (m/s)
    and turn to the left (rad/s); float32, copies. An episode terminates when the robot falls or diverges, and is truncated
    after max_ticks. Autoreset: next step. `commands`: a dict of Commands.DEFAULTS' keys, {} for all of those.
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(self, robot, num_envs=1, engine="batch", *, max_ticks=1500, timestep_s=None, threads=None, commands=None):
        if isinstance(max_ticks, bool) or not isinstance(max_ticks, numbers.Integral) or max_ticks < 1:
            raise ValueError(f"max_ticks: {max_ticks!r}: expected a whole number, at least 1")
        self.robots = Robots(robot, num_envs, engine, timestep_s=timestep_s, threads=threads)
        self.num_envs, self.max_ticks = num_envs, max_ticks
        self.commands = None if commands is None else Commands(commands, self.robots, np.random.default_rng())
        self._length = self.robots.observations.shape[1] - 3
        seen = self._length + (0 if commands is None else 2)
        self.single_action_space = gymnasium.spaces.Box(self.robots.lower_rad, self.robots.upper_rad)
        self.single_observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (seen,), np.float32)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._ticks = np.zeros(num_envs, np.int64)
        self._over = np.zeros(num_envs, bool)

    def _observations(self):
        sensed = self.robots.observations[:, :self._length]
        return sensed.copy() if self.commands is None else np.concatenate([sensed, self.commands.told], axis=1)

    def reset(self, *, seed=None, options=None):
        """All robots into the start pose. The simulation has no randomness; seed is for commands and np_random (spaces have
        seed() of their own)."""
        if options:
            raise ValueError(f"options: {options!r}: expected none: all robots begin anew (robots that are over do so by themselves)")
        super().reset(seed=seed)
        self.robots.reset()
        self._ticks[:], self._over[:] = 0, False
        if self.commands is not None:
            if seed is not None:
                self.commands.random = np.random.default_rng(seed)
            self.commands.begin(np.ones(self.num_envs, bool))
        return self._observations(), {}

    def step(self, actions):
        before = self.robots.com_m[:, 0].copy()
        self.robots.step(actions)
        self._ticks += 1
        if self._over.any():  # these begin anew: their action was ignored
            self.robots.reset(self._over)
            self._ticks[self._over] = 0
        if self.commands is None:
            rewards = (self.robots.com_m[:, 0] - before).astype(np.float64)
        else:
            if self._over.any():
                self.commands.begin(self._over)
            rewards = self.commands.step(self._ticks)
        rewards[self._over] = 0.0
        terminated = (self.robots.fallen | self.robots.diverged) & ~self._over
        truncated = (self._ticks >= self.max_ticks) & ~terminated
        self._over = terminated | truncated
        return self._observations(), rewards, terminated, truncated, {}
