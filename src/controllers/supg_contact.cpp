#include "amble/controllers/supg_contact.hpp"

#include <algorithm>
#include <cmath>

#include "amble/controllers/joint_type.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {

namespace {

/// Refuses thresholds that every tick or none exceeds.
void check_threshold(const ContactSettings& settings, const robot::RobotSpec& robot,
                     const std::vector<std::vector<int>>& joints) {
  const std::string key = "controller.supg.contact.threshold";
  if (settings.source == ContactSource::touch) return;
  if (settings.threshold <= 0.0)
    fail_setting({key}, "{} = 0: every tick would be a contact; expected more", key);
  if (settings.source != ContactSource::torque) return;
  for (const auto& leg : joints) {
    double most_nm = 0.0;
    for (const int joint : leg)
      most_nm = std::max(most_nm, robot.joints[to_index(joint)].servo.max_torque_nm);
    if (settings.threshold >= most_nm)
      fail_setting({key, "controller.supg.contact.joint_type"},
                   "{} = {} N m: no motor of a leg gives more than {:.3g}; expected less", key,
                   settings.threshold, most_nm);
  }
}

}  // namespace

bool tells_contact(ContactSource source, substrate::Sensor::Kind kind) {
  using Kind = substrate::Sensor::Kind;
  switch (source) {
    case ContactSource::touch:
      return kind == Kind::touch;
    case ContactSource::torque:
      return kind == Kind::torque;
    case ContactSource::tracking:
      return kind == Kind::angle;
    case ContactSource::shock:
      return kind == Kind::roll || kind == Kind::pitch;
  }
  return false;
}

std::vector<std::vector<int>> contact_joints(const ContactSettings& settings, const robot::RobotSpec& robot) {
  std::vector<std::vector<int>> joints(robot.legs.size());
  const std::string key = "controller.supg.contact.joint_type";
  if (!settings.joint_type.empty()) joint_type_index(robot, settings.joint_type, key, settings.joint_type);
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    const auto& all = robot.legs[leg].joints;
    for (std::size_t t = 0; t < all.size(); ++t) {
      const bool wanted = settings.joint_type.empty() || robot.joint_types[t] == settings.joint_type;
      if (wanted && all[t] >= 0 && robot.joints[to_index(all[t])].driven()) joints[leg].push_back(all[t]);
    }
    if (joints[leg].empty() && settings.source != ContactSource::touch &&
        settings.source != ContactSource::shock)
      fail_setting({key}, "{} = \"{}\": leg {} drives no such joint", key, settings.joint_type,
                   robot.legs[leg].name);
  }
  check_threshold(settings, robot, joints);
  return joints;
}

ContactEstimate::ContactEstimate(const ContactSettings& settings, std::vector<std::vector<int>> joints,
                                 double timestep_s, int lanes)
    : settings_(settings),
      joints_(std::move(joints)),
      lanes_(lanes),
      begins_(static_cast<float>(settings.threshold)),
      ends_(static_cast<float>(settings.release * settings.threshold)),
      per_tick_squared_(static_cast<float>(1.0 / (timestep_s * timestep_s))),
      contact_(legs(), lanes),
      number_(1, lanes),
      tick_(to_index(lanes)),
      angles_(2, lanes),
      changes_(2, lanes),
      since_(to_index(legs() * lanes)) {}

void ContactEstimate::load(int lane) {
  tick_[to_index(lane)] = 0;
  for (int leg = 0; leg < legs(); ++leg) {
    contact_.at(leg, lane) = 0.0f;
    since_[to_index(leg * lanes_ + lane)] = 0;
  }
}

void ContactEstimate::update(const robot::SensorFrame& sensors) {
  if (settings_.source == ContactSource::shock)
    update_shock(sensors);
  else
    for (int leg = 0; leg < legs(); ++leg) update_leg(leg, sensors);
  for (int& tick : tick_) ++tick;
}

void ContactEstimate::targets(const LaneArray& targets_rad) {
  if (settings_.source == ContactSource::tracking) targets_rad_ = targets_rad;
}

void ContactEstimate::update_leg(int leg, const robot::SensorFrame& sensors) {
  const bool torque = settings_.source == ContactSource::torque;
  AMBLE_CHECK(!torque || sensors.joint_torque_nm.rows() > 0, "torques are sensed");
  float* const number = number_.row(0);
  std::fill_n(number, lanes_, 0.0f);
  // Before the first target nothing is behind it.
  if (torque || targets_rad_.rows() > 0)
    for (const int joint : joints_[to_index(leg)])
      for (int lane = 0; lane < lanes_; ++lane) {
        const float x = torque ? sensors.joint_torque_nm.at(joint, lane)
                               : targets_rad_.at(joint, lane) - sensors.joint_angle_rad.at(joint, lane);
        number[lane] = std::max(number[lane], std::fabs(x));
      }
  float* const contact = contact_.row(leg);
  for (int lane = 0; lane < lanes_; ++lane) {
    const bool known = torque || tick_[to_index(lane)] > 0;
    const float limit = contact[lane] > 0.5f ? ends_ : begins_;
    contact[lane] = known && number[lane] > limit ? 1.0f : 0.0f;
  }
}

void ContactEstimate::update_shock(const robot::SensorFrame& sensors) {
  for (int lane = 0; lane < lanes_; ++lane) {
    const int tick = tick_[to_index(lane)];
    float number = 0.0f;
    for (int axis = 0; axis < 2; ++axis) {
      const float angle = sensors.attitude_rad.at(axis, lane), change = angle - angles_.at(axis, lane);
      number += std::fabs(change - changes_.at(axis, lane));
      angles_.at(axis, lane) = angle;
      changes_.at(axis, lane) = change;
    }
    const auto since = [&](int leg) -> int& { return since_[to_index(leg * lanes_ + lane)]; };
    int longest = 0;
    for (int leg = 0; leg < legs(); ++leg) {
      ++since(leg);
      contact_.at(leg, lane) = 0.0f;
      if (since(leg) > since(longest)) longest = leg;
    }
    if (tick < 2 || legs() == 0 || !(number * per_tick_squared_ > begins_)) continue;
    contact_.at(longest, lane) = 1.0f;
    since(longest) = 0;
  }
}

}  // namespace amble::controllers
