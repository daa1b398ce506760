#include "amble/neat/threshold.hpp"

#include <algorithm>
#include <cmath>

namespace amble::neat {

bool Threshold::steer(int species, const SpeciationSettings& settings) {
  if (species >= settings.target_min && species <= settings.target_max) {
    step_ = 0.0;
    return false;
  }
  const bool down = species < settings.target_min;
  const double direction = down ? -1.0 : 1.0;
  if (step_ == 0.0)
    step_ = direction * std::max(0.1, (down ? settings.first_step_down : settings.first_step_up) * value_);
  else
    step_ *= step_ * direction > 0.0 ? 1.05 : -0.5;

  const double old_value = value_;
  value_ = std::max(lowest, value_ + step_);
  if (value_ == lowest) step_ = 0.0;
  return value_ != old_value;
}

void Threshold::save(io::BinaryWriter& writer) const {
  writer.put(value_);
  writer.put(step_);
}

void Threshold::load(io::BinaryReader& reader) {
  value_ = reader.get<double>();
  step_ = reader.get<double>();
  if (!std::isfinite(value_) || value_ < lowest || !std::isfinite(step_))
    reader.bad("a compatibility threshold that cannot be");
}

}  // namespace amble::neat
