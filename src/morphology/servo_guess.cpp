#include "amble/morphology/servo_guess.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/number_text.hpp"
#include "amble/robot/leg_doubts.hpp"

namespace amble::morphology {
namespace {

/// The gain of the paper's joint motors (the authors' code).
constexpr double velocity_gain_per_s = 9.0;
/// A motor without a gain of its own holds a leg's share of the weight at this error.
constexpr double bearing_error_rad = 0.1;
/// Ratio of kd to kp where the model tells no damping: a servo comes to its target in about 0.1 s.
constexpr double damping_time_s = 0.05;
constexpr double enough_times = 2.0;
/// A larger effort limit than so many times what bears a leg's share of the weight stands for none.
constexpr double absurd_times = 50.0;
/// How far a target of a controller usually is, at most: as far as commands reach to either side of the
/// start.
constexpr double widest_error_rad = 0.8;

/// Four digits, so that the file reads back to what it says.
double rounded(double value) {
  return std::strtod(fmt::format("{:.4g}", value).c_str(), nullptr);
}

/// What an actuator of the model does to a joint: torque = gain × control − kp × angle − kv × speed.
struct Actuator {
  double gain = 0.0, kp = 0.0, kv = 0.0, gear = 1.0;
  double max_torque_nm = 0.0;  ///< to the weaker side, if it has two; 0: not limited
  std::string uneven;          ///< its range of force, if it is not the same to both sides
  double control_limit = 0.0;  ///< to the weaker side likewise; 0: not limited
  bool control_is_one_sided = false;
  std::string uneven_control;  ///< what its range of control amounts to, if it is not the same to both sides
  bool is_geared = false;      ///< its forces are not its joint's torques
  bool acts_to_one_side = false;  ///< by its range of force
};

Actuator read(const mjModel& model, int a) {
  const double gear = std::abs(model.actuator_gear[6 * a]);
  const mjtNum* bias = model.actuator_biasprm + mjNBIAS * a;
  Actuator actuator;
  actuator.is_geared = gear != 1.0;
  actuator.gear = gear;
  actuator.gain = std::abs(model.actuator_gainprm[mjNGAIN * a]) * gear;
  if (model.actuator_biastype[a] == mjBIAS_AFFINE) {
    actuator.kp = std::max(0.0, -bias[1]) * gear * gear;
    actuator.kv = std::max(0.0, -bias[2]) * gear * gear;
  }
  if (model.actuator_forcelimited[a] != 0) {
    const mjtNum* range = model.actuator_forcerange + 2 * a;
    actuator.max_torque_nm = gear * weaker_side(range[0], range[1]);
    if (range[0] != -range[1]) actuator.uneven = fmt::format("{:.4g} to {:.4g}", range[0], range[1]);
    actuator.acts_to_one_side = range[0] * range[1] >= 0.0;
  }
  if (model.actuator_ctrllimited[a] != 0) {
    const mjtNum* range = model.actuator_ctrlrange + 2 * a;
    actuator.control_limit = weaker_side(range[0], range[1]);
    actuator.control_is_one_sided = range[0] * range[1] >= 0.0;  // oddity() says so
    if (range[0] != -range[1])
      actuator.uneven_control =
          fmt::format("{:.4g} to {:.4g}", range[0] * actuator.gain, range[1] * actuator.gain);
  }
  return actuator;
}

/// Whether its state, and not its control, is what it pulls towards: the control is a speed of that.
bool integrates(const mjModel& model, int a) {
  return model.actuator_dyntype[a] == mjDYN_INTEGRATOR;
}

/// What an actuator does that no motor does; empty: nothing.
std::string oddity(const mjModel& model, int a) {
  const bool one_way = model.actuator_ctrllimited[a] != 0 && model.actuator_biastype[a] == mjBIAS_NONE &&
                       model.actuator_ctrlrange[2 * a] * model.actuator_ctrlrange[2 * a + 1] >= 0.0;
  if (model.actuator_gaintype[a] == mjGAIN_MUSCLE || model.actuator_dyntype[a] == mjDYN_MUSCLE)
    return "a muscle, which only pulls";
  if (model.actuator_gaintype[a] == mjGAIN_AFFINE && model.actuator_gainprm[mjNGAIN * a] == 0.0)
    return "a damper, which only brakes";
  if (integrates(model, a))
    return "integrates its control, which is a speed, and its targets are its actrange";
  if (one_way) return "pushes to one side alone, by its ctrlrange";
  return {};
}

/// The angles, as the model counts them, at which a position actuator comes to rest within its ctrlrange, or,
/// if it integrates, its actrange.
std::optional<std::array<double, 2>> target_range(const mjModel& model, int a) {
  const bool by_state = integrates(model, a);
  const mjtByte* const limited = by_state ? model.actuator_actlimited : model.actuator_ctrllimited;
  const mjtNum* const range = (by_state ? model.actuator_actrange : model.actuator_ctrlrange) + 2 * a;
  if (limited[a] == 0 || model.actuator_gaintype[a] != mjGAIN_FIXED) return std::nullopt;
  const mjtNum* const bias = model.actuator_biasprm + mjNBIAS * a;
  const auto angle_rad = [&](double control) {
    return (model.actuator_gainprm[mjNGAIN * a] * control + bias[0]) /
           (-bias[1] * model.actuator_gear[6 * a]);
  };
  const std::array ends{angle_rad(range[0]), angle_rad(range[1])};
  const auto [lower, upper] = std::ranges::minmax(ends);
  if (!(lower < upper)) return std::nullopt;
  return std::array{lower, upper};
}

class ServoGuesser {
 public:
  ServoGuesser(const ModelFile& file, double bearing_nm) : file_(file), bearing_nm_(bearing_nm) {}

  ServoGuess guess(const std::string& name, int model_joint, double damping) const {
    const mjModel& model = *file_.model;
    MotorHint hint;
    if (const auto found = file_.motors.find(name); found != file_.motors.end()) hint = found->second;
    if (const std::vector<int> actuators = servo_actuators(model, model_joint); !actuators.empty()) {
      Actuator actuator = read(model, actuators.front());
      for (std::size_t k = 1; k < actuators.size(); ++k) actuator.kv += read(model, actuators[k]).kv;
      hint.kv_nm_s_per_rad *= actuator.gear * actuator.gear;
      if (hint.damping_ratio > 0.0)  // of the critical damping, as newer MuJoCos compute it
        hint.kv_nm_s_per_rad =
            2.0 * hint.damping_ratio * std::sqrt(actuator.kp * model.dof_M0[model.jnt_dofadr[model_joint]]);
      ServoGuess guessed = actuator.kp > 0.0   ? of_position(actuator, hint, damping)
                           : actuator.kv > 0.0 ? of_velocity(actuator, hint)
                                               : of_motor(actuator, hint, damping);
      if (guessed.uneven_force.empty()) {
        guessed.uneven_force = actuator.uneven;
        guessed.acts_to_one_side = actuator.acts_to_one_side;
      }
      if (actuator.kp > 0.0) guessed.target_range_rad = target_range(model, actuators.front());
      guessed.oddity = oddity(model, actuators.front());
      return guessed;
    }
    ServoGuess guessed = hint.max_torque_nm > 0.0 ? of_effort(hint) : of_nothing(hint);
    guessed.target_range_rad = hint.soft_limits_rad;
    return guessed;
  }

 private:
  double enough() const { return rounded(enough_times * bearing_nm_); }

  static robot::Servo velocity(double torque_nm) {
    return {robot::ServoMode::velocity, velocity_gain_per_s, rounded(torque_nm), 0.0, 0.0};
  }

  static robot::Servo torque(double torque_nm, double kp, double kd) {
    return {robot::ServoMode::torque, 0.0, rounded(torque_nm), rounded(kp), rounded(kd)};
  }

  bool has_limit(const Actuator& actuator, const MotorHint& hint) const {
    return actuator.max_torque_nm > 0.0 || hint.max_torque_nm > 0.0;
  }

  /// The largest torque, and where it comes from.
  using Limit = std::pair<double, std::string>;

  /// The smallest limit that the model has.
  Limit limit(const Actuator& actuator, const MotorHint& hint, const Limit& by_control = {}) const {
    Limit least{enough(),
                fmt::format("not in the model: {} × what bears a leg's share of the weight", enough_times)};
    bool is_known = false;
    const auto take = [&](double torque_nm, std::string source) {
      if (torque_nm > 0.0 && (!is_known || torque_nm < least.first)) least = {torque_nm, std::move(source)};
      is_known = is_known || torque_nm > 0.0;
    };
    take(actuator.max_torque_nm,
         actuator.uneven.empty()
             ? "the actuator's force range"
             : fmt::format("the weaker side of the actuator's force range, {}", actuator.uneven));
    take(by_control.first, by_control.second);
    take(hint.max_torque_nm, "the joint's actuatorfrcrange");
    return least;
  }

  ServoGuess of_position(const Actuator& actuator, const MotorHint& hint, double damping) const {
    const auto [most, source] = limit(actuator, hint);
    const double kd = std::max(actuator.kv, hint.kv_nm_s_per_rad);
    return {
        .servo = torque(most, actuator.kp, kd),
        .why = fmt::format("kp{} of the model's actuator{}; torque: {}", kd > 0.0 ? " and kd" : "",
                           kd > 0.0 || damping == 0.0 ? "" : ", whose damping is that of the joint", source),
        .torque_is_guessed = !has_limit(actuator, hint),
        .has_no_speed_limit = true,
        .torque_is_geared = actuator.is_geared};
  }

  /// Neither an actuator nor a limit of torque; of a URDF perhaps one of speed.
  ServoGuess of_nothing(const MotorHint& hint) const {
    ServoGuess guessed{velocity(enough()),
                       fmt::format("no motor in the model: {} × the torque that bears a leg's share of the "
                                   "weight; gain: ",
                                   enough_times),
                       true};
    guessed.servo.gain_per_s = gain_within(hint.max_speed_rad_s);
    guessed.why +=
        guessed.servo.gain_per_s < velocity_gain_per_s ? why_slower(hint) : "that of the paper's motors";
    guessed.speed_is_guessed = file_.is_urdf() && hint.max_speed_rad_s == 0.0;
    return guessed;
  }

  static std::string why_slower(const MotorHint& hint) {
    return fmt::format("{} rad from its target a joint turns at the model's velocity limit, {:.4g} rad/s",
                       widest_error_rad, hint.max_speed_rad_s);
  }

  ServoGuess of_effort(const MotorHint& hint) const {
    robot::Servo servo = velocity(hint.max_torque_nm);
    std::string torque_why = "the model's effort limit";
    const bool absurd = hint.max_torque_nm > absurd_times * bearing_nm_;
    if (absurd) {
      servo.max_torque_nm = enough();
      torque_why = fmt::format(
          "the model's effort limit, {:.4g} N m, is no motor's: {} × what bears a leg's "
          "share of the weight",
          hint.max_torque_nm, enough_times);
    }
    std::string gain_why = fmt::format("that of the paper's motors, {} /s", velocity_gain_per_s);
    const bool of_template = absurd && hint.is_of_a_template();
    if (of_template) {
      gain_why += fmt::format(": the velocity limit beside that, {:.4g} rad/s, is a template's too",
                              hint.max_speed_rad_s);
    } else if (gain_within(hint.max_speed_rad_s) < velocity_gain_per_s) {
      servo.gain_per_s = gain_within(hint.max_speed_rad_s);
      gain_why = why_slower(hint);
    }
    ServoGuess guessed{servo, fmt::format("torque: {}; gain: {}", torque_why, gain_why), absurd};
    guessed.speed_is_guessed = file_.is_urdf() && (of_template || hint.max_speed_rad_s == 0.0);
    return guessed;
  }

  ServoGuess of_velocity(const Actuator& actuator, const MotorHint& hint) const {
    auto [most, source] = limit(actuator, hint);
    robot::Servo servo = velocity(most);
    std::string gain_why = "that of the paper's motors";
    // Without a load its joint turns so fast.
    const double speed_rad_s = actuator.control_limit * actuator.gain / actuator.kv;
    if (gain_within(speed_rad_s) < velocity_gain_per_s) {
      servo.gain_per_s = gain_within(speed_rad_s);
      gain_why = fmt::format("{} rad from its target a joint turns at the actuator's ctrlrange, {:.4g} rad/s",
                             widest_error_rad, speed_rad_s);
    }
    return {servo, fmt::format("a velocity actuator; torque: {}; gain: {}", source, gain_why),
            !has_limit(actuator, hint)};
  }

  ServoGuess of_motor(const Actuator& actuator, const MotorHint& hint, double damping) const {
    const Limit by_control{actuator.control_limit * actuator.gain,
                           actuator.uneven_control.empty()
                               ? "the actuator's control range × gear"
                               : fmt::format("the weaker side of the actuator's control range × gear, {}",
                                             actuator.uneven_control)};
    const auto [most, source] = limit(actuator, hint, by_control);
    const bool is_by_control = by_control.first > 0.0 && source == by_control.second;
    const double kp = bearing_nm_ / bearing_error_rad;
    const double kd = std::max(0.0, damping_time_s * kp - damping);
    return {.servo = torque(most, kp, kd),
            .why = fmt::format(
                "torque: {}; kp guessed: it bears a leg's share of the weight at {} rad; kd, with the "
                "joint's damping, {} s × kp",
                source, bearing_error_rad, damping_time_s),
            .torque_is_guessed = !is_by_control && !has_limit(actuator, hint),
            .lacks_gear = is_by_control && actuator.control_limit == 1.0 && actuator.gain == 1.0 &&
                          actuator.uneven_control.empty(),
            .uneven_force =
                is_by_control && !actuator.control_is_one_sided ? actuator.uneven_control : std::string()};
  }

  const ModelFile& file_;
  double bearing_nm_;
};

/// Servos that are sold have less.
constexpr double most_kg_cm = 1000.0;

/// But for the digits of a file.
bool same_number(double a, double b) {
  constexpr double rounding = 1e-3;
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

/// Actuators of an MJCF that are too strong to be of this robot; data sheets tell no torque before a gear. A
/// URDF's efforts become velocity servos, which robot::doubt_strength() doubts.
std::string strong_actuators(const ModelParts& parts, const std::vector<ServoGuess>& servos,
                             double bearing_nm) {
  double mass_kg = 0.0;
  for (const robot::Body& body : parts.bodies) mass_kg += body.mass_kg;
  std::vector<robot::MotorTorque> motors;
  for (std::size_t j = 0; j < servos.size(); ++j)
    if (parts.drives[j] != Drive::none && servos[j].servo.mode == robot::ServoMode::torque &&
        !servos[j].torque_is_guessed && !servos[j].torque_is_geared)
      motors.push_back({parts.joints[j].name, servos[j].servo.max_torque_nm});
  return robot::strength_line(motors, mass_kg, bearing_nm);
}

constexpr double tiny_share = 1e-4;
/// A leg is a pendulum of sqrt(g / length) rad/s; a walker's joints turn at about that.
constexpr double slow_share = 0.25;

}  // namespace

double bearing_torque_nm(const ModelParts& parts, std::size_t legs, double leg_length_m) {
  double mass_kg = 0.0;
  for (const robot::Body& body : parts.bodies) mass_kg += body.mass_kg;
  return mass_kg * norm(parts.gravity_m_s2) * leg_length_m /
         static_cast<double>(std::max<std::size_t>(legs, 1));
}

std::vector<ServoGuess> guess_servos(const ModelFile& file, const ModelParts& parts, double bearing_nm) {
  const ServoGuesser guesser(file, bearing_nm);
  std::vector<ServoGuess> servos;
  for (std::size_t j = 0; j < parts.joints.size(); ++j)
    servos.push_back(
        guesser.guess(parts.joints[j].name, parts.model_joints[j], parts.joints[j].damping_nm_s_per_rad));
  return servos;
}

double gain_within(double max_speed_rad_s) {
  if (max_speed_rad_s <= 0.0) return velocity_gain_per_s;
  return std::min(rounded(max_speed_rad_s / widest_error_rad), velocity_gain_per_s);
}

std::vector<std::string> doubts_of_motors(const ModelFile& file, const ModelParts& parts,
                                          const std::vector<ServoGuess>& servos, double bearing_nm) {
  std::vector<std::string> torqueless, speedless, gearless, uneven, one_sided, odd, limp;
  bool in_kg_cm = false;
  for (std::size_t j = 0; j < servos.size(); ++j) {
    if (parts.drives[j] == Drive::none) continue;
    const std::string& name = parts.joints[j].name;
    if (servos[j].torque_is_guessed) torqueless.push_back(name);
    if (servos[j].speed_is_guessed) speedless.push_back(name);
    if (servos[j].lacks_gear) gearless.push_back(name);
    if (!servos[j].uneven_force.empty())
      (servos[j].acts_to_one_side ? one_sided : uneven)
          .push_back(fmt::format("{} ({})", name, servos[j].uneven_force));
    if (!servos[j].oddity.empty()) odd.push_back(fmt::format("{} ({})", name, servos[j].oddity));
    if (servos[j].has_no_speed_limit && servos[j].servo.kp_nm_per_rad * widest_error_rad < bearing_nm)
      limp.push_back(fmt::format("{} ({:.3g})", name, servos[j].servo.kp_nm_per_rad));
    const auto hint = file.motors.find(name);
    const double effort = hint == file.motors.end() ? 0.0 : hint->second.max_torque_nm;
    in_kg_cm = in_kg_cm || (servos[j].torque_is_guessed && effort > 0.0 && effort < most_kg_cm &&
                            robot::nm_per_kg_cm * effort < robot::strongest_times * bearing_nm);
  }
  std::vector<std::string> doubts;
  if (!torqueless.empty())
    doubts.push_back(
        fmt::format("the model has no limit of torque that a motor could have, and it was guessed: {}; give "
                    "max_torque_nm of the motors that you have{}",
                    io::first_few(torqueless),
                    in_kg_cm ? ". Is effort in kg·cm, as on data sheets? × 0.098 makes N m" : ""));
  if (!speedless.empty())
    doubts.push_back(fmt::format(
        "the model has no limit of speed that a motor could have, and it was guessed, {:.2g} rad/s at {} rad "
        "from a target: {}; give gain_per_s of the motors that you have, their speed in rad/s / {}",
        velocity_gain_per_s * widest_error_rad, widest_error_rad, io::first_few(speedless),
        widest_error_rad));
  if (!gearless.empty())
    doubts.push_back(
        fmt::format("motors with controls of ±1 and a gear of 1 give 1 N m: is `gear` missing? {}",
                    io::first_few(gearless)));
  if (!uneven.empty())
    doubts.push_back(
        fmt::format("actuators that are stronger to one side: amble's servos are not, and have the torque of "
                    "the weaker: {}",
                    io::first_few(uneven)));
  if (!one_sided.empty())
    doubts.push_back(fmt::format(
        "actuators whose force acts to one side alone: amble's servos act to both, as strongly: {}",
        io::first_few(one_sided)));
  if (!odd.empty())
    doubts.push_back(
        fmt::format("actuators that are not as servos of a joint's angle, and are simulated as such: {}",
                    io::first_few(odd)));
  if (!limp.empty())
    doubts.push_back(
        fmt::format("kp, N m per rad, with which a leg's share of the weight, {:.3g} N m, is not held "
                    "even {} rad from the target: {}; 1 is what MuJoCo takes where a model has none",
                    bearing_nm, widest_error_rad, io::first_few(limp)));
  if (std::string strong = strong_actuators(parts, servos, bearing_nm); !strong.empty())
    doubts.push_back(std::move(strong));
  return doubts;
}

void note_other_limits(const ModelFile& file, const robot::RobotSpec& robot, ReadingNotes& notes) {
  if (!file.is_urdf()) return;
  std::vector<std::string> torques, speeds;
  for (const robot::Joint& joint : robot.joints) {
    const auto found = file.motors.find(joint.name);
    if (!joint.has_motor() || found == file.motors.end()) continue;
    const MotorHint& hint = found->second;
    if (hint.max_torque_nm > 0.0 && !same_number(joint.servo.max_torque_nm, hint.max_torque_nm))
      torques.push_back(
          fmt::format("{} ({:.4g}, not {:.4g})", joint.name, joint.servo.max_torque_nm, hint.max_torque_nm));
    if (joint.servo.mode == robot::ServoMode::velocity && hint.max_speed_rad_s > 0.0 &&
        !same_number(joint.servo.gain_per_s, gain_within(hint.max_speed_rad_s)))
      speeds.push_back(fmt::format("{} ({:.4g}, not {:.4g})", joint.name, joint.servo.gain_per_s,
                                   gain_within(hint.max_speed_rad_s)));
  }
  if (!torques.empty())
    notes.add(Reading::replaced,
              fmt::format("effort of <limit>, N m, by max_torque_nm of the robot file, which has the say: {}",
                          fmt::join(torques, ", ")));
  if (!speeds.empty())
    notes.add(
        Reading::replaced,
        fmt::format("velocity of <limit> by gain_per_s of the robot file, which has the say, not by that "
                    "speed / {} rad: {}",
                    widest_error_rad, fmt::join(speeds, ", ")));
}

std::vector<std::string> joints_of_tiny_links(const ModelParts& parts, const std::vector<int>& joints) {
  std::vector<double> behind_kg;  // of each body and all that hang on it
  behind_kg.reserve(parts.bodies.size());
  for (const robot::Body& body : parts.bodies) behind_kg.push_back(body.mass_kg);
  for (std::size_t b = parts.bodies.size(); b-- > 1;)
    behind_kg[to_index(parts.bodies[b].parent)] += behind_kg[b];
  std::vector<std::string> names;
  for (const int j : joints) {
    const robot::Joint& joint = parts.joints[to_index(j)];
    if (behind_kg[to_index(joint.body)] < tiny_share * behind_kg[0]) names.push_back(joint.name);
  }
  return names;
}

std::string slow_joints(const ModelFile& file, const ModelParts& parts, const std::vector<int>& joints,
                        double leg_length_m) {
  const double usual_rad_s = std::sqrt(norm(parts.gravity_m_s2) / leg_length_m);
  std::vector<std::string> slow;
  for (const int j : joints) {
    const std::string& name = parts.joints[to_index(j)].name;
    const auto hint = file.motors.find(name);
    const bool given = hint != file.motors.end() && !hint->second.is_of_a_template();
    const double limit = given ? hint->second.max_speed_rad_s : 0.0;
    if (limit > 0.0 && limit < slow_share * usual_rad_s)
      slow.push_back(fmt::format("{} ({:.3g})", name, limit));
  }
  if (slow.empty()) return {};
  return fmt::format(
      "limits of speed, rad/s, with which legs of {:.2g} m walk at a crawl, as templates have them: {}; a "
      "walker's "
      "joints turn at about {:.2g} rad/s: check velocity of <limit>",
      leg_length_m, fmt::join(slow, ", "), usual_rad_s);
}

}  // namespace amble::morphology
