#include "amble/physics/mujoco_model/actuation.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/text.hpp"

namespace amble::physics::mujoco_model {
namespace {

bool is_of_joint(const mjModel& m, int actuator, int joint) {
  const int kind = m.actuator_trntype[actuator];
  return (kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT) && m.actuator_trnid[2 * actuator] == joint;
}

/// An actuator's name, or what it acts on: of the joint, tendon, site or body.
std::string name_or_target(const mjModel& m, int actuator) {
  const char* name = m.names + m.name_actuatoradr[actuator];
  if (*name != '\0') return name;
  const auto [type, what] = [&]() -> std::pair<int, const char*> {
    switch (m.actuator_trntype[actuator]) {
      case mjTRN_JOINT:
      case mjTRN_JOINTINPARENT:
        return {mjOBJ_JOINT, "joint"};
      case mjTRN_TENDON:
        return {mjOBJ_TENDON, "tendon"};
      case mjTRN_BODY:
        return {mjOBJ_BODY, "body"};
      default:
        return {mjOBJ_SITE, "site"};
    }
  }();
  const int target = m.actuator_trnid[2 * actuator];
  const char* of = mj_id2name(&m, type, target);
  return of != nullptr && *of != '\0' ? fmt::format("of {} {}", what, of)
                                      : fmt::format("of {} number {}", what, target + 1);
}

}  // namespace

Actuation::Actuation(const robot::RobotSpec& robot, const Model& model) : robot_(robot), model_(model) {
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const robot::Joint& joint = robot.joints[j];
    Drive drive{.position = model.position_of[j], .dof = model.dof_of[j]};
    drive.start_rad = model.start[to_index(drive.position)];
    if (joint.has_motor()) {
      find_actuator(joint, robot.original->joints[j], drive);
      set_servo(joint.servo, drive);
    } else {
      drive.way = Way::free;
    }
    drives_.push_back(drive);
  }
  reset();
}

void Actuation::find_actuator(const robot::Joint& joint, int model_joint, Drive& drive) const {
  const mjModel& m = *model_.mujoco;
  for (int a = 0; a < m.nu; ++a) {
    if (!is_of_joint(m, a, model_joint)) continue;
    const double gear = m.actuator_gear[6 * a], gain = m.actuator_gainprm[mjNGAIN * a];
    if (m.actuator_gaintype[a] != mjGAIN_FIXED ||
        (m.actuator_biastype[a] != mjBIAS_NONE && m.actuator_biastype[a] != mjBIAS_AFFINE))
      refuse(a, "is no motor with a constant gain");
    if (m.actuator_dyntype[a] != mjDYN_NONE && m.actuator_dyntype[a] != mjDYN_FILTER)
      refuse(a, "integrates its control, or follows a law of its own");
    if (gear == 0.0 || gain == 0.0) refuse(a, "has no gain");
    const mjtNum* const bias = m.actuator_biasprm + mjNBIAS * a;
    const bool affine = m.actuator_biastype[a] == mjBIAS_AFFINE;
    const Way way = affine && bias[1] != 0.0   ? Way::position
                    : affine && bias[2] != 0.0 ? Way::speed
                                               : Way::motor;
    if (way == Way::position && bias[1] * gain > 0.0) refuse(a, "pushes its joint away from the control");
    ++drive.others;
    // A servo before a damper, a damper before a motor.
    if (drive.actuator >= 0 && drive.way <= way) continue;
    drive.way = way;
    drive.actuator = a;
    drive.gear = gear;
    drive.gain = gain;
    drive.bias = affine ? bias[0] : 0.0;
    drive.slope = affine ? bias[1] : 0.0;
  }
  drive.others = std::max(0, drive.others - 1);
  const robot::Servo& servo = joint.servo;
  if (drive.way == Way::speed && servo.mode == robot::ServoMode::torque && servo.kd_nm_s_per_rad <= 0.0)
    refuse(drive.actuator,
           fmt::format("takes a speed, and the servo of joint '{}' has none: give it mode = \"velocity\"",
                       joint.name));
}

void Actuation::refuse(int actuator, const std::string& why) const {
  const mjModel& m = *model_.mujoco;
  const std::string_view name = m.names + m.name_actuatoradr[actuator];
  const std::string_view joint = m.names + m.name_jntadr[m.actuator_trnid[2 * actuator]];
  fail(ExitCode::bad_input, "the engine mujoco-model: robot '{}': actuator {}of joint '{}' {}",
       io::printable(robot_.name), name.empty() ? "" : fmt::format("'{}' ", name), joint, why);
}

void Actuation::set_servo(const robot::Servo& servo, Drive& drive) const {
  const bool velocity = servo.mode == robot::ServoMode::velocity;
  drive.kp = servo.kp_nm_per_rad;
  drive.kd = servo.kd_nm_s_per_rad;
  drive.speed_per_rad = velocity ? servo.gain_per_s : drive.kd > 0.0 ? drive.kp / drive.kd : 0.0;
  if (servo.hold_torque) return;
  const double h = model_->opt.timestep, a = model_->dof_invweight0[drive.dof];
  const double most_kd = 1.0 / (2.0 * h * a), most_kp = most_kd / (2.0 * h);
  drive.torque_per_speed = velocity ? most_kd : 0.0;
  drive.weaker =
      (drive.way == Way::motor || drive.way == Way::applied) && (drive.kd > most_kd || drive.kp > most_kp);
  drive.kd = std::min(drive.kd, most_kd);
  drive.kp = std::min(drive.kp, most_kp);
}

void Actuation::reset() {
  sums_nm_.assign(drives_.size(), 0.0);
}

double Actuation::servo_torque_nm(std::size_t joint, double error_rad, double speed_rad_s) {
  constexpr double share_of_sum = 0.2;
  const Drive& drive = drives_[joint];
  const double most_nm = robot_.joints[joint].servo.max_torque_nm;
  if (drive.torque_per_speed == 0.0)
    return std::clamp(drive.kp * error_rad - drive.kd * speed_rad_s, -most_nm, most_nm);
  const double torque_nm = drive.torque_per_speed * (drive.speed_per_rad * error_rad - speed_rad_s);
  double& sum_nm = sums_nm_[joint];
  sum_nm = std::clamp(sum_nm + share_of_sum * torque_nm, -most_nm, most_nm);
  return std::clamp(torque_nm + sum_nm, -most_nm, most_nm);
}

void Actuation::drive(const LaneArray& targets_rad, bool first, mjData& data) {
  for (std::size_t j = 0; j < drives_.size(); ++j) {
    const Drive& drive = drives_[j];
    if (drive.way == Way::free) continue;
    const robot::Joint& joint = robot_.joints[j];
    double target_rad = static_cast<double>(targets_rad.at(static_cast<int>(j), 0));
    if (!joint.servo.hold_torque) target_rad = std::clamp(target_rad, joint.lower_rad, joint.upper_rad);
    target_rad += drive.start_rad;
    if (drive.way == Way::position) {
      // Where gain × control + bias + slope × length is 0. In a position actuator the slope is −gain.
      const double length = drive.gear * target_rad;
      const bool plain = drive.slope == -drive.gain && drive.bias == 0.0;
      data.ctrl[drive.actuator] = plain ? length : -(drive.bias + drive.slope * length) / drive.gain;
      continue;
    }
    const double error_rad = target_rad - data.qpos[drive.position];
    if (drive.way == Way::speed) {
      data.ctrl[drive.actuator] = drive.gear * drive.speed_per_rad * error_rad;
      continue;
    }
    if (!first && joint.servo.hold_torque) continue;
    const double torque_nm = servo_torque_nm(j, error_rad, data.qvel[drive.dof]);
    if (drive.way == Way::motor)
      data.ctrl[drive.actuator] = torque_nm / (drive.gear * drive.gain);
    else
      data.qfrc_applied[drive.dof] = torque_nm;
  }
}

double Actuation::torque_nm(std::size_t joint, const mjData& data) const {
  const Drive& drive = drives_[joint];
  return data.qfrc_actuator[drive.dof] + (drive.way == Way::applied ? data.qfrc_applied[drive.dof] : 0.0);
}

std::vector<std::string> Actuation::notes() const {
  const mjModel& m = *model_.mujoco;
  std::array<std::vector<std::string>, 5> by_way;
  std::vector<std::string> weaker, idle, several;
  std::vector<bool> used(to_index(m.nu));
  for (std::size_t j = 0; j < drives_.size(); ++j) {
    by_way[to_index(drives_[j].way)].push_back(robot_.joints[j].name);
    if (drives_[j].weaker) weaker.push_back(robot_.joints[j].name);
    if (drives_[j].others > 0) several.push_back(robot_.joints[j].name);
    for (int a = 0; a < m.nu; ++a)
      if (is_of_joint(m, a, robot_.original->joints[j])) used[to_index(a)] = true;
  }
  for (int a = 0; a < m.nu; ++a)
    if (!used[to_index(a)]) idle.push_back(fmt::format("{} ({})", a, name_or_target(m, a)));
  std::vector<std::string> notes;
  constexpr std::array<std::string_view, 5> words{
      "targets go to position actuators, with the model's gains: ",
      "velocity actuators, which follow the speed of the robot file's servos: ",
      "motors, driven by the robot file's servos: ",
      "joints without an actuator, driven by the robot file's servos: ",
      "joints without a motor, left to the model: "};
  for (std::size_t way = 0; way < words.size(); ++way)
    if (!by_way[way].empty())
      notes.push_back(fmt::format("{}{}", words[way],
                                  by_way[way].size() == drives_.size()
                                      ? "all joints"
                                      : fmt::format("{}", fmt::join(by_way[way], ", "))));
  if (!several.empty())
    notes.push_back(
        fmt::format("of several actuators of a joint one has the target, the others control 0: {}",
                    fmt::join(several, ", ")));
  if (!weaker.empty())
    notes.push_back(fmt::format("servos as stiff as steps of {:g} s allow, less than in the robot file: {}",
                                m.opt.timestep, fmt::join(weaker, ", ")));
  if (!idle.empty())
    notes.push_back(
        fmt::format("actuators of no joint of the robot have control 0: {}", fmt::join(idle, ", ")));
  return notes;
}

}  // namespace amble::physics::mujoco_model
