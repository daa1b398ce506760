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
import mixed
from modulated import ModulatedLeg, Modulation
from seam import Seam
from supg import STOPPED, Leg, Patterns

CONFIGS = pathlib.Path(__file__).resolve().parents[2] / "configs"

# A mixed substrate, and something to obey.
TOLD = ["controller.kind=mixed", "controller.substrate=auto", "command.kind=random", "command.stretch_s=1"]
# What each run changes in its preset.
RUNS = {
    "authors": [
        [],
        ["controller.supg.trigger=level"],
        ["controller.supg.idle=hold", "trial.first_command=before_first_step"],
        ["controller.supg.idle=wrap", "controller.supg.period_s=0.4"],
        ["controller.supg.idle=wrap", "controller.supg.trigger=none"],
        ["controller.supg.offset=delay", "controller.supg.trigger_debounce_ticks=4"],
        ["controller.supg.seam.residual_s=0.05"],
        ['controller.supg.modulation.sensors=["pitch","angle.knee"]', "controller.supg.modulation.rate=1",
         "controller.supg.modulation.shape=1"],
        ['controller.supg.modulation.sensors=["roll","touch"]', "controller.supg.modulation.rate=0.5",
         "controller.supg.modulation.reset=0.5", "controller.supg.modulation.refractory_ticks=20",
         "controller.supg.idle=wrap", "controller.supg.seam.residual_s=0.05"],
        ['controller.supg.modulation.sensors=["pitch","angle.knee"]', "controller.supg.modulation.rate=1",
         "controller.supg.modulation.shape=0.8", "controller.supg.modulation.shape_by=reading", "controller.supg.idle=wrap"],
        ["controller.supg.trigger=none", "controller.supg.idle=wrap", "controller.supg.modulation.load_feedback=4"],
        ['controller.supg.modulation.sensors=["load","torque.knee"]', "controller.supg.modulation.rate=1",
         "controller.supg.modulation.shape=1", "controller.supg.modulation.load_feedback=1"],
        ["controller.supg.seam.residual_s=0.02", "controller.supg.seam.filter_s=0.03", "controller.supg.idle=wrap"],
        [*TOLD, "trial.first_command=before_first_step"],
        [*TOLD, "trial.first_command=before_first_step", "controller.supg.idle=wrap", "controller.supg.seam.residual_s=0.05"],
    ],
    "paper": [
        [],
        ["controller.supg.trigger=level", "controller.supg.idle=mid"],
        ["controller.supg.offset=phase", "controller.supg.idle=wrap", "cppn.recurrent=true"],
        ["controller.supg.start_tick=1", "trial.first_command=after_first_step"],
        ["controller.supg.seam.time=circle", "controller.supg.seam.residual_s=0.1"],
        ["controller.supg.seam.detrend=true", "controller.supg.seam.filter_s=0.02", "controller.supg.seam.filter_order=1"],
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
                "mid", "hold", "wrap", "bounce", "jump", "other rate", "shift", "pull", "refractory", "reshaped", "held", "pulled by load",
                "neuron that is not 0", "link to hidden", "link to rate", "link to amplitude", "link to shift", "link to coupling"],
    "paper": ["hidden node", "delayed start", "start by phase", "trigger in mid-cycle", "trigger ignored", "mid", "hold", "wrap"],
    "robust": ["hidden node", "delayed start", "start by phase", "trigger in mid-cycle", "hold", "wrap"],
}
# Small, and with more structural mutations than a long evolution needs, so that CPPNs soon have hidden nodes and cycles.
SMALL = ["population.size=40", "engine=batch", "mutation.add_node_share=0.3", "mutation.add_link_share=0.4",
         "trial.duration_s=6", "seed=3"]


# How far a timer may be off, ticks, that rounding of a rate and of a sensor's digits leave open.
TIMER_TOLERANCE = 2e-3


class Difference(Exception):
    pass


def follow(champion, recording, events):
    """Raises Difference where the recording is not what the model says."""
    patterns = Patterns(champion)
    events["cycle in a CPPN"] += patterns.cppn.has_cycle()
    events["hidden node"] += patterns.cppn.hidden_count
    events["champion"] += 1
    recorded_offsets = recording.header["controller"]["offset_ticks"]
    modulation = Modulation(patterns, champion)
    net = mixed.Net(patterns, champion, events) if champion["controller"]["kind"] == "mixed" else None
    is_modulated = "modulation" in patterns.settings or net is not None
    legs = []
    for name, offsets, recorded in zip(patterns.legs, patterns.offset_ticks, recorded_offsets):
        if recorded not in offsets:
            raise Difference(f"offset of {name}: {recorded} recorded, {offsets} by the model")
        legs.append((ModulatedLeg if is_modulated else Leg)(patterns.settings, patterns.period_ticks, recorded, events))
    limits = [(joint["lower_rad"], joint["upper_rad"]) for joint in champion["robot"]["joints"]]
    seams = [Seam(patterns.seam, champion["trial"]["timestep_s"], *limit, tolerance)
             for limit, tolerance in zip(limits, patterns.tolerance_rad)]
    waits = champion["trial"]["first_command"] == "after_first_step"

    # What a phase begins with: a wait makes it later.
    ahead = -1.0 if patterns.settings["offset"] == "delay" else 1.0
    offsets = [ahead * ticks / patterns.period_ticks for ticks in recorded_offsets]

    for frame in range(recording.frames):
        if net:
            rates, amplitudes, shifts = net.tick(recording, frame, [mixed.phase(leg) for leg in legs], offsets)
        # Touches are felt in the pose at the beginning of a frame's step, and read before the next one.
        felt = max(frame - 1, 0)
        for number, (leg, name, joints) in enumerate(zip(legs, patterns.legs, patterns.joints_of_leg)):
            begun = frame > 0 or not waits
            where, recorded_timer, sensed = f"{name}, step {frame + 1}", recording["timer." + name][frame], []
            touching = recording["touch." + name][felt] == 1.0
            if begun and is_modulated:
                sensed = modulation.sensed(number, recording, frame)
                rho = rates[number] if net else sum(rate[number] * s for rate, s in zip(modulation.rates, sensed))
                leg.tick_sensing(touching, rho, recorded_timer, modulation.pull(number, leg.timer, recording, frame))
                if abs(recorded_timer - leg.timer) < TIMER_TOLERANCE:
                    leg.timer = float(recorded_timer)
            elif begun:
                leg.tick(touching)
            expect_equal(recorded_timer, leg.timer, "timer of " + where)
            expect_equal(recording["trigger." + name][frame], float(leg.triggered), "trigger of " + where)
            for joint in joints:
                if not begun:
                    expected, tolerance = 0.0, 1e-6  # the start pose
                else:
                    jumped = leg.timer != leg.continued_timer
                    both = [patterns.shifted_rad(joint, timer, modulation, sensed) for timer in (leg.continued_timer, leg.timer)]
                    if net:
                        name, middle = patterns.joints[joint], patterns.middle_rad[joint]
                        half = 0.5 * (limits[joint][1] - limits[joint][0])
                        both = [y + (y - middle) * amplitudes[name] + shifts[name] * half for y in both]
                        events["reshaped"] += abs(shifts[name]) + abs(amplitudes[name]) > 0.01
                    continued_rad, present_rad = (min(max(y, limits[joint][0]), limits[joint][1]) for y in both)
                    expected, tolerance = seams[joint].next(continued_rad, present_rad, jumped)
                    events["shift"] += any(abs(modulation.shift_rad(joint, i, 0, s)) > 0.01 for i, s in enumerate(sensed))
                    if is_modulated:
                        tolerance += 1e-4  # a sensor read in other digits
                    events["jump"] += jumped
                    if leg.timer == STOPPED and not seams[joint].smooths and not net:
                        tolerance = 1e-6
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
