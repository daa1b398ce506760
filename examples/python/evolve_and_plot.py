"""Evolves walkers for half a minute, and plots how they learned and how the best one walks.

The cells (# %%) run one by one in editors that know them, or all at once: python3 evolve_and_plot.py [FOLDER [GENERATIONS]]
Needs matplotlib (python3-matplotlib).
"""

# %% Evolve: the settings of the README's first example, smaller
import pathlib
import sys

import amble
import matplotlib.pyplot as plt
import numpy as np

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "runs/plotted")
generations = int(sys.argv[2]) if len(sys.argv) > 2 else 20
config = amble.load_config(amble.data_folder() / "configs/robust/supg-objective.toml",
                           {"engine": "batch", "population.size": 60, "trial.duration_s": 5.0, "generations": generations})
run = amble.evolve(config, seed=1, out=folder / "run",
                   on_generation=lambda line: print(f"{int(line['generation']):3}  {line['best']:.2f} m", end="\r"))

# %% What the search did
table = run.generations()
champion = run.champion()
figure, (learning, walking, feet) = plt.subplots(3, 1, figsize=(7, 8), height_ratios=[2, 2, 1], layout="constrained")
learning.plot(table["generation"], table["best"], label="best")
learning.plot(table["generation"], table["mean"], label="mean")
learning.set(xlabel="generation", ylabel="distance under noise, m")
learning.legend()

# %% How the champion walks: joint angles of the front left leg, and footfalls
print(champion.trial(seconds=5.0, record=folder / "walk.rec"))
walk = amble.Recording(folder / "walk.rec")
time_s = np.arange(1, len(walk) + 1) * walk.frame_s  # frame k is the state after step k + 1
for joint in ("FL_knee", "FL_hip_fb", "FL_hip_io"):
    walking.plot(time_s, walk[f"angle.{joint}"], label=joint)
walking.set(xlabel="time, s", ylabel="angle, rad")
walking.legend()
feet.imshow(walk.matching("touch.").T, aspect="auto", cmap="Greys", interpolation="nearest",
            extent=(time_s[0], time_s[-1], 3.5, -0.5))
feet.set(yticks=range(4), yticklabels=[name[6:] for name in walk.columns if name.startswith("touch.")],
         xlabel="time, s")
figure.savefig(folder / "walk.svg")
print(f"{amble.gait(walk)['gait']}: {folder / 'walk.svg'}")

# %% In three dimensions; in a notebook amble.view(champion) alone shows the page
amble.view(champion, seconds=5.0).save(folder / "walk.html")
