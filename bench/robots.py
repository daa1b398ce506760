#!/usr/bin/env python3
"""Robot-steps per second of amble.Robots from Python, beside the batch engine itself and MuJoCo's mj_step on the same
robot with the same targets, on one core; the median of several rounds, in each of which all are measured in turn.

    bench/robots.py BENCH [ROUNDS]        BENCH: the program amble_bench of the same build; PYTHONPATH has amble
"""

import csv
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import amble
import numpy as np

STEPS = 300
ROBOT = pathlib.Path(__file__).resolve().parents[1] / "robots/quadruped/authors.toml"


def swing(robots, step):
    """As quarter_swing() of bench/physics_bench.cpp."""
    middle, whole = (robots.upper_rad + robots.lower_rad) / 2, robots.upper_rad - robots.lower_rad
    phase = 2 * np.pi * (0.01 * step + 0.25 * (np.arange(len(middle)) // 3))
    return np.tile((middle + 0.3 * whole * np.sin(phase)).astype(np.float32), (len(robots), 1))


def from_python(n):
    robots = amble.Robots(ROBOT, n, threads=1)
    targets = [swing(robots, step) for step in range(0, 100, 25)]
    best = []
    for _ in range(3):
        calls, start = 0, time.perf_counter()
        while time.perf_counter() - start < 0.2:
            robots.reset()
            for step in range(STEPS):
                robots.step(targets[step // 25 % 4])
            calls += 1
        best.append(calls * STEPS * n / (time.perf_counter() - start))
    return statistics.median(best)


def from_c(bench):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([bench, "--only", "robots", "--csv", f"{folder}/figures.csv"], check=True, stdout=subprocess.DEVNULL)
        with open(f"{folder}/figures.csv") as file:
            return {row[0]: float(row[1]) for row in csv.reader(file) if row[2:] and row[2] == "1/s"}


def main(bench, rounds=5):
    measured = []
    for _ in range(int(rounds)):
        figures = from_c(bench)
        figures.update({f"python_{n}": from_python(n) for n in (16, 1024, 4096)})
        measured.append(figures)
    median = {name: statistics.median(figures[name] for figures in measured) for name in measured[0]}
    mujoco = median["mujoco_robot_steps_per_s"]
    print("| robots | from Python, steps/s | batch engine, steps/s | share | MuJoCo's mj_step, steps/s | Python against MuJoCo |")
    print("|---:|---:|---:|---:|---:|---:|")
    for n in (16, 1024, 4096):
        python, batch = median[f"python_{n}"], median[f"batch_robot_steps_per_s_{n}"]
        print(f"| {n:,} | {python:,.0f} | {batch:,.0f} | {python / batch:.0%} | {mujoco:,.0f} | {python / mujoco:.0f} × |")


if __name__ == "__main__":
    main(*sys.argv[1:])
