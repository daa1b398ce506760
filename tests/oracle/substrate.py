"""What a CPPN says of a substrate's links and nodes, as src/substrate/layout.hpp's header and docs/SETTINGS.md describe it."""

import math

import numpy as np


class Layout:
    """`more_inputs`: of the CPPN behind the coordinates, 0 for links and properties (time, where nodes have patterns)."""

    def __init__(self, substrate, cppn, more_inputs, dtype=np.float32):
        self.substrate, self.cppn, self.more, self.dtype = substrate, cppn, [0.0] * more_inputs, dtype
        self.nodes = substrate["nodes"]

    def links(self):
        """(source, target, port, weight) of those that are expressed. What leads to a sensor says nothing."""
        pairs = list(self._pairs())
        outputs = self.cppn.evaluate(np.array([self._inputs(s, t) for s, t, _ in pairs]), self.dtype)
        threshold, weight_range = self.substrate["expression_threshold"], self.substrate["weight_range"]
        found = []
        for (source, target, item), row in zip(pairs, outputs):
            o = min(max(float(row[self.substrate["outputs"].index(item["weight"])]), -1.0), 1.0)
            excess = (abs(o) - threshold) / (1.0 - threshold)
            times = item.get("times", "")
            factor = target["at"][self._coordinate(times)] if times else 1.0
            weight = factor * math.copysign(excess * weight_range, o) if excess > 0.0 else 0.0
            if weight != 0.0 and not target["sensor"]:
                found.append((source["name"], target["name"], item.get("port", "hidden"), weight))
        return found

    def property_of(self, node, name):
        settings = next(p for p in self.substrate["properties"] if p["property"] == name and p["of"] in (node["name"], node["group"]))
        if not settings["output"]:
            return settings["value"]
        point = np.array([self._inputs(node, None)])
        o = float(self.cppn.evaluate(point, self.dtype)[0, self.substrate["outputs"].index(settings["output"])])
        return 0.5 * (settings["low"] + settings["high"]) + 0.5 * (settings["high"] - settings["low"]) * min(max(o, -1.0), 1.0)

    def _pairs(self):
        for item in self.substrate["links"]:
            same = [self._coordinate(name) for name in item.get("same", [])]
            for source in self._group(item["from"]):
                for target in self._group(item["to"]):
                    itself = item["from"] == item["to"] == source["name"]
                    agree = all(source["at"][c] == target["at"][c] for c in same)
                    if agree and (source is not target or itself):
                        yield source, target, item
                        if item.get("both_ways"):
                            yield target, source, item

    def _coordinate(self, name):
        return self.substrate["coordinates"].index(name)

    def _group(self, name):
        return [node for node in self.nodes if name in (node["name"], node["group"])]

    def _inputs(self, source, target):
        return [*source["at"], *(target["at"] if target else [0.0] * len(source["at"])), *self.more]
