"""SUPG controllers as docs/AMBIGUITIES.md, docs/CONVENTIONS.md and src/controllers/supg.hpp's header describe them."""

import math

import numpy as np

from cppn import Cppn

STOPPED = -1


def between_ticks(values, timer):
    """What a list with a value for each tick says at a timer that need not be whole."""
    tick = min(int(timer), len(values) - 2)
    return values[tick] + (timer - tick) * (values[tick + 1] - values[tick])


class Patterns:
    """What a champion's CPPN says: targets_rad[joint][timer], timer 0 … period; tolerance_rad[joint]; offset_ticks[leg].

    The tolerance is 1e-5 rad and ten times what the CPPN's rounding to single precision makes of the joint's targets:
    a CPPN that feeds on itself may enlarge it. Where that makes the ticks of an offset uncertain, both are in
    offset_ticks[leg]."""

    def __init__(self, champion):
        controller, robot = champion["controller"], champion["robot"]
        self.settings = controller["supg"]
        # A file without the table has targets that jump.
        self.seam = {"time": "line", "detrend": False, "residual_s": 0.0, "filter_s": 0.0, "filter_order": 2} | self.settings.get("seam", {})
        self.time_inputs = [0.0] if self.seam["time"] == "line" else [0.0, 0.0]
        self.period_ticks = round(self.settings["period_s"] / champion["trial"]["timestep_s"])
        self.legs = [leg["name"] for leg in robot["legs"]]
        self.joints_of_leg = [leg["joints"] for leg in robot["legs"]]
        self.joints = [joint["name"] for joint in robot["joints"]]
        self.middle_rad = [0.5 * (joint["lower_rad"] + joint["upper_rad"]) for joint in robot["joints"]]
        self.cppn = Cppn(champion["genome"], champion["cppn"])
        self._substrate = controller["substrate"]
        self._nodes = {node["joint"]: node for node in self._substrate["nodes"]}

        times = np.arange(self.period_ticks + 1) / self.period_ticks
        self.targets_rad, self.tolerance_rad, self._targets_rad_by_tick = [], [], []
        for joint in robot["joints"]:
            both = [self._targets_rad(joint, times, dtype) for dtype in (np.float32, np.float64)]
            self.targets_rad.append(both[0])
            self._targets_rad_by_tick.append(both[0].tolist())
            self.tolerance_rad.append(1e-5 + 10.0 * np.abs(both[0] - both[1]).max())
        self.offset_ticks = [self._offset_ticks(self.joints[joints[0]]) for joints in self.joints_of_leg]

    def shifted_rad(self, joint, timer, modulation, sensed):
        """The pattern at a timer that need not be whole, and what sensors shift it by."""
        if timer == STOPPED:
            return self.middle_rad[joint]
        shift = sum(modulation.shift_rad(joint, i, timer, s) for i, s in enumerate(sensed))
        return between_ticks(self._targets_rad_by_tick[joint], timer) + shift

    def points(self, joint_name, property_name, times, sensing=None):
        """Queries of a node, and the output that says this property of it; `sensing`: the CPPN's last inputs."""
        place = dict(zip(self._substrate["coordinates"], self._nodes[joint_name]["at"]))
        node = self._nodes[joint_name]
        settings = next(p for p in self._substrate["properties"]
                        if p["property"] == property_name and p["of"] in (node["name"], node["group"]))
        for coordinate in settings["zero"]:
            place[coordinate] = 0.0
        modulation = self.settings.get("modulation", {})
        by_reading = modulation.get("shape_by") == "reading"
        count = len(modulation.get("sensors", [])) if by_reading else min(len(modulation.get("sensors", [])), 1)
        sensing = [0.0] * count if sensing is None else sensing
        # With links the CPPN has coordinates of a target, too, which a node's own queries leave at 0.
        target = [0.0] * len(place) if self._substrate["links"] else []
        points = np.array([[*place.values(), *target, *self._time(time, property_name), *sensing] for time in times])
        return points, self._substrate["outputs"].index(settings["output"])

    def _time(self, time, property_name):
        """The CPPN's inputs for a time in periods; on a circle nothing but a pattern is anywhere."""
        if self.seam["time"] == "line":
            return [time]
        angle = 2.0 * math.pi * (time % 1.0)
        return [math.sin(angle), math.cos(angle)] if property_name == "pattern" else [0.0, 0.0]

    def targets_of_reading_rad(self, joint, readings):
        """What the targets of a joint are, tick by tick, where the CPPN's sensors say this."""
        return self._targets_rad(joint, np.arange(self.period_ticks + 1) / self.period_ticks, np.float32, readings)

    def _targets_rad(self, joint, times, dtype, readings=None):
        points, output = self.points(joint["name"], "pattern", times, readings)
        pattern = np.clip(self.cppn.evaluate(points, dtype)[:, output], -1.0, 1.0)
        if self.seam["detrend"]:
            pattern = pattern - (times - 0.5) * (pattern[-1] - pattern[0])
        command = np.clip((pattern + 1.0) / 2.0, 0.0, 1.0)
        return joint["lower_rad"] + (joint["upper_rad"] - joint["lower_rad"]) * command

    def _offset_ticks(self, joint_name):
        points, output = self.points(joint_name, "offset", [0.0])
        single, double = (self.cppn.evaluate(points, dtype)[0, output] for dtype in (np.float32, np.float64))
        doubt = 1e-6 + 10.0 * abs(single - double)
        return {self._ticks(a) for a in (single, single - doubt, single + doubt)} if self._is_close_call(single, doubt) else {
            self._ticks(single)
        }

    def _is_close_call(self, a, doubt):
        ticks = (a + 1.0) / 2.0 * self.period_ticks
        exact = ticks == round(ticks)  # as in a CPPN without links to this output
        return not exact and abs(ticks - round(ticks)) < doubt * self.period_ticks

    def _ticks(self, a):
        ticks = math.ceil((min(max(a, -1.0), 1.0) + 1.0) / 2.0 * self.period_ticks)
        return min(max(ticks, 1), self.period_ticks - 1)


class Leg:
    """The timer of one leg. What happened is counted in `events`."""

    def __init__(self, settings, period_ticks, offset_ticks, events):
        self.settings, self.period_ticks, self.offset_ticks, self.events = settings, period_ticks, offset_ticks, events
        self.tick_number = 0
        self.timer = STOPPED
        self.continued_timer = STOPPED  # what the timer would be in this tick without a jump
        self.triggered = False
        self.ticks_in_the_air = 0  # all feet count as touching before tick 1

    def tick(self, touching):
        self.tick_number += 1
        if self.settings["trigger"] == "random":
            raise ValueError("triggers drawn by chance are not part of the model")
        lands = touching and self.settings["trigger"] != "none" and (
            self.settings["trigger"] == "level" or self.ticks_in_the_air >= self.settings["trigger_debounce_ticks"]
        )
        if touching and self.ticks_in_the_air > 0 and not lands:
            self._note("bounce")
        self.ticks_in_the_air = 0 if touching else self.ticks_in_the_air + 1

        delayed = self.settings["offset"] == "delay"
        first_start = self.offset_ticks + 1 if delayed else 1
        self.continued_timer = STOPPED if self.timer == STOPPED else min(self.timer + 1, self.period_ticks)
        self.triggered = lands and self.tick_number > first_start
        if lands and not self.triggered:
            self._note("trigger ignored")
        if self.tick_number == first_start:
            self._note("delayed start" if delayed else "start by phase")
            if delayed:
                self.timer = self.settings["start_tick"]
            else:
                self.timer = self.offset_ticks
                self._advance()
                self.continued_timer = self.timer  # before tick 1 there is nothing from which to jump
        elif self.triggered:
            self._note("trigger" if self.timer == STOPPED else "trigger in mid-cycle")
            self.timer = self.settings["start_tick"]
        elif self.timer != STOPPED:
            self._advance()

    def _advance(self):
        self.timer += 1
        if self.timer < self.period_ticks:
            return
        idle = self.settings["idle"]
        self._note(idle)
        self.timer = {"mid": STOPPED, "hold": self.period_ticks, "wrap": 0}[idle]

    def _note(self, event):
        self.events[event] += 1
