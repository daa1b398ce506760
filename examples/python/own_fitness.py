"""A fitness of one's own: amble's NEAT and simulator, but walk far with small strides of the hips. About ten seconds."""

import sys

import amble
import numpy as np

generations = int(sys.argv[1]) if len(sys.argv) > 1 else 15
config = amble.load_config(amble.data_folder() / "configs/authors/supg-objective.toml",
                           {"engine": "batch", "population.size": 50, "trial.duration_s": 3.0})
search = amble.Search(config, seed=1)
robots = amble.Robots(config, n=50)
hips = [joint.endswith("hip_fb") for joint in robots.joints]
start_m = robots.com_m[0, 0]

for generation in range(generations):
    genomes = search.ask()
    controllers = amble.Controllers(search, genomes)
    robots.reset()
    walking, swing_rad, distance_m = np.ones(50, bool), np.zeros(50), np.zeros(50)
    robots.step(robots.angle_rad)  # trial.first_command = "after_first_step", as the preset has it: motors hold for a step
    for tick in range(299):
        targets_rad = controllers.step(robots.angle_rad, robots.touch, robots.attitude_rad)
        robots.step(targets_rad)
        walking &= ~(robots.fallen | robots.diverged)      # who has fallen stays where it fell
        distance_m[walking] = robots.com_m[walking, 0] - start_m
        swing_rad += np.where(walking, np.abs(robots.angle_rad[:, hips]).mean(axis=1), 0.0) / 300
    fitness = np.maximum(distance_m, 0.0) / (1.0 + 2.0 * swing_rad)
    best = int(fitness.argmax())
    print(f"{generation:3}  best {distance_m[best]:.2f} m, hips {swing_rad[best]:.2f} rad; fitness {fitness[best]:.2f}, "
          f"mean {fitness.mean():.2f}")
    search.tell(fitness)
