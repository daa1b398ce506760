"""amble's robots as a gymnasium.vector.VectorEnv. Needs gymnasium, which amble itself does not.

    from amble.gymnasium import RobotsEnv
    env = RobotsEnv("robots/quadruped/authors.toml", num_envs=1024)
"""

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from ._amble import Robots


class RobotsEnv(VectorEnv):
    """Walk forward (+x): the reward of a tick is how far the centre of mass came along x, m.

    Actions: [num_envs, joints], target angles, rad. Observations: angles, touches and attitude (Robots), float32; copies.
    An episode terminates when the robot falls or diverges, and is truncated after max_ticks. Autoreset: next step.
    """

    metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(self, robot, num_envs=1, engine="batch", *, max_ticks=1500, timestep_s=None, threads=None):
        self.robots = Robots(robot, num_envs, engine, timestep_s=timestep_s, threads=threads)
        self.num_envs, self.max_ticks = num_envs, max_ticks
        self._length = self.robots.observations.shape[1] - 3
        self.single_action_space = gymnasium.spaces.Box(self.robots.lower_rad, self.robots.upper_rad)
        self.single_observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (self._length,), np.float32)
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._ticks = np.zeros(num_envs, np.int64)
        self._over = np.zeros(num_envs, bool)

    def _observations(self):
        return self.robots.observations[:, :self._length].copy()

    def reset(self, *, seed=None, options=None):
        """All robots into the start pose. The simulation has no randomness; seed is for the spaces alone."""
        super().reset(seed=seed)
        self.robots.reset()
        self._ticks[:], self._over[:] = 0, False
        return self._observations(), {}

    def step(self, actions):
        before = self.robots.com_m[:, 0].copy()
        self.robots.step(actions)
        rewards = (self.robots.com_m[:, 0] - before).astype(np.float64)
        self._ticks += 1
        if self._over.any():  # these begin anew: their action was ignored
            self.robots.reset(self._over)
            rewards[self._over], self._ticks[self._over] = 0.0, 0
        terminated = (self.robots.fallen | self.robots.diverged) & ~self._over
        truncated = (self._ticks >= self.max_ticks) & ~terminated
        self._over = terminated | truncated
        return self._observations(), rewards, terminated, truncated, {}
