#!/usr/bin/env python3
"""Evolves small SUPG champions under a preset, records how they walk, and follows each recording tick by tick with an
independent model: from the recorded touches and the champion's genome alone it says what every timer, trigger and target
must be. Timers, triggers and offsets must be equal, targets within supg.Patterns' tolerance.

follow.py PROGRAM PRESET     evolves and follows
follow.py PROGRAM CHAMPION…  follows champions that are there"""

import collections
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

from recording import Recording
from supg import STOPPED, Leg, Patterns

CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"

# What each run changes in its preset.
RUNS = {
    "authors": [
        [],
        ["controller.supg.trigger=level"],
        ["controller.supg.idle=hold", "trial.first_command=before_first_step"],
        ["controller.supg.idle=wrap", "controller.supg.period_s=0.4"],
        ["controller.supg.idle=wrap", "controller.supg.trigger=none"],
        ["controller.supg.offset=delay", "controller.supg.trigger_debounce_ticks=4"],
    ],
    "paper": [
        [],
        ["controller.supg.trigger=level", "controller.supg.idle=mid"],
        ["controller.supg.offset=phase", "controller.supg.idle=wrap", "cppn.recurrent=true"],
        ["controller.supg.start_tick=1", "trial.first_command=after_first_step"],
    ],
    "robust": [
        [],
        ["controller.supg.trigger=level", "controller.supg.offset=delay"],
        ["controller.supg.idle=hold", "controller.supg.start_tick=0", "controller.supg.trigger_debounce_ticks=3"],
    ],
}
# What the recordings of a preset must have shown, so that following them means something.
SHOWN = {
    "authors": ["cycle in a CPPN", "hidden node", "start by phase", "delayed start", "trigger", "trigger in mid-cycle",
                "mid", "hold", "wrap", "bounce"],
    "paper": ["hidden node", "delayed start", "start by phase", "trigger in mid-cycle", "trigger ignored", "mid", "hold", "wrap"],
    "robust": ["hidden node", "delayed start", "start by phase", "trigger in mid-cycle", "hold", "wrap"],
}
# Small, and with more structural mutations than a long evolution needs, so that CPPNs soon have hidden nodes and cycles.
SMALL = ["population.size=40", "engine=batch", "mutation.add_node_share=0.3", "mutation.add_link_share=0.4",
         "trial.duration_s=6", "seed=3"]


class Difference(Exception):
    pass


def follow(champion, recording, events):
    """Raises Difference where the recording is not what the model says."""
    patterns = Patterns(champion)
    events["cycle in a CPPN"] += patterns.cppn.has_cycle()
    events["hidden node"] += patterns.cppn.hidden_count
    events["champion"] += 1
    recorded_offsets = recording.header["controller"]["offset_ticks"]
    legs = []
    for name, offsets, recorded in zip(patterns.legs, patterns.offset_ticks, recorded_offsets):
        if recorded not in offsets:
            raise Difference(f"offset of {name}: {recorded} recorded, {offsets} by the model")
        legs.append(Leg(patterns.settings, patterns.period_ticks, recorded, events))
    waits = champion["trial"]["first_command"] == "after_first_step"

    for frame in range(recording.frames):
        # Touches are felt in the pose at the beginning of a frame's step, and read before the next one.
        felt = max(frame - 1, 0)
        for leg, name, joints in zip(legs, patterns.legs, patterns.joints_of_leg):
            begun = frame > 0 or not waits
            if begun:
                leg.tick(recording["touch." + name][felt] == 1.0)
            where = f"{name}, step {frame + 1}"
            expect_equal(recording["timer." + name][frame], leg.timer, "timer of " + where)
            expect_equal(recording["trigger." + name][frame], float(leg.triggered), "trigger of " + where)
            for joint in joints:
                if not begun:
                    expected, tolerance = 0.0, 1e-6  # the start pose
                elif leg.timer == STOPPED:
                    expected, tolerance = patterns.middle_rad[joint], 1e-6
                else:
                    expected, tolerance = patterns.targets_rad[joint][leg.timer], patterns.tolerance_rad[joint]
                target = recording["target." + patterns.joints[joint]][frame]
                if not abs(target - expected) <= tolerance:
                    raise Difference(f"target of {patterns.joints[joint]}, step {frame + 1}: {target} recorded, "
                                     f"{expected} ± {tolerance:.1e} by the model")
    events["frame"] += recording.frames
    events["joint of a doubtful CPPN"] += int(np.sum(np.array(patterns.tolerance_rad) > 1e-3))
    events["joint"] += len(patterns.joints)


def expect_equal(recorded, expected, what):
    if recorded != expected:
        raise Difference(f"{what}: {recorded:g} recorded, {expected:g} by the model")


def follow_file(program, path, folder, events):
    record = folder / "walk.rec"
    run(program, "trial", path, "--seconds", "15", "--record", record)
    try:
        follow(json.loads(path.read_text()), Recording(record), events)
    except Difference as difference:
        raise Difference(f"{path.name}: {difference}") from None


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}\n{done.stderr}")


def evolve(program, preset, changes, folder):
    settings = [part for setting in SMALL + changes for part in ("--set", setting)]
    out = folder / "run"
    run(program, "evolve", CONFIGS / preset / "supg-objective.toml", *settings, "--generations", "16", "--jobs", "1",
        "--out", out)
    return sorted((out / "champions").glob("*.json"))


def main(program, names):
    events = collections.Counter()
    try:
        if names[0] in RUNS:
            for changes in RUNS[names[0]]:
                with tempfile.TemporaryDirectory() as name:
                    folder = pathlib.Path(name)
                    for champion in evolve(program, names[0], changes, folder):
                        try:
                            follow_file(program, champion, folder, events)
                        except Difference as difference:
                            raise Difference(f"{' '.join(changes)} {difference}") from None
        else:
            with tempfile.TemporaryDirectory() as name:
                for champion in names:
                    follow_file(program, pathlib.Path(champion), pathlib.Path(name), events)
    except Difference as difference:
        sys.exit(str(difference))
    print(", ".join(f"{event}: {count}" for event, count in sorted(events.items())))
    missing = [event for event in SHOWN.get(names[0], []) if events[event] == 0]
    if missing:
        sys.exit("no recording showed: " + ", ".join(missing))
    if 5 * events["joint of a doubtful CPPN"] > events["joint"]:
        sys.exit("too many CPPNs whose rounding hides what they say")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
