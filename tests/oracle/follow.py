#!/usr/bin/env python3
"""Evolves small champions under a preset, records how they walk, and follows each recording tick by tick with an
independent model: from what the robot did and was told and the champion's genome alone it says what every timer, trigger,
neuron and target must be. Timers, triggers and offsets must be equal, targets within supg.Patterns' tolerance, or those of
mixed.py and neural.py.

It cannot follow what a recording does not have: the noise of sensors, which is drawn in trials under noise alone (those
followed are undisturbed), and triggers by chance. It has no model of sine wave networks, oscillators, steering by hand and
switching, whose exports to C are compared with them to the bit.

follow.py PROGRAM PRESET     evolves and follows ("sensing": CTRNNs, too)
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
import neural
from modulated import ModulatedLeg, Modulation
from seam import Seam
from senses import Contacts, Senses
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
CTRNN = ["config=authors/ctrnn-objective.toml", "controller.substrate=auto", "command.kind=random", "command.stretch_s=1"]
RUNS["sensing"] = [
    ["controller.supg.contact.source=torque", "controller.supg.contact.threshold=3"],
    ["controller.supg.contact.source=tracking", "controller.supg.contact.joint_type=knee", "controller.supg.contact.threshold=0.05",
     "controller.supg.idle=wrap", "controller.supg.seam.residual_s=0.05", "trial.first_command=before_first_step"],
    ["controller.supg.contact.source=shock", "controller.supg.contact.threshold=5", "controller.supg.modulation.reset=0.5"],
    ["controller.supg.contact.source=torque", "controller.supg.contact.threshold=4",
     'controller.sensing.sensors=[{of="torque",delay_s=0.02},{of="pitch",dead_time_s=0.03}]',
     'controller.supg.modulation.sensors=["pitch","torque.knee"]', "controller.supg.modulation.rate=1"],
    ['controller.sensing.sensors=[{of="touch",delay_s=0.02,dead_time_s=0.04},{of="pitch",delay_s=0.05},{of="angle",scale=2.0}]',
     'controller.supg.modulation.sensors=["pitch","angle.knee","touch"]', "controller.supg.modulation.rate=1",
     "controller.supg.modulation.shape=1"],
    ["command.kind=random", "command.stretch_s=1", "controller.supg.modulation.rate=1", "controller.supg.modulation.shape=1",
     'controller.supg.modulation.sensors=["command_turn","command_stop","heading_error","yaw_rate","yaw","speed.knee"]'],
    ["command.kind=random", "command.stretch_s=1", "command.ramp_s=0.3", "controller.supg.modulation.rate=1",
     'controller.supg.modulation.sensors=["command_speed","roll"]', "trial.first_command=before_first_step",
     'controller.sensing.sensors=[{of="command_speed",scale=2.5,delay_s=0.2}]'],
    [*TOLD, 'controller.sensing.sensors=[{of="command_turn",scale=2.0,delay_s=0.1},{of="heading_error",dead_time_s=0.1}]'],
    [*TOLD, "controller.supg.contact.source=torque", "controller.supg.contact.threshold=3", "controller.supg.idle=wrap"],
    [*CTRNN, "controller.ctrnn.state=kept", "controller.ctrnn.steps_per_tick=1", "controller.ctrnn.motor_bias=evolved",
     'controller.ctrnn.sensors=["command_stop","command_speed","command_turn","heading_error","yaw_rate"]',
     "controller.sensing.heading.lead_rad=0.1",
     'controller.sensing.sensors=[{of="command_speed",scale=2.5},{of="yaw_rate",scale=0.5}]'],
    [*CTRNN, 'controller.ctrnn.sensors=["roll","pitch","yaw","command_turn"]',
     'controller.sensing.sensors=[{of="pitch",delay_s=0.05,dead_time_s=0.02},{of="touch",delay_s=0.02}]'],
    [*CTRNN, 'controller.ctrnn.sensors=["load","torque.knee","speed.hip_fb","angle.hip_io"]', "controller.ctrnn.equation=potential",
     "controller.ctrnn.integrator=exponential_euler", "trial.first_command=before_first_step",
     'controller.sensing.sensors=[{of="load",scale=0.02}]'],
    [*CTRNN, 'controller.ctrnn.sensors=["command_speed","pitch"]', "controller.ctrnn.state=kept", "controller.ctrnn.integrator=rk4"],
]
# What the recordings of a preset must have shown, so that following them means something.
SHOWN = {
    "authors": ["cycle in a CPPN", "hidden node", "start by phase", "delayed start", "trigger", "trigger in mid-cycle",
                "mid", "hold", "wrap", "bounce", "jump", "other rate", "shift", "pull", "refractory", "reshaped", "held", "pulled by load",
                "neuron that is not 0", "link to hidden", "link to rate", "link to amplitude", "link to shift", "link to coupling"],
    "paper": ["hidden node", "delayed start", "start by phase", "trigger in mid-cycle", "trigger ignored", "mid", "hold", "wrap"],
    "robust": ["hidden node", "delayed start", "start by phase", "trigger in mid-cycle", "hold", "wrap"],
    "sensing": ["contact by torque", "contact by tracking", "contact by shock", "trigger in mid-cycle", "pull", "late reading",
                "held reading", "heading held by its lead", "other rate", "shift", "reshaped", "neuron that is not 0", "neuron between its ends", "link to rate",
                *("neurons sense " + kind for kind in ("command_stop", "command_speed", "command_turn", "heading_error", "yaw_rate",
                                                       "roll", "pitch", "yaw", "load", "torque", "speed", "angle", "touch"))],
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
    events["champion"] += 1
    events["frame"] += recording.frames
    senses = Senses(champion, recording, events)
    (follow_neurons if champion["controller"]["kind"] == "ctrnn" else follow_legs)(champion, senses, events)


def follow_neurons(champion, senses, events):
    model, recording = neural.Model(champion, senses, events), senses.recording
    events["cycle in a CPPN"] += model.single.cppn.has_cycle()
    events["hidden node"] += model.single.cppn.hidden_count
    joints = champion["robot"]["joints"]
    for frame in range(recording.frames):
        if frame == 0 and senses.waits:
            for joint in joints:
                expect_near(recording["target." + joint["name"]][0], 0.0, 1e-6, f"target of {joint['name']}, step 1")
            continue
        values, tolerances = model.tick(frame)
        recorded = [float(recording["neuron." + name][frame]) for name in model.names]
        for name, *numbers in zip(model.names, recorded, values, tolerances):
            expect_near(*numbers, f"neuron {name}, step {frame + 1}")
        for joint in joints:
            neuron, width = model.joints[joint["name"]], joint["upper_rad"] - joint["lower_rad"]
            expect_near(recording["target." + joint["name"]][frame], joint["lower_rad"] + width * values[neuron],
                        width * tolerances[neuron], f"target of {joint['name']}, step {frame + 1}")
        events["neuron"] += len(values)
        events["doubtful neuron"] += int(np.sum(tolerances > 1e-2))
        events["neuron between its ends"] += int(np.sum(np.abs(values - 0.5) < 0.4))
        model.take(recorded)


def follow_legs(champion, senses, events):
    recording, patterns = senses.recording, Patterns(champion)
    events["cycle in a CPPN"] += patterns.cppn.has_cycle()
    events["hidden node"] += patterns.cppn.hidden_count
    recorded_offsets = recording.header["controller"]["offset_ticks"]
    modulation = Modulation(patterns, champion)
    net = mixed.Net(patterns, champion, events) if champion["controller"]["kind"] == "mixed" else None
    is_modulated = "modulation" in patterns.settings or net is not None
    legs = []
    for name, offsets, recorded in zip(patterns.legs, patterns.offset_ticks, recorded_offsets):
        if recorded not in offsets:
            raise Difference(f"offset of {name}: {recorded} recorded, {offsets} by the model")
        legs.append((ModulatedLeg if is_modulated else Leg)(patterns.settings, patterns.period_ticks, recorded, events))
    contacts = Contacts(patterns.settings.get("contact", {}), senses, patterns.legs, events)
    targets = Targets(champion, patterns, modulation, is_modulated, net is not None, events)

    # What a phase begins with: a wait makes it later.
    ahead = -1.0 if patterns.settings["offset"] == "delay" else 1.0
    offsets = [ahead * ticks / patterns.period_ticks for ticks in recorded_offsets]

    for frame in range(recording.frames):
        begun = frame > 0 or not senses.waits
        rates, reshaped = [0.0] * len(legs), None
        if begun and net:
            rates, *reshaped = net.tick(senses, frame, [mixed.phase(leg) for leg in legs], offsets)
        triggered = [recording["trigger." + name][frame] == 1.0 for name in patterns.legs]
        touching = contacts.tick(frame, triggered) if begun else [False] * len(legs)
        for number, leg in enumerate(legs):
            name, sensed = patterns.legs[number], []
            where, recorded_timer = f"{name}, step {frame + 1}", recording["timer." + name][frame]
            if begun and is_modulated:
                sensed = modulation.sensed(number, senses, frame)
                rho = rates[number] if net else sum(rate[number] * s for rate, s in zip(modulation.rates, sensed))
                leg.tick_sensing(touching[number], rho, recorded_timer, modulation.pull(number, leg.timer, senses, frame))
                if abs(recorded_timer - leg.timer) < TIMER_TOLERANCE:
                    leg.timer = float(recorded_timer)
            elif begun:
                leg.tick(touching[number])
            expect_equal(recorded_timer, leg.timer, "timer of " + where)
            expect_equal(recording["trigger." + name][frame], float(leg.triggered), "trigger of " + where)
            for joint in patterns.joints_of_leg[number]:
                expected, tolerance = targets.next(joint, leg, sensed, reshaped) if begun else (0.0, 1e-6)  # the start pose
                expect_near(recording["target." + patterns.joints[joint]][frame], expected, tolerance,
                            f"target of {patterns.joints[joint]}, step {frame + 1}")
    events["joint of a doubtful CPPN"] += int(np.sum(np.array(patterns.tolerance_rad) > 1e-3))
    events["joint"] += len(patterns.joints)


class Targets:
    """The targets of all joints, tick by tick."""

    def __init__(self, champion, patterns, modulation, is_modulated, is_mixed, events):
        self.patterns, self.modulation, self.events = patterns, modulation, events
        self.is_modulated, self.is_mixed = is_modulated, is_mixed
        self.limits = [(joint["lower_rad"], joint["upper_rad"]) for joint in champion["robot"]["joints"]]
        self.seams = [Seam(patterns.seam, champion["trial"]["timestep_s"], *limit, tolerance)
                      for limit, tolerance in zip(self.limits, patterns.tolerance_rad)]

    def next(self, joint, leg, sensed, reshaped):
        """Target and tolerance, rad. `reshaped`: amplitudes and shifts of a mixed substrate by joint's name, or None."""
        lower, upper = self.limits[joint]
        jumped = leg.timer != leg.continued_timer
        timers = (leg.continued_timer, leg.timer) if jumped else (leg.timer,)
        both = [self.patterns.shifted_rad(joint, timer, self.modulation, sensed) for timer in timers]
        if reshaped:
            amplitude, shift = (of_joint[self.patterns.joints[joint]] for of_joint in reshaped)
            middle = self.patterns.middle_rad[joint]
            both = [y + (y - middle) * amplitude + shift * 0.5 * (upper - lower) for y in both]
            self.events["reshaped"] += abs(shift) + abs(amplitude) > 0.01
        limited = [min(max(y, lower), upper) for y in both]
        continued_rad, present_rad = limited[0], limited[-1]
        expected, tolerance = self.seams[joint].next(continued_rad, present_rad, jumped)
        self.events["shift"] += any(abs(self.modulation.shift_rad(joint, i, 0, s)) > 0.01 for i, s in enumerate(sensed))
        self.events["jump"] += jumped
        if self.is_modulated:
            tolerance += 1e-4  # a sensor read in other digits
        if leg.timer == STOPPED and not self.seams[joint].smooths and not self.is_mixed:
            tolerance = 1e-6
        return expected, tolerance


def expect_near(recorded, expected, tolerance, what):
    if not abs(recorded - expected) <= tolerance:
        raise Difference(f"{what}: {recorded} recorded, {expected} ± {tolerance:.1e} by the model")


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
    named = [change.removeprefix("config=") for change in changes if change.startswith("config=")]
    config = named[0] if named else f"{'authors' if preset == 'sensing' else preset}/supg-objective.toml"
    settings = [part for setting in SMALL + changes[len(named):] for part in ("--set", setting)]
    out = folder / "run"
    run(program, "evolve", CONFIGS / config, *settings, "--generations", "16", "--jobs", "1",
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
    doubts = 5 * events["joint of a doubtful CPPN"] > events["joint"] or 5 * events["doubtful neuron"] > events["neuron"]
    if doubts:
        sys.exit("too many CPPNs whose rounding hides what they say")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
