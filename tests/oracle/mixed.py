"""SUPGs, neurons and sensors in one substrate, as src/controllers/mixed.hpp's header and docs/STEERING.md describe them."""

import math

from substrate import Layout
from supg import STOPPED

GAINS = {"rate": 1.0, "amplitude": 1.0, "shift": 0.5, "coupling": 1.0}
# How far a neuron's value by the recording's digits may be from what it is.
NEURON_TOLERANCE = 2e-4


class Net:
    """Its weights by the champion's CPPN; tick() says what acts on the SUPGs. Where rounding leaves a neuron open,
    its value is taken from the recording."""

    def __init__(self, patterns, champion, events):
        controller, robot = champion["controller"], champion["robot"]
        self.events, self.timestep_s = events, champion["trial"]["timestep_s"]
        self.substrate, self.nodes = controller["substrate"], controller["substrate"]["nodes"]
        self.gains = GAINS | controller.get("mixed", {})
        self.leg_of = {robot["joints"][joint]["name"]: leg for leg, joints in enumerate(patterns.joints_of_leg) for joint in joints}
        self.neurons = [node for node in self.nodes if not node["sensor"] and not node["joint"]]
        self.values = {node["name"]: 0.0 for node in self.nodes}
        layout = Layout(self.substrate, patterns.cppn, len(patterns.time_inputs))
        self.links = layout.links()
        for _, _, port, _ in self.links:
            self.events["link to " + port] += 1
        self.bias = {node["name"]: layout.property_of(node, "bias") for node in self.neurons}
        self.step = {node["name"]: 1.0 - math.exp(-self.timestep_s / layout.property_of(node, "time_constant")) for node in self.neurons}

    def tick(self, senses, frame, phases, offsets):
        """ρ by leg, amplitude and shift by joint's name. `phases`: of the legs before this tick, in periods, or None."""
        for node in self.nodes:
            if node["sensor"]:
                self.values[node["name"]] = senses.within_one(node["sensor"], frame)
        after = {}
        for node in self.neurons:
            name = node["name"]
            total = self.bias[name] + sum(w * self.values[s] for s, t, port, w in self.links if t == name and port == "hidden")
            after[name] = self.values[name] + self.step[name] * (math.tanh(total) - self.values[name])
        for name, value in after.items():
            recorded = float(senses.recording["neuron." + name][frame])
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


def phase(leg):
    """Of a leg of supg.Leg, in periods."""
    return None if leg.timer == STOPPED else leg.timer / leg.period_ticks
