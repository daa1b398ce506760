"""SUPGs that sensors modulate, as src/controllers/supg.hpp's header and docs/CONTROLLERS.md describe them."""

import math

import numpy as np

from supg import STOPPED, Leg, between_ticks

PARTS = 1 << 14


class Modulation:
    """What a champion's CPPN says of its sensors: shifts_rad[sensor][joint][level][tick], rates[sensor][leg]."""

    def __init__(self, patterns, champion):
        self.patterns, self.robot = patterns, champion["robot"]
        self.settings = patterns.settings.get("modulation", {})
        self.names = self.settings.get("sensors", [])
        self.load_feedback = self.settings.get("load_feedback", 0.0)
        outputs = len(champion["controller"]["substrate"]["outputs"])
        times = np.arange(patterns.period_ticks + 1) / patterns.period_ticks
        self.by_reading = self.settings.get("shape_by") == "reading"
        self.levels = [-1.0, -0.5, 0.0, 0.5, 1.0] if self.by_reading else [-1.0, 1.0]
        self.shifts_rad, self.rates = [], []
        for i in range(len(self.names)):
            of_rate = self._only(i, 1.0) if self.by_reading else [(i + 1) / len(self.names)]
            self.shifts_rad.append([])
            for number, joint in enumerate(self.robot["joints"]):
                if self.by_reading:
                    at = [patterns.targets_of_reading_rad(joint, self._only(i, level)) for level in self.levels]
                    self.shifts_rad[i].append(self.settings["shape"] * (np.array(at) - patterns.targets_rad[number]))
                else:
                    half = 0.5 * (joint["upper_rad"] - joint["lower_rad"])
                    gain = self.settings["shape"] * half * self._output(joint["name"], "pattern", times, of_rate, outputs)
                    self.shifts_rad[i].append(np.array([-gain, gain]))
            self.rates.append([])
            for joints in patterns.joints_of_leg:
                # The last output, behind those of the substrate.
                rate = self._output(patterns.joints[joints[0]], "offset", [0.0], of_rate, -1)[0]
                self.rates[i].append(self.settings["rate"] * rate)

        self._shifts_rad_by_tick = [[rows.tolist() for rows in of_sensor] for of_sensor in self.shifts_rad]

    def _only(self, sensor, says):
        return [says if i == sensor else 0.0 for i in range(len(self.names))]

    def _output(self, joint_name, like, times, sensing, output):
        points, _ = self.patterns.points(joint_name, like, times, sensing)
        return np.clip(self.patterns.cppn.evaluate(points, np.float32)[:, output], -1.0, 1.0)

    def shift_rad(self, joint, sensor, timer, s):
        """What a sensor that says s shifts a target by, at a timer that need not be whole."""
        at_levels = [between_ticks(row, timer) for row in self._shifts_rad_by_tick[sensor][joint]]
        # Levels are equally far from each other.
        return between_ticks(at_levels, (s - self.levels[0]) / (self.levels[1] - self.levels[0]))

    def sensed(self, leg, senses, frame):
        """What the sensors of a leg say in a frame."""
        return [senses.within_one(self._of_leg(name, leg), frame) for name in self.names]

    def _of_leg(self, name, leg):
        kind, _, joint_type = name.partition(".")
        if joint_type:
            joint = self.patterns.joints_of_leg[leg][self.robot["joint_types"].index(joint_type)]
            return f"{kind}.{self.patterns.joints[joint]}"
        return f"{kind}.{self.patterns.legs[leg]}" if kind in ("touch", "load") else kind

    def pull(self, leg, timer, senses, frame):
        """How much the load of a leg's foot takes off its timer's growth, ticks."""
        if self.load_feedback == 0.0:
            return 0.0
        load = senses.within_one("load." + self.patterns.legs[leg], frame)
        return self.load_feedback * load * math.cos(2.0 * math.pi * max(math.floor(timer), 0) / self.patterns.period_ticks)


class ModulatedLeg(Leg):
    """Its timer is a number of ticks that need not be whole. What rounding leaves open is taken from the recording."""

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.modulation = self.settings.get("modulation", {"reset": 1.0, "refractory_ticks": 0})
        self.rests = 0

    def tick_sensing(self, touching, rho, recorded_timer, pull=0.0):
        """Raises nothing: the timer is the nearest to the recorded one that the model allows."""
        self.tick_number += 1
        delayed = self.settings["offset"] == "delay"
        first_start = self.offset_ticks + 1 if delayed else 1
        lands = touching and self.settings["trigger"] != "none" and (
            self.settings["trigger"] == "level" or self.ticks_in_the_air >= self.settings["trigger_debounce_ticks"])
        self.ticks_in_the_air = 0 if touching else self.ticks_in_the_air + 1
        self.triggered = lands and self.tick_number > first_start and self.rests == 0
        if lands and self.rests > 0:
            self._note("refractory")
        self.rests = self.modulation["refractory_ticks"] if self.triggered else max(self.rests - 1, 0)
        starts = self.tick_number == first_start
        before = float(self.offset_ticks) if starts and not delayed else self.timer
        growth = 2.0 ** min(max(rho, -1.0), 1.0)
        if abs(growth - 1.0) > 0.01:
            self._note("other rate")
        if pull != 0.0:
            self._note("held" if pull >= growth else "pulled by load")
            growth = min(max(growth - pull, 0.0), 2.0)
        choices = []
        for error in (0.0, -2.0 / PARTS, 2.0 / PARTS):
            on, timer = self._grown(before, growth + error)
            if starts and not delayed:
                on = timer
            if starts and delayed:
                timer = float(self.settings["start_tick"])
            if self.triggered:
                timer = self._pulled(timer)
            choices.append((abs(timer - recorded_timer), on, timer))
        _, self.continued_timer, self.timer = min(choices)

    def _grown(self, before, growth):
        """What the timer would be without a jump, and what it becomes."""
        if before == STOPPED:
            return STOPPED, STOPPED
        total = before + growth
        if total < self.period_ticks:
            return total, total
        idle = self.settings["idle"]
        return self.period_ticks, {"mid": STOPPED, "hold": self.period_ticks, "wrap": total - self.period_ticks}[idle]

    def _pulled(self, timer):
        share, start = self.modulation["reset"], self.settings["start_tick"]
        if share == 0.0:
            return timer
        self._note("pull" if share < 1.0 and timer != STOPPED else "reset")
        if timer == STOPPED:
            return float(start)
        way = start - timer
        if way <= -0.5 * self.period_ticks:
            way += self.period_ticks
        timer += way * share
        return timer - self.period_ticks if timer >= self.period_ticks else timer
