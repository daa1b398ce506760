#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "amble/controllers/lane_rows.hpp"
#include "amble/io/settings.hpp"
#include "amble/substrate/layout.hpp"

namespace amble::controllers {

/// How the targets of a SUPG pass from one cycle to the next. By default they jump, as in the paper: at the
/// end of a period from the pattern's end to its beginning, and at a trigger from wherever it was. All
/// settings can be combined; SeamSmoother says what the last three do.
struct SeamSettings {
  substrate::TimeInputs time = substrate::TimeInputs::line;
  bool detrend = false;
  double residual_s = 0.0;
  double filter_s = 0.0;
  int filter_order = 2;

  bool smooths() const { return residual_s > 0.0 || filter_s > 0.0; }
  void describe(io::SettingsVisitor& visitor);
  friend bool operator==(const SeamSettings&, const SeamSettings&) = default;
};

/// The factors of a tick, 0 … 1.
struct SeamFactors {
  SeamFactors(const SeamSettings& settings, double timestep_s);

  float residual_decay = 0.0f;  ///< e^(−timestep/residual_s); 0: no residual
  float filter_share = 0.0f;    ///< 1 − e^(−timestep/filter_s)
  int filter_order = 0;         ///< 0: no filter
};

/// Smooths the targets of a batch, joint by joint, over the lanes. In a tick, c is the pattern where it would
/// be without a jump, and p where it is (the same unless it jumped):
///   y = c + decay × r, limited to the joint's range
///   r ← y − p where it jumped, else decay × r
/// So a jump is taken up by the residual r and fades with the time constant residual_s: from tick to tick y
/// moves by at most the largest step of the pattern, plus |r| timestep / residual_s. Then, in each of
/// filter_order equal stages one after the other, z ← z + share (y − z), y ← z: a low-pass filter, critically
/// damped with two stages. It delays everything, by filter_order × filter_s, jumps or not.
///
/// Single precision, each operation rounded; r and z are 0 within ± 1e−9 rad. The same bits on every CPU and
/// for every number of lanes.
class SeamSmoother {
 public:
  SeamSmoother(const SeamSettings& settings, double timestep_s, int joints, int lanes);

  /// A pattern that begins at `target_rad`, at rest.
  void load(int joint, int lane, float target_rad);

  /// All `lanes` numbers. `jumped`: all bits of those that did, else 0. The rows must not overlap, but the
  /// first two may be one.
  void smooth(int joint, const float* continued_rad, const float* present_rad, const std::int32_t* jumped,
              float lower_rad, float upper_rad, float* targets_rad);

 private:
  SeamFactors factors_;
  int joints_, lanes_;
  LaneRows residual_rad_;
  LaneRows stage_rad_;  ///< stage by stage, joint by joint
};

}  // namespace amble::controllers
