"""A simulator of one's own under amble's NEAT, by ask and tell: here a walker without dynamics, in thirty lines of numpy.

Its trunk stays level and moves along x alone: the lowest feet are on the ground, and carry it by their mean speed. What
evolves are sine wave controllers (HyperNEAT on the authors' substrate), as for the simulated quadruped. Five seconds.
"""

import sys

import amble
import numpy as np

generations = int(sys.argv[1]) if len(sys.argv) > 1 else 30
THIGH_M = SHANK_M = 0.14
TICK_S = 0.01
LEVEL = np.zeros((60, 3))   # roll, pitch and yaw of the trunks, which these networks feel


class Stilts:
    """n walkers of four legs; joints leg by leg: knee, hip_fb, hip_io (docs/CONVENTIONS.md)."""

    def __init__(self, n):
        self.angle_rad, self.touch, self.x_m = np.zeros((n, 12)), np.ones((n, 4)), np.zeros(n)

    def step(self, targets_rad):
        before = self.feet()[0]
        self.angle_rad += np.clip(targets_rad - self.angle_rad, -8.0 * TICK_S, 8.0 * TICK_S)   # servos: 8 rad/s
        x, z = self.feet()
        self.touch = (z <= z.min(axis=1, keepdims=True) + 0.01).astype(float)
        self.touch *= self.touch.sum(axis=1, keepdims=True) >= 2                               # one foot: it tips over
        down = np.maximum(self.touch.sum(axis=1), 1.0)
        self.x_m -= ((x - before) * self.touch).sum(axis=1) / down

    def feet(self):
        """x (forward) and z of the feet below the hips, m: [n, 4] each. Positive angles swing backward."""
        knee, hip, _ = (self.angle_rad[:, kind::3] for kind in range(3))
        return (-THIGH_M * np.sin(hip) - SHANK_M * np.sin(hip + knee), -THIGH_M * np.cos(hip) - SHANK_M * np.cos(hip + knee))


search = amble.Search(amble.load_config(amble.data_folder() / "configs/authors/sine-objective.toml",
                                        {"population.size": 60}), seed=1)
for generation in range(generations):
    controllers, walkers = amble.Controllers(search, search.ask()), Stilts(60)
    for tick in range(500):
        walkers.step(controllers.step(walkers.angle_rad, walkers.touch, LEVEL))
    fitness = np.maximum(walkers.x_m, 0.0)
    search.tell(fitness)
    print(f"{generation:3}  best {fitness.max():.2f} m, mean {fitness.mean():.2f} m in 5 s")
