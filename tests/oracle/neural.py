"""CTRNNs, as src/controllers/ctrnn.hpp's header describes them, in double precision."""

import math

import numpy as np

from cppn import Cppn
from substrate import Layout


class Network:
    """Neurons whose numbers a CPPN gives, evaluated in single or in double precision."""

    def __init__(self, champion, dtype):
        controller = champion["controller"]
        self.settings, substrate = controller["ctrnn"], controller["substrate"]
        self.cppn = Cppn(champion["genome"], champion["cppn"])
        layout = Layout(substrate, self.cppn, 0, dtype)
        self.neurons = [node for node in substrate["nodes"] if not node["sensor"]]
        self.sensors = [node for node in substrate["nodes"] if node["sensor"]]
        row = {node["name"]: i for i, node in enumerate(self.neurons)}
        column = {node["name"]: i for i, node in enumerate(self.sensors)}
        self.between, self.sensed = np.zeros((len(row), len(row))), np.zeros((len(row), len(column)))
        for source, target, _, weight in layout.links():
            if source in column:
                self.sensed[row[target], column[source]] = weight
            else:
                self.between[row[target], row[source]] = weight
        self.bias = np.array([layout.property_of(node, "bias") for node in self.neurons])
        self.time_constant = np.array([layout.property_of(node, "time_constant") for node in self.neurons])
        self.state = np.zeros(len(row))

    def tick(self, readings):
        """The neurons' values after a tick in which the sensors say this."""
        if self.settings["state"] == "cleared":
            self.state = np.zeros(len(self.neurons))
        given = self.sensed @ np.array(readings)
        for _ in range(self.settings["steps_per_tick"]):
            self.state = self._stepped(given)
        return self._values(self.state)

    def take(self, values):
        """The recorded values in place of its own, where they are the state."""
        if self.settings["equation"] == "rate":
            self.state = np.array(values)

    def _logistic(self, x):
        return 1.0 / (1.0 + np.exp(np.clip(-self.settings["slope"] * x, -700.0, 700.0)))

    def _values(self, y):
        return y if self.settings["equation"] == "rate" else self._logistic(y + self.bias)

    def _aim(self, y, given):
        total = given + self.between @ self._values(y)
        return self._logistic(total - self.bias) if self.settings["equation"] == "rate" else total

    def _stepped(self, given):
        y, rate = self.state, self.settings["step"] / self.time_constant
        way = lambda y: self._aim(y, given) - y
        if self.settings["integrator"] == "rk4":
            a = rate * way(y)
            b = rate * way(y + 0.5 * a)
            c = rate * way(y + 0.5 * b)
            d = rate * way(y + c)
            return y + (a + 2.0 * b + 2.0 * c + d) / 6.0
        return y + (1.0 - np.exp(-rate) if self.settings["integrator"] == "exponential_euler" else rate) * way(y)


class Model:
    """A CTRNN's values and targets, tick by tick. Tolerances are 1e-4 and ten times what the CPPN's rounding to single
    precision makes of them; where neurons keep their state, it goes on from what was recorded."""

    def __init__(self, champion, senses, events):
        self.senses, self.events = senses, events
        self.single, self.double = (Network(champion, dtype) for dtype in (np.float32, np.float64))
        self.names = [node["name"] for node in self.single.neurons]
        self.joints = {node["joint"]: i for i, node in enumerate(self.single.neurons) if node["joint"]}
        self.swapped = champion["controller"]["substrate"].get("attitude") == "misordered_quaternion"
        self.used = [node["sensor"].partition(".")[0] for node, weights in zip(self.single.sensors, self.single.sensed.T) if weights.any()]
        for kind in self.used:
            self.events["neurons sense " + kind] += 1

    def tick(self, frame):
        """Values and tolerances by neuron."""
        readings = [self._read(node["sensor"], frame) for node in self.single.sensors]
        values, others = self.single.tick(readings), self.double.tick(readings)
        return values, 1e-4 + 10.0 * np.abs(values - others)

    def take(self, values):
        self.single.take(values)
        self.double.take(values)

    def _read(self, name, frame):
        reading = self.senses.reading(name, frame)
        if self.swapped and name in ("roll", "yaw"):
            # Each says the other, as the authors' code had it.
            reading = math.atan(math.tan(-self.senses.reading({"roll": "yaw", "yaw": "roll"}[name], frame)))
        return self.senses.scale(name) * reading
