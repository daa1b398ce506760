#include "amble/controllers/switching.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "amble/controllers/supg_batch.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {
namespace {

constexpr int standing_gait = -1;

class SwitchingBatch final : public SupgBatch {
 public:
  /// What is pointed to must live as long as the batch.
  struct Gaits {
    std::vector<const SupgParameters*> all;
    const SupgParameters* standing = nullptr;
    const SupgParameters& of(int gait) const {
      return gait == standing_gait ? *standing : *all[to_index(gait)];
    }
  };

  SwitchingBatch(SupgBatch supgs, Gaits gaits, const SwitchingSettings& settings, int legs)
      : SupgBatch(std::move(supgs)),
        gaits_(std::move(gaits)),
        choice_(settings),
        heading_gain_(static_cast<float>(settings.heading_gain)),
        legs_(legs),
        wanted_(to_index(SupgBatch::lanes())),
        is_new_(to_index(SupgBatch::lanes()), true),
        gait_(to_index(legs * SupgBatch::lanes())) {}

  void load(int lane, const Parameters& parameters) override {
    SupgBatch::load(lane, parameters);
    is_new_[to_index(lane)] = true;
    for (int leg = 0; leg < legs_; ++leg) gait(leg, lane) = 0;
  }

  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override {
    AMBLE_CHECK(sensors.command.rows() == 2 && sensors.command.lanes() == lanes(), "commands are sensed");
    for (int lane = 0; lane < lanes(); ++lane) {
      wanted_[to_index(lane)] = wanted(sensors, lane);
      if (!is_new_[to_index(lane)]) continue;
      is_new_[to_index(lane)] = false;
      for (int leg = 0; leg < legs_; ++leg) {
        gait(leg, lane) = wanted_[to_index(lane)];
        begin(leg, lane, gaits_.of(gait(leg, lane)));
        smooth_from_start(leg, lane, gaits_.of(gait(leg, lane)));
      }
    }
    SupgBatch::step(sensors, targets_rad);
  }

  std::vector<std::string> state_names() const override {
    std::vector<std::string> names = SupgBatch::state_names();
    for (const std::string& leg : leg_names()) names.push_back("gait." + leg);
    return names;
  }
  /// Gaits by number from 1 on; 0: standing.
  void state(int lane, std::span<float> values) const override {
    const std::size_t own = values.size() - to_index(legs_);
    SupgBatch::state(lane, values.first(own));
    for (int leg = 0; leg < legs_; ++leg)
      values[own + to_index(leg)] = static_cast<float>(gait_[to_index(leg * lanes() + lane)] + 1);
  }

 private:
  int& gait(int leg, int lane) { return gait_[to_index(leg * lanes() + lane)]; }

  int wanted(const robot::SensorFrame& sensors, int lane) const {
    if (sensors.command_stop.at(0, lane) > 0.5f) return standing_gait;
    float turn_rad_s = sensors.command.at(1, lane);
    if (heading_gain_ > 0.0f) turn_rad_s += heading_gain_ * sensors.heading_error_rad.at(0, lane);
    return choice_.nearest(sensors.command.at(0, lane), turn_rad_s);
  }

  void timers_are_set(int leg) override {
    for (int lane = 0; lane < lanes(); ++lane) {
      const int wanted = wanted_[to_index(lane)];
      if (gait(leg, lane) == wanted) continue;
      if (gait(leg, lane) == standing_gait)
        begin(leg, lane, gaits_.of(wanted));
      else if (triggered(leg, lane) || at_end(leg, lane))
        play(leg, lane, gaits_.of(wanted));
      else
        continue;
      gait(leg, lane) = wanted;
    }
  }

  Gaits gaits_;
  GaitChoice choice_;
  float heading_gain_;
  int legs_;
  std::vector<int> wanted_;   ///< by lane
  std::vector<bool> is_new_;  ///< by lane: before its first tick
  std::vector<int> gait_;     ///< leg by leg, over the lanes
};

/// A controller in which all joints keep their start pose.
SupgParameters standing(const SupgArchitecture& walker, const robot::RobotSpec& robot) {
  SupgParameters parameters = walker.blank();
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
    for (std::size_t type = 0; type < robot.legs[leg].joints.size(); ++type) {
      const int joint = robot.legs[leg].joints[type];
      if (joint < 0) continue;
      for (int timer = SupgParameters::stopped; timer <= walker.period_ticks(); ++timer)
        parameters.targets_rad(static_cast<int>(leg), timer)[type] =
            held_target_rad(robot.joints[to_index(joint)]);
    }
  return parameters;
}

/// Values in parts of the range that they span, and what makes others such; 0 where it is a point.
float in_parts(std::vector<float>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  const float by = most > least ? 1.0f / (most - least) : 0.0f;
  for (float& value : values) value *= by;
  return by;
}

}  // namespace

GaitChoice::GaitChoice(const SwitchingSettings& settings) {
  AMBLE_CHECK(settings.any(), "there are gaits to choose from");
  for (const GaitSettings& gait : settings.gaits) {
    speeds_.push_back(static_cast<float>(gait.speed_m_s));
    turns_.push_back(static_cast<float>(gait.turn_rad_s));
  }
  by_speed_ = in_parts(speeds_);
  by_turn_ = in_parts(turns_);
}

int GaitChoice::nearest(float speed_m_s, float turn_rad_s) const {
  const float speed = speed_m_s * by_speed_, turn = turn_rad_s * by_turn_;
  int best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t gait = 0; gait < speeds_.size(); ++gait) {
    const float by = speeds_[gait] - speed, round = turns_[gait] - turn;
    const float distance = by * by + round * round;
    if (distance >= least) continue;
    least = distance;
    best = static_cast<int>(gait);
  }
  return best;
}

SwitchingArchitecture::SwitchingArchitecture(std::unique_ptr<const SupgArchitecture> walker,
                                             const SwitchingSettings& settings,
                                             std::vector<std::unique_ptr<Parameters>> gaits,
                                             const robot::RobotSpec& robot)
    : walker_(std::move(walker)),
      settings_(settings),
      gaits_(std::move(gaits)),
      standing_(standing(*walker_, robot)) {
  AMBLE_CHECK(settings_.gaits.size() == gaits_.size(), "each gait is decoded");
  if (walker_->modulated())
    fail_setting(
        {"controller.switching", "controller.supg.modulation.sensors"},
        "controller.switching: the SUPGs are modulated by sensors; expected SUPGs without modulation");
}

std::unique_ptr<Batch> SwitchingArchitecture::make_batch(int lanes) const {
  SwitchingBatch::Gaits gaits{.all = {}, .standing = &standing_};
  for (const auto& gait : gaits_) gaits.all.push_back(dynamic_cast<const SupgParameters*>(gait.get()));
  return std::make_unique<SwitchingBatch>(walker_->make_plain_batch(lanes), std::move(gaits), settings_,
                                          standing_.legs());
}

std::string SwitchingArchitecture::parameters_json(const Parameters& parameters) const {
  auto json = nlohmann::ordered_json::parse(walker_->parameters_json(parameters));
  json["gaits"] = gaits_.size();
  return json.dump();
}

robot::ExtraSenses SwitchingArchitecture::extra_senses() const {
  robot::ExtraSenses senses = walker_->extra_senses();
  senses.command = true;
  senses.heading_error |= settings_.heading_gain > 0.0;
  return senses;
}

bool SwitchingArchitecture::reads(const substrate::Sensor& sensor) const {
  using Kind = substrate::Sensor::Kind;
  return sensor.kind == Kind::command_stop || sensor.kind == Kind::command_speed ||
         sensor.kind == Kind::command_turn ||
         (sensor.kind == Kind::heading_error && settings_.heading_gain > 0.0) || walker_->reads(sensor);
}

}  // namespace amble::controllers
