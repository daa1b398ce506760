#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/kind_settings.hpp"

namespace amble::controllers {

/// Which joints swing a leg forward and back, and on which side each leg is.
struct SwingJoints {
  std::vector<std::vector<int>> of_legs;  ///< leg by leg: indices into RobotSpec::joints
  std::vector<int> sides;                 ///< leg by leg: 1 left, −1 right, 0 neither
};

/// Which swing: of each leg the driven joint that moves its foot farthest forward or back per radian in the
/// start pose, the first of those that do so alike; none where no joint moves it at least 1 mm. With
/// `joint_types` the driven joints of these types instead. A leg is left if its hip (robot::hips_m) is left
/// of the mean of all. Throws SettingError for a type that the robot lacks.
SwingJoints swing_joints(const robot::RobotSpec& robot, const std::vector<std::string>& joint_types);

/// Any controller, steered by hand as a tracked vehicle is. With v and w what is commanded (m/s, rad/s to the
/// left), e the heading error (rad), u = w + heading_gain e and each leg's target y about the centre c:
///
///   a = v / full_speed_m_s, within ± 1; 0 while a stop is commanded; 1 where full_speed_m_s is 0
///   s = max(−1, 1 − turn_gain |u|) of legs on the inner side (left for a u > 0), else 1
///   swinging joints  y → c + (y − c) a s      all others  y → c + (y − c) b
///   b = 0 while a stop is commanded and full_speed_m_s > 0, else 1
///
/// limited to the joint's range. A factor (a s of each side, and b) moves by at most
/// timestep / change_s a tick, and begins with what the first tick asks for. Where a factor is 1 the target
/// is to the bit the controller's own. The controller itself goes on: its clocks know nothing of it.
class DifferentialArchitecture : public Architecture {
 public:
  /// Throws SettingError: no legs to be told apart, a gain without effect.
  DifferentialArchitecture(std::unique_ptr<const Architecture> walker, const DifferentialSettings& settings,
                           const robot::RobotSpec& robot, double timestep_s);

  std::string name() const override { return walker_->name(); }
  const std::vector<std::string>& cppn_inputs() const override { return walker_->cppn_inputs(); }
  const std::vector<std::string>& cppn_outputs() const override { return walker_->cppn_outputs(); }
  const substrate::Layout* substrate() const override { return walker_->substrate(); }
  std::unique_ptr<Parameters> decode(const cppn::Network& network) const override {
    return walker_->decode(network);
  }
  std::unique_ptr<Batch> make_batch(int lanes) const override;
  robot::ExtraSenses extra_senses() const override;
  bool reads(const substrate::Sensor& sensor) const override;
  bool scales(const substrate::Sensor& sensor) const override { return walker_->scales(sensor); }
  std::string parameters_json(const Parameters& parameters) const override {
    return walker_->parameters_json(parameters);
  }

  /// What one target is multiplied by.
  enum Factor { left, right, between, others };
  /// A joint that is steered.
  struct Steered {
    int joint = 0;
    Factor factor = others;
    float centre_rad = 0.0f, lower_rad = 0.0f, upper_rad = 0.0f;
  };

  const Architecture& walker() const { return *walker_; }
  const DifferentialSettings& settings() const { return settings_; }
  const std::vector<Steered>& joints() const { return joints_; }
  /// Largest change of a factor in a tick.
  float most_change() const;

 private:
  std::unique_ptr<const Architecture> walker_;
  DifferentialSettings settings_;
  double timestep_s_;
  std::vector<Steered> joints_;
};

}  // namespace amble::controllers
