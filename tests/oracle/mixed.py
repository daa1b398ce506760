"""SUPGs, neurons and sensors in one substrate, as src/controllers/mixed.hpp's header and docs/STEERING.md describe them."""

import math

import numpy as np

from supg import STOPPED

FULL = {"touch": 1.0, "command_speed": 1.0, "command_turn": 1.0, "command_stop": 1.0, "heading_error": 1.0, "yaw_rate": 2.0}
GAINS = {"rate": 1.0, "amplitude": 1.0, "shift": 0.5, "coupling": 1.0}
# How far a neuron's value by the recording's digits may be from what it is.
NEURON_TOLERANCE = 2e-4


def yaw(recording, frame):
    w, x, y, z = (float(recording["root.q" + axis][frame]) for axis in "wxyz")
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


class Net:
    """Its weights by the champion's CPPN; tick() says what acts on the SUPGs. Where rounding leaves a neuron open,
    its value is taken from the recording; `doubt` is how far the two were apart at most."""

    def __init__(self, patterns, champion, events):
        controller, robot = champion["controller"], champion["robot"]
        self.patterns, self.events, self.timestep_s = patterns, events, champion["trial"]["timestep_s"]
        self.substrate, self.nodes = controller["substrate"], controller["substrate"]["nodes"]
        self.gains = GAINS | controller.get("mixed", {})
        self.leg_of = {robot["joints"][joint]["name"]: leg for leg, joints in enumerate(patterns.joints_of_leg) for joint in joints}
        self.neurons = [node for node in self.nodes if not node["sensor"] and not node["joint"]]
        self.values = {node["name"]: 0.0 for node in self.nodes}
        self.doubt = 0.0
        self.links = [(source, target, port, weight) for source, target, port, weight in self._links() if weight != 0.0]
        for _, _, port, _ in self.links:
            self.events["link to " + port] += 1
        self.bias = {node["name"]: self._property(node, "bias") for node in self.neurons}
        self.step = {node["name"]: 1.0 - math.exp(-self.timestep_s / self._property(node, "time_constant")) for node in self.neurons}
        self.wanted_yaw = None

    def tick(self, recording, frame, phases, offsets):
        """ρ by leg, amplitude and shift by joint's name. `phases`: of the legs before this tick, in periods, or None."""
        self._sense(recording, frame)
        after = {}
        for node in self.neurons:
            name = node["name"]
            total = self.bias[name] + sum(w * self.values[s] for s, t, port, w in self.links if t == name and port == "hidden")
            after[name] = self.values[name] + self.step[name] * (math.tanh(total) - self.values[name])
        for name, value in after.items():
            recorded = float(recording["neuron." + name][frame])
            if abs(recorded - value) > NEURON_TOLERANCE:
                raise ValueError(f"neuron {name}, step {frame + 1}: {recorded} recorded, {value} by the model")
            self.events["neuron that is not 0"] += abs(recorded) > 0.01
            self.values[name] = recorded
        joint_of = {node["name"]: node["joint"] for node in self.nodes}
        rho = [0.0] * len(phases)
        amplitude, shift = {joint: 0.0 for joint in self.leg_of}, {joint: 0.0 for joint in self.leg_of}
        for source, target, port, weight in self.links:
            if port == "hidden":
                continue
            joint, by = joint_of[target], weight * self.gains[port] / self.substrate["weight_range"]
            leg = self.leg_of[joint]
            if port == "coupling":
                other = self.leg_of[joint_of[source]]
                if phases[leg] is not None and phases[other] is not None:
                    rho[leg] += by * math.sin(2.0 * math.pi * (phases[other] - phases[leg] - (offsets[other] - offsets[leg])))
            elif port == "rate":
                rho[leg] += by * self.values[source]
            else:
                (amplitude if port == "amplitude" else shift)[joint] += by * self.values[source]
        one = lambda x: min(max(x, -1.0), 1.0)
        return [one(r) for r in rho], {j: one(a) for j, a in amplitude.items()}, {j: one(b) for j, b in shift.items()}

    def _sense(self, recording, frame):
        felt = frame - 1
        command = recording["command.speed"][frame], recording["command.turn"][frame]
        heading = yaw(recording, felt) if felt >= 0 else 0.0
        before = yaw(recording, felt - 1) if felt >= 1 else 0.0
        turn = lambda angle: math.remainder(angle, 2.0 * math.pi)
        if self.wanted_yaw is None:
            self.wanted_yaw = heading
        readings = {"command_speed": float(command[0]), "command_turn": float(command[1]),
                    "command_stop": float(command[0] == 0.0 and command[1] == 0.0),
                    "heading_error": turn(self.wanted_yaw - heading), "yaw_rate": turn(heading - before) / self.timestep_s}
        self.wanted_yaw = turn(self.wanted_yaw + float(command[1]) * self.timestep_s)
        for node in self.nodes:
            if not node["sensor"]:
                continue
            kind, _, owner = node["sensor"].partition(".")
            # A frame's touches are those of the pose before its step.
            reading = recording["touch." + owner][max(felt, 0)] if kind == "touch" else readings[kind]
            self.values[node["name"]] = min(max(float(reading) / FULL[kind], -1.0), 1.0)

    def _inputs(self, source, target):
        return [*source["at"], *(target["at"] if target else [0.0] * len(source["at"])), 0.0]

    def _group(self, name):
        return [node for node in self.nodes if name in (node["name"], node["group"])]

    def _links(self):
        found, points = [], []
        for item in self.substrate["links"]:
            for source in self._group(item["from"]):
                for target in self._group(item["to"]):
                    if source is not target:
                        times = item.get("times", "")
                        found.append((source["name"], target["name"], item.get("port", "hidden"),
                                      self.substrate["outputs"].index(item["weight"]),
                                      target["at"][self.substrate["coordinates"].index(times)] if times else 1.0))
                        points.append(self._inputs(source, target))
        outputs = self.patterns.cppn.evaluate(np.array(points), np.float32)
        threshold, weight_range = self.substrate["expression_threshold"], self.substrate["weight_range"]
        for (source, target, port, output, factor), row in zip(found, outputs):
            o = min(max(float(row[output]), -1.0), 1.0)
            excess = (abs(o) - threshold) / (1.0 - threshold)
            yield source, target, port, factor * math.copysign(excess * weight_range, o) if excess > 0.0 else 0.0

    def _property(self, node, name):
        settings = next(p for p in self.substrate["properties"] if p["property"] == name and p["of"] in (node["name"], node["group"]))
        o = self.patterns.cppn.evaluate(np.array([self._inputs(node, None)]), np.float32)[0, self.substrate["outputs"].index(settings["output"])]
        return 0.5 * (settings["low"] + settings["high"]) + 0.5 * (settings["high"] - settings["low"]) * min(max(float(o), -1.0), 1.0)


def phase(leg):
    """Of a leg of supg.Leg, in periods."""
    return None if leg.timer == STOPPED else leg.timer / leg.period_ticks
