#pragma once

#include "amble/io/binary.hpp"
#include "amble/neat/settings.hpp"

namespace amble::neat {

/// The compatibility threshold, steered so that the number of species comes to the target range
/// (HyperSharpNEAT's rule, in which the authors' code raised the first step up): the first step out of the
/// range is the larger of 0.1 and SpeciationSettings::first_step_down or first_step_up × the threshold; each
/// further step on the same side is 1.05 times the last; after stepping over the range it turns round and is
/// half as long. The threshold stays at or above 0.01.
class Threshold {
 public:
  static constexpr double lowest = 0.01;

  explicit Threshold(double initial) : value_(initial) {}

  double value() const { return value_; }
  /// Takes one step if `species` is out of the range target_min … target_max. Returns whether the value
  /// changed.
  bool steer(int species, const SpeciationSettings& settings);

  void save(io::BinaryWriter& writer) const;
  /// Throws UserError(ExitCode::bad_file).
  void load(io::BinaryReader& reader);

 private:
  double value_;
  double step_ = 0.0;  ///< the last one; 0 while in the range, or at the lowest value
};

}  // namespace amble::neat
