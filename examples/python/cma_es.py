"""CMA-ES (Hansen 2016, "The CMA Evolution Strategy: A Tutorial") finds a sine gait on the vector environment: half a minute."""

import sys

import amble
import numpy as np

generations, n, joints = int(sys.argv[1]) if len(sys.argv) > 1 else 60, 64, 12
robots = amble.Robots("quadruped", n)
lower, upper, random = robots.lower_rad, robots.upper_rad, np.random.default_rng(1)


def distances_m(x):
    """x: [n, 3 × 12 + 1]: per joint middle, amplitude and phase, then the frequency. How far each walks in 5 s, or falls."""
    middle, amplitude, phase = (x[:, part * joints:(part + 1) * joints] for part in range(3))
    hertz = 1.0 + 0.5 * np.tanh(x[:, -1:])
    robots.reset()
    start, standing, x_m = robots.com_m[:, 0].copy(), np.ones(n, bool), np.zeros(n)
    for tick in range(500):
        wave = np.tanh(middle) + np.tanh(amplitude) * np.sin(phase + 2 * np.pi * hertz * tick * robots.timestep_s)
        robots.step((lower + (upper - lower) * np.clip(0.5 + 0.5 * wave, 0, 1)).astype(np.float32))
        standing &= ~(robots.fallen | robots.diverged)
        x_m[standing] = robots.com_m[standing, 0] - start[standing]
    return x_m


dim, parents = 3 * joints + 1, n // 2                       # sec. 3 and table 1: default parameters
weights = np.log((n + 1) / 2) - np.log(np.arange(1, parents + 1))
weights /= weights.sum()
mu = 1 / (weights ** 2).sum()
c_sigma, c_c = (mu + 2) / (dim + mu + 5), (4 + mu / dim) / (dim + 4 + 2 * mu / dim)
d_sigma = 1 + 2 * max(0.0, np.sqrt((mu - 1) / (dim + 1)) - 1) + c_sigma
c_1 = 2 / ((dim + 1.3) ** 2 + mu)
c_mu = min(1 - c_1, 2 * (mu - 2 + 1 / mu) / ((dim + 2) ** 2 + mu))
chi = np.sqrt(dim) * (1 - 1 / (4 * dim) + 1 / (21 * dim ** 2))
mean, sigma, C, p_sigma, p_c = np.zeros(dim), 0.5, np.eye(dim), np.zeros(dim), np.zeros(dim)
for generation in range(generations):
    eigenvalues, B = np.linalg.eigh(C)
    scale = np.sqrt(np.maximum(eigenvalues, 1e-20))
    y = (random.standard_normal((n, dim)) * scale) @ B.T                     # ~ N(0, C)
    distance = distances_m(mean + sigma * y)
    best = y[np.argsort(-distance)[:parents]]
    step = weights @ best
    mean = mean + sigma * step
    p_sigma = (1 - c_sigma) * p_sigma + np.sqrt(c_sigma * (2 - c_sigma) * mu) * (B @ ((B.T @ step) / scale))
    h = np.linalg.norm(p_sigma) / np.sqrt(1 - (1 - c_sigma) ** (2 * generation + 2)) < (1.4 + 2 / (dim + 1)) * chi
    p_c = (1 - c_c) * p_c + h * np.sqrt(c_c * (2 - c_c) * mu) * step
    C = (1 - c_1 - c_mu) * C + c_1 * np.outer(p_c, p_c) + c_mu * (best.T * weights) @ best
    sigma *= np.exp((c_sigma / d_sigma) * (np.linalg.norm(p_sigma) / chi - 1))
    print(f"{generation:3}  best {distance.max():.2f} m, mean {distance.mean():.2f} m, sigma {sigma:.2f}")
