#pragma once

#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/controller.hpp"
#include "amble/controllers/kind_settings.hpp"
#include "amble/controllers/supg.hpp"

namespace amble::controllers {

/// Which gait does best what is commanded: that whose (speed, turn) is nearest, each in parts of the range
/// that the gaits span; of equally near ones the first. A part that they all have in common does not count.
class GaitChoice {
 public:
  explicit GaitChoice(const SwitchingSettings& settings);
  int nearest(float speed_m_s, float turn_rad_s) const;

 private:
  std::vector<float> speeds_, turns_;  ///< in parts of their ranges
  float by_speed_ = 0.0f, by_turn_ = 0.0f;
};

/// SUPGs of which each leg plays one of several gaits, the commanded one (Morse et al. 2013 name control of
/// direction as future work). With v and w what is commanded (m/s, rad/s to the left) and e the heading error
/// (rad), the gait that is wanted is that of GaitChoice for v and w + heading_gain e; while a stop is
/// commanded it is standing, in which all joints keep their start pose.
///
/// A leg takes the wanted gait at its trigger, at the end of its cycle, and while its timer is stopped; its
/// timer and all else go on as they are. From standing a leg begins as at the start of a trial, by the
/// offset of the new gait, after one tick with the targets of a timer that is stopped. What is wanted in the
/// first tick is what legs begin with. With one gait, and without stops, it is to the bit the walker of that
/// gait's genome alone.
///
/// The CPPN of a champion's own genome is not asked: each gait has one. Programs that write such champions
/// let the own genome be that of the first gait.
class SwitchingArchitecture : public Architecture {
 public:
  /// `gaits`: those of the settings, in order, decoded by `walker`. Throws SettingError if the walker
  /// modulates its SUPGs.
  SwitchingArchitecture(std::unique_ptr<const SupgArchitecture> walker, const SwitchingSettings& settings,
                        std::vector<std::unique_ptr<Parameters>> gaits, const robot::RobotSpec& robot);

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
  /// What the own genome gives, and how many `gaits` there are.
  std::string parameters_json(const Parameters& parameters) const override;

 private:
  std::unique_ptr<const SupgArchitecture> walker_;
  SwitchingSettings settings_;
  std::vector<std::unique_ptr<Parameters>> gaits_;  ///< each a SupgParameters
  SupgParameters standing_;
};

}  // namespace amble::controllers
