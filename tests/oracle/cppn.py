"""CPPNs as docs/SETTINGS.md, docs/AMBIGUITIES.md and src/cppn's headers describe them, for many points at once."""

import numpy as np


def _activated(function, linear, x):
    x = x.astype(np.float64)
    if function == "bipolar_sigmoid":
        return 2.0 / (1.0 + np.exp(np.clip(-x, None, 700.0))) - 1.0
    if function == "gaussian":
        return 2.0 * np.exp(-((2.5 * x) ** 2)) - 1.0
    if function == "sine":
        return np.sin(2.0 * x)
    if function == "linear":
        return np.clip(np.abs(x) if linear == "absolute" else x, -(2.0**64), 2.0**64)
    raise ValueError(function)


class Cppn:
    def __init__(self, genome, settings):
        self.settings = settings
        self.nodes = {node["id"]: node for node in genome["nodes"]}
        self.links = sorted((link for link in genome["links"] if link["enabled"]), key=lambda link: link["innovation"])
        self.input_ids = [n["id"] for n in genome["nodes"] if n["kind"] == "input"]
        self.output_ids = [n["id"] for n in genome["nodes"] if n["kind"] == "output"]
        self.hidden_count = sum(n["kind"] == "hidden" for n in genome["nodes"])
        self.bias_id = next(n["id"] for n in genome["nodes"] if n["kind"] == "bias")

    def passes(self):
        """Synchronous passes; a CPPN without cycles is done once every node had its turn."""
        if not self.settings["recurrent"]:
            return len(self.nodes)
        # A file without the key comes from a program that knew no other number.
        return 2 * self.hidden_count + {"2h+1": 1, "2h+3": 3}[self.settings["passes"]]

    def has_cycle(self):
        targets = {node: [link["to"] for link in self.links if link["from"] == node] for node in self.nodes}
        reached = {node: set(next_nodes) for node, next_nodes in targets.items()}
        for _ in self.nodes:
            for node in self.nodes:
                reached[node] = reached[node].union(*(reached[other] for other in reached[node]))
        return any(node in reached[node] for node in self.nodes)

    def evaluate(self, points, dtype):
        """Outputs at points × inputs, as points × outputs. In float32 each product and sum is rounded, in the order of
        innovations, as in amble; in float64 hardly anything is."""
        points = np.asarray(points, np.float64).astype(dtype)
        values = {node: np.zeros(len(points), dtype) for node in self.nodes}
        values[self.bias_id] = np.ones(len(points), dtype)
        for column, node in enumerate(self.input_ids):
            values[node] = points[:, column]
        computed = [n for n in self.nodes.values() if n["kind"] in ("hidden", "output")]
        for _ in range(self.passes()):
            sums = {node["id"]: np.zeros(len(points), dtype) for node in computed}
            for link in self.links:
                sums[link["to"]] = sums[link["to"]] + dtype(link["weight"]) * values[link["from"]]
            for node in computed:
                values[node["id"]] = _activated(node["activation"], self.settings["linear"], sums[node["id"]]).astype(dtype)
        return np.stack([values[node] for node in self.output_ids], axis=1).astype(np.float64)
