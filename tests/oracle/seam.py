"""How targets pass from one cycle to the next, as src/controllers/supg_seam.hpp's header describes it, in double precision."""

import math


class Seam:
    """The targets of one joint. `tolerance_rad` is what an entry of its pattern may be wrong by."""

    def __init__(self, settings, timestep_s, lower_rad, upper_rad, tolerance_rad):
        self.lower_rad, self.upper_rad, self.entry_tolerance_rad = lower_rad, upper_rad, tolerance_rad
        residual_s, filter_s = settings["residual_s"], settings["filter_s"]
        self.decay = math.exp(-timestep_s / residual_s) if residual_s > 0.0 else None
        self.share = 1.0 - math.exp(-timestep_s / filter_s) if filter_s > 0.0 else None
        self.smooths = self.decay is not None or self.share is not None
        self.order = settings["filter_order"]
        self.residual_rad = self.residual_tolerance_rad = 0.0
        self.stages_rad = None

    def next(self, continued_rad, present_rad, jumped):
        """Target and tolerance, rad. The filter starts at rest at what it is first given."""
        y, tolerance = present_rad, self.entry_tolerance_rad
        if self.decay is not None:
            left, left_tolerance = self.decay * self.residual_rad, self.decay * self.residual_tolerance_rad + 1e-7
            y, tolerance = self._limited(continued_rad + left), self.entry_tolerance_rad + left_tolerance
            self.residual_rad = y - present_rad if jumped else left
            self.residual_tolerance_rad = tolerance + self.entry_tolerance_rad if jumped else left_tolerance
        if self.share is None:
            return y, tolerance
        if self.stages_rad is None:
            self.stages_rad, self.filter_tolerance_rad = [present_rad] * self.order, tolerance
        for stage, z in enumerate(self.stages_rad):
            y = self.stages_rad[stage] = z + self.share * (y - z)
        # A mean of what it was given; what it was given before may have been less certain.
        self.filter_tolerance_rad = max(tolerance, self.filter_tolerance_rad)
        return self._limited(y), self.filter_tolerance_rad + 1e-6

    def _limited(self, target_rad):
        return min(max(target_rad, self.lower_rad), self.upper_rad)
