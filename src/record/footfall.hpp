#pragma once

namespace amble::record {

/// Whether a foot that touches in a frame has just come down: it touched last in frame `last_touch`, and was
/// off the ground in at least `least_off` frames between, and in at least one.
///
/// The one rule of what a trial measures, of what figures mark (least_off = 1: every touch after a frame
/// without), and of what triggers a SUPG (controllers/supg.hpp, with ticks for frames). Gaits are classified
/// by stances instead, which gait/meter.hpp makes. docs/GAIT.md compares them.
constexpr bool has_come_down(int frame, int last_touch, double least_off) {
  const int off = frame - last_touch - 1;
  return off >= 1 && off >= least_off;
}

/// The time off the ground that make a footfall of a trial's measures, s: shorter gaps are chatter.
inline constexpr double footfall_off_s = 0.05;

}  // namespace amble::record
