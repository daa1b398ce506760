"""What controllers sense, as docs/CONTROLLERS.md's table and src/trial/senses.hpp's header describe it, from a recording."""

import math

import numpy as np

# What counts as 1, where that does not depend on the robot.
FULL = {"touch": 1.0, "speed": 10.0, "roll": 0.5, "pitch": 0.5, "yaw": math.pi, "yaw_rate": 2.0, "command_speed": 1.0,
        "command_turn": 1.0, "command_stop": 1.0, "heading_error": 1.0}


class Senses:
    """Readings by name of a sensor ("pitch", "touch.FL") and frame: late and held as the champion has it, not scaled. Noise
    is none: trials that are followed are undisturbed."""

    def __init__(self, champion, recording, events):
        self.recording, self.events, self.robot = recording, events, champion["robot"]
        self.timestep_s = champion["trial"]["timestep_s"]
        self.waits = champion["trial"]["first_command"] == "after_first_step"
        self.joints = {joint["name"]: joint for joint in self.robot["joints"]}
        self.weight_n = sum(body["mass_kg"] for body in self.robot["bodies"]) * math.hypot(*self.robot["gravity_m_s2"])
        self.items = {item["of"]: item for item in champion["controller"].get("sensing", {}).get("sensors", [])}
        self.lead_rad = champion["controller"].get("sensing", {}).get("heading", {}).get("lead_rad", 0.0)
        self.errors = []

    def reading(self, name, frame):
        item = self._item(name)
        every, late = (self._ticks(item.get(key, 0.0)) for key in ("dead_time_s", "delay_s"))
        if every > 1:
            self.events["held reading"] += frame % every != 0
            frame -= frame % every
        self.events["late reading"] += late > 0 and frame >= late
        return self._quantity(name, max(frame - late, 0))

    def scale(self, name):
        return self._item(name).get("scale", 1.0)

    def within_one(self, name, frame):
        """A reading by what counts as 1, for SUPGs and mixed substrates."""
        kind, _, owner = name.partition(".")
        full, middle = FULL.get(kind), 0.0
        if kind == "angle":
            joint = self.joints[owner]
            full, middle = 0.5 * (joint["upper_rad"] - joint["lower_rad"]), 0.5 * (joint["upper_rad"] + joint["lower_rad"])
        elif kind == "torque":
            full = self.joints[owner]["servo"]["max_torque_nm"]
        elif kind == "load":
            full = self.weight_n
        return min(max((self.reading(name, frame) - middle) * self.scale(name) / full, -1.0), 1.0)

    def _item(self, name):
        return self.items.get(name) or self.items.get(name.partition(".")[0], {})

    def _ticks(self, time_s):
        return round(time_s / self.timestep_s)

    def _quantity(self, name, frame):
        """What is so before a frame's step; before the first, the start pose at rest."""
        kind, _, owner = name.partition(".")
        felt = frame - 1
        if kind == "touch":  # a frame's are those of the pose before its step
            return float(self.recording["touch." + owner][max(felt, 0)])
        if kind in ("load", "torque"):
            return float(self.recording[f"{kind}.{owner}"][felt]) if felt >= 0 else 0.0
        if kind == "angle":
            return self._angle(owner, felt)
        if kind == "speed":
            return (self._angle(owner, felt) - self._angle(owner, felt - 1)) / self.timestep_s
        if kind == "yaw_rate":
            return _turn(self.attitude(felt)[2] - self.attitude(felt - 1)[2]) / self.timestep_s
        if kind in ("roll", "pitch", "yaw"):
            return self.attitude(felt)[("roll", "pitch", "yaw").index(kind)]
        speed, turn = (float(self.recording["command." + what][frame]) for what in ("speed", "turn"))
        if kind == "heading_error":
            return self._heading_error(frame)
        return {"command_speed": speed, "command_turn": turn, "command_stop": float(speed == 0.0 and turn == 0.0)}[kind]

    def _angle(self, joint, felt):
        return float(self.recording["angle." + joint][felt]) if felt >= 0 else 0.0

    def attitude(self, felt):
        """Roll, pitch, yaw after a frame, or in the start pose."""
        if felt < 0:
            w, x, y, z = self.robot["bodies"][0]["rotation"]
        else:
            w, x, y, z = (float(self.recording["root.q" + axis][felt]) for axis in "wxyz")
        return (math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
                math.asin(min(max(2.0 * (w * y - x * z), -1.0), 1.0)),
                math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))

    def _heading_error(self, frame):
        """Commanded turns are added up from the controller's first tick on."""
        begins = 1 if self.waits else 0
        if frame < begins:
            return 0.0
        for f in range(begins + len(self.errors), frame + 1):
            yaw_rad = self.attitude(f - 1)[2]
            if self.errors:
                self.wanted_rad += float(self.recording["command.turn"][f - 1]) * self.timestep_s
            else:
                self.wanted_rad = yaw_rad
            error_rad = _turn(self.wanted_rad - yaw_rad)
            if 0.0 < self.lead_rad < abs(error_rad):
                self.events["heading held by its lead"] += 1
                error_rad = math.copysign(self.lead_rad, error_rad)
                self.wanted_rad = yaw_rad + error_rad
            self.errors.append(error_rad)
        return self.errors[frame - begins]


def _turn(angle_rad):
    return math.remainder(angle_rad, 2.0 * math.pi)


class Contacts:
    """What stands for the touches of feet (src/controllers/supg_contact.hpp), leg by leg."""

    # Rates of angles of seven digits, by the tick's square: what is nearer to the threshold is left open.
    SHOCK_TOLERANCE = 0.03

    def __init__(self, settings, senses, legs, events):
        self.settings, self.senses, self.legs, self.events = settings, senses, legs, events
        self.source = settings.get("source", "touch")
        robot = senses.robot
        wanted = settings.get("joint_type", "")
        self.joints = [[robot["joints"][joint]["name"] for kind, joint in zip(robot["joint_types"], leg["joints"])
                        if joint >= 0 and wanted in ("", kind)] for leg in robot["legs"]]
        self.down = [False] * len(legs)
        self.since = [0] * len(legs)
        self.tick_number = 0
        self.angles = []

    def tick(self, frame, triggered):
        """Whether each leg has a contact. `triggered`: what the recording says of each, for what rounding leaves open."""
        self.tick_number += 1
        if self.source == "touch":
            return [self.senses.reading("touch." + leg, frame) > 0.5 for leg in self.legs]
        if self.source == "shock":
            return self._shock(frame, triggered)
        begins = np.float32(self.settings["threshold"])
        ends = np.float32(self.settings["release"] * self.settings["threshold"])
        for leg, joints in enumerate(self.joints):
            known = self.source == "torque" or self.tick_number > 1
            number = max(self._number(joint, frame) for joint in joints) if known else np.float32(0.0)
            was, self.down[leg] = self.down[leg], bool(number > (ends if self.down[leg] else begins))
            self.events["contact by " + self.source] += self.down[leg] and not was
        return list(self.down)

    def _number(self, joint, frame):
        if self.source == "torque":
            return abs(np.float32(self.senses.reading("torque." + joint, frame)))
        target = self.senses.recording["target." + joint][frame - 1]
        return abs(target - np.float32(self.senses.reading("angle." + joint, frame)))

    def _shock(self, frame, triggered):
        self.angles = [*self.angles[-2:], [self.senses.reading(axis, frame) for axis in ("roll", "pitch")]]
        self.since = [since + 1 for since in self.since]
        longest = self.since.index(max(self.since))
        contacts = [False] * len(self.legs)
        if len(self.angles) < 3:
            return contacts
        number = sum(abs((c - b) - (b - a)) for a, b, c in zip(*self.angles)) / self.senses.timestep_s**2
        excess = number - self.settings["threshold"]
        is_open = abs(excess) < self.SHOCK_TOLERANCE
        self.events["shock that rounding decides"] += is_open
        contacts[longest] = triggered[longest] if is_open else excess > 0.0
        if contacts[longest]:
            self.since[longest] = 0
            self.events["contact by shock"] += 1
        return contacts
