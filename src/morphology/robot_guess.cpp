#include "amble/morphology/robot_guess.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/foot_contact.hpp"
#include "amble/morphology/foot_shapes.hpp"
#include "amble/morphology/leg_guess.hpp"
#include "amble/morphology/number_text.hpp"
#include "amble/morphology/original_model.hpp"
#include "amble/morphology/servo_guess.hpp"
#include "amble/morphology/start_pose.hpp"
#include "amble/robot/check.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

/// A controller moves a joint no further than this from the start pose unless the file says so.
constexpr double widest_command_rad = 0.8;
/// Twice as long ones would fall from more than a metre at the start of each trial.
constexpr double longest_leg_of_any_robot_m = 50.0;
/// Share of the trunk's clearance at the start that is left when a robot on more than four legs has fallen.
constexpr double lying_share = 0.1;
constexpr double paper_mass_kg = 5.4, paper_cfm_s_per_kg = 1e-4;

std::string list(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  all.reserve(names.size());
  for (const std::string& name : names) all.push_back(io::toml_quoted(name));
  return fmt::format("[{}]", fmt::join(all, ", "));
}

class RobotGuesser {
 public:
  RobotGuesser(const ModelFile& file, const std::filesystem::path& model, const StartGuess& start,
               const std::string& why_not)
      : file_(file),
        model_(model),
        start_(start),
        options_(start.options),
        parts_(start.parts),
        legs_(start.legs),
        why_not_(why_not) {}

  RobotGuess guess(bool keep) {
    if (const auto fault = robot::gravity_fault(parts_.gravity_m_s2); !fault.empty())
      fail(ExitCode::bad_input, "{}: {}", file_.path.string(), fault);
    robot_.bodies = parts_.bodies;
    robot_.geoms = parts_.geoms;
    robot_.joints = parts_.joints;
    refuse_giants();
    bearing_nm_ = bearing_torque_nm(parts_, legs_.legs.size(), longest_leg_m(parts_, legs_));
    servos_ = guess_servos(file_, parts_, bearing_nm_);
    guess_.name = model_.stem().string();
    line("# Guessed from {} by `amble robot --init`: check each line. robots/README.md describes them.",
         io::printable(model_.filename().string()));
    line("name = {}", io::toml_quoted(guess_.name));
    line("model = {}\n", io::toml_quoted(model_.generic_string()));
    write_legs();
    write_poses();
    if (keep) guess_.toml += keeping_lines(file_, options_, parts_, robot_);
    write_names();
    write_servos();
    write_commands();
    write_start_angles();
    write_contact();
    std::ranges::move(settled(start_, why_not_), std::back_inserter(guess_.settled));
    return std::move(guess_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(guess_.toml), text, std::forward<Args>(args)...);
    guess_.toml += '\n';
  }

  /// A comment, wrapped; names in it may have characters that TOML does not allow there.
  void comment(const std::string& raw) {
    const std::string text = io::printable(raw);
    constexpr std::size_t width = 100;
    std::string row = "#";
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      if (row.size() + 1 + end - at > width) {
        line("{}", row);
        row = "#";
      }
      row += " " + text.substr(at, end - at);
      at = end + 1;
    }
    line("{}", row);
  }

  /// Settings by size would be out of their ranges.
  void refuse_giants() const {
    if (const double legs_m = longest_leg_m(parts_, legs_); legs_m > longest_leg_of_any_robot_m)
      fail(
          ExitCode::bad_input,
          "{}: its legs are {:.3g} m long, for which amble has no settings: are its lengths in another unit? "
          "amble takes metres and kilograms; scale the model (mesh scale, origins, sizes)",
          file_.path.string(), legs_m);
  }

  void write_legs() {
    std::vector<std::string> names, held, passive;
    for (const int j : legs_.passive) passive.push_back(parts_.joints[to_index(j)].name);
    if (legs_.motors_added)
      comment("The model has motors for so few joints that most legs would have none: every joint gets one.");
    for (const LegGuess& leg : legs_.legs) names.push_back(leg.name);
    for (const int j : legs_.held) held.push_back(parts_.joints[to_index(j)].name);
    if (names.empty()) {
      line("# No chain of bodies with joints ends near the ground.");
      guess_.asked.push_back("legs, joint_types and [names]: no leg was found in the start pose");
    } else {
      comment(fmt::format("Legs: {}; named by {}.", legs_.why_legs, legs_.why_names));
    }
    line("legs = {}", list(names));
    if (!names.empty()) comment(fmt::format("Types: {}.", legs_.why_types));
    line("joint_types = {}", list(legs_.joint_types));
    if (!held.empty()) {
      comment(
          "Joints of no leg. Their servo holds them at the start angle; in `fixed` they would be welded, "
          "which is "
          "simulated faster.");
      line("held = {}", list(held));
    }
    if (!passive.empty()) {
      comment(
          "Joints without an actuator in a model whose other joints have some: they have no motor, and move "
          "freely, with the model's spring, damping and friction.");
      line("passive = {}", list(passive));
    }
    if (!options_.fixed_joints.empty()) {
      if (options_.fixed_joints.size() > start_.joined.size() + start_.tiny.size())
        line("# Neither hinges nor the root's: welded, amble has no such joints.");
      if (!start_.tiny.empty())
        comment(fmt::format("Links that weigh next to nothing, welded, as no motor could hold them: {}.",
                            fmt::join(start_.tiny, ", ")));
      if (!start_.joined.empty())
        comment(fmt::format("Toes and levers within legs, welded, so that a foot is one part: {}.",
                            fmt::join(start_.joined, ", ")));
      line("fixed = {}", list(options_.fixed_joints));
    }
  }

  void write_poses() {
    line("");
    if (!options_.start_keyframe.empty()) {
      line("# A keyframe of the model{}.",
           options_.start_keyframe == "home" || options_.start_keyframe == "stand"
               ? ""
               : ", the first or the one whose name sounds like a start");
      line("start = {}", io::toml_quoted(options_.start_keyframe));
    }
    write_rotation();
    const auto poses = robot::start_poses(robot_);
    const double clearance_m = robot::clearance_m(robot_, poses), root_m = robot_.bodies[0].position_m.z;
    double raised_m = rounded_up(root_m - clearance_m);
    if (raised_m == 0.0) raised_m = 1e-4;  // 0 would be the model's own height
    double lift_m = 0.0;
    if (std::isfinite(clearance_m)) {
      line("# The lowest point touches the ground; the model has {:.4g}.", root_m);
      line("start_height_m = {}", raised_m);
      lift_m = raised_m - root_m;
    } else {
      guess_.asked.push_back("a foot: nothing of the model collides");
    }
    const double com_m = (poses[0] * robot_.bodies[0].com_m).z + lift_m;
    write_fall_height(com_m, lift_m);
    line("# A guess: legs that pass through each other are simulated faster, and learn as well.");
    line("self_collision = false");
  }

  /// `com_m`: height of the root's centre of mass at the start; `lift_m`: by what the model is lifted for it.
  void write_fall_height(double com_m, double lift_m) {
    if (!(com_m > 0.0)) {
      comment("The root's centre of mass starts below the lowest point: a leg's length below that.");
      line("fall_height_m = {}", rounded_down(com_m - longest_leg_m(parts_, legs_)));
      return;
    }
    const double half_m = 0.5 * com_m;
    double bottom_m = std::numeric_limits<double>::infinity();
    const auto poses = robot::start_poses(robot_);
    for (const robot::Geom& geom : parts_.geoms)
      if (geom.body == 0 && geom.collides)
        bottom_m = std::min(bottom_m, robot::bottom_m(geom, poses) + lift_m);
    const double lying_m = com_m - (1.0 - lying_share) * bottom_m;
    // Legs that spread out to all sides carry a trunk that nearly lies on the ground as well as any other.
    if (legs_.legs.size() > 4 && lying_m < half_m) {
      comment(fmt::format(
          "With more than four legs a low trunk is no fall: this is the height of the root's centre of "
          "mass where {} of the trunk's clearance are left.",
          lying_share));
      line("fall_height_m = {}", rounded_down(lying_m));
      return;
    }
    line("# Half the height at which the root's centre of mass starts.");
    line("fall_height_m = {}", rounded_down(half_m));
  }

  void write_foot(const LegGuess& leg) {
    if (leg.foot_geoms.size() == 1) {
      line("foot = {}  # the lowest shape that collides of {}",
           io::toml_quoted(parts_.geoms[to_index(leg.foot_geom)].name),
           bodies_beyond_foot(parts_, leg).empty() ? "its last body" : "its last body that has one");
      return;
    }
    std::vector<std::string> names;
    for (const int g : leg.foot_geoms) names.push_back(parts_.geoms[to_index(g)].name);
    line("# The shapes of its last body that can touch the ground: any of them is the foot's touch.");
    line("foot = {}", list(names));
  }

  void write_names() {
    for (const LegGuess& leg : legs_.legs) {
      line("\n[names.{}]", io::toml_key(leg.name));
      write_foot(leg);
      for (std::size_t t = 0; t < legs_.joint_types.size(); ++t) {
        const int j = leg.joint_of_type[t];
        line("{} = {}", io::toml_key(legs_.joint_types[t]),
             j < 0 ? "\"\"  # none" : io::toml_quoted(parts_.joints[to_index(j)].name));
      }
    }
  }

  void write_servo(const std::string& table, const ServoGuess& guess) {
    const robot::Servo& servo = guess.servo;
    line("");
    comment(guess.why);
    line("[{}]", table);
    if (servo.mode == robot::ServoMode::velocity) {
      line("mode = \"velocity\"\ngain_per_s = {}\nmax_torque_nm = {}", servo.gain_per_s, servo.max_torque_nm);
      return;
    }
    line("mode = \"torque\"\nkp_nm_per_rad = {}\nkd_nm_s_per_rad = {}\nmax_torque_nm = {}",
         servo.kp_nm_per_rad, servo.kd_nm_s_per_rad, servo.max_torque_nm);
  }

  static bool same(const robot::Servo& a, const robot::Servo& b) {
    return a.mode == b.mode && a.gain_per_s == b.gain_per_s && a.max_torque_nm == b.max_torque_nm &&
           a.kp_nm_per_rad == b.kp_nm_per_rad && a.kd_nm_s_per_rad == b.kd_nm_s_per_rad;
  }

  void doubt_readings() {
    for (const ReadingNotes::Line& line : parts_.notes.lines())
      if (line.is_doubt) guess_.doubts.push_back(line.text);
  }

  void write_servos() {
    doubt_readings();
    std::ranges::move(doubts_of_motors(file_, parts_, servos_, bearing_nm_),
                      std::back_inserter(guess_.doubts));
    std::ranges::move(doubts_of_feet(file_, parts_, legs_), std::back_inserter(guess_.doubts));
    if (std::ranges::any_of(servos_, &ServoGuess::has_no_speed_limit))
      guess_.settled.emplace_back(
          "position actuators turn as fast as their torque allows, as an MJCF has no greatest speed; if what "
          "evolves vibrates, give [servo] one: docs/BUILDING.md");
    std::vector<int> driven;
    for (const LegGuess& leg : legs_.legs) driven.insert(driven.end(), leg.joints.begin(), leg.joints.end());
    if (std::string slow = slow_joints(file_, parts_, driven, longest_leg_m(parts_, legs_)); !slow.empty())
      guess_.doubts.push_back(std::move(slow));
    const auto servo_of = [&](int j) -> const ServoGuess& { return servos_[to_index(j)]; };
    ServoGuess common{{robot::ServoMode::velocity, 9.0, 1.0, 0.0, 0.0}, "there are no joints"};
    if (!legs_.legs.empty())
      common = servo_of(legs_.legs[0].joints.front());
    else if (!servos_.empty())
      common = servos_[0];
    write_servo("servo", common);
    for (std::size_t t = 0; t < legs_.joint_types.size(); ++t) {
      std::vector<std::pair<const LegGuess*, int>> joints;
      for (const LegGuess& leg : legs_.legs)
        if (leg.joint_of_type[t] >= 0) joints.emplace_back(&leg, leg.joint_of_type[t]);
      const ServoGuess& first = servo_of(joints.front().second);
      const bool alike = std::ranges::all_of(
          joints, [&](const auto& of_leg) { return same(servo_of(of_leg.second).servo, first.servo); });
      const std::string type = io::toml_key(legs_.joint_types[t]);
      if (alike && !same(first.servo, common.servo)) write_servo("servo_of." + type, first);
      if (alike) continue;
      for (const auto& [leg, j] : joints)
        if (!same(servo_of(j).servo, common.servo))
          write_servo(fmt::format("servo_of.{}.{}", io::toml_key(leg->name), type), servo_of(j));
    }
    for (const int j : legs_.held)
      if (!same(servo_of(j).servo, common.servo))
        write_servo("servo_of." + io::toml_key(parts_.joints[to_index(j)].name), servo_of(j));
  }

  /// Where the model limits the targets of a joint's motor, these limits from its start on: a range of
  /// command has the start in it.
  std::array<double, 2> target_limits(int j) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    const double start = parts_.start_rad[to_index(j)];
    const auto& limits = servos_[to_index(j)].target_range_rad;
    if (!limits) return {-none, none};
    return {std::min((*limits)[0], start), std::max((*limits)[1], start)};
  }

  /// The range of command of a joint where it is not from stop to stop.
  std::optional<std::array<double, 2>> command(int j) const {
    const robot::Joint& joint = parts_.joints[to_index(j)];
    const double start = parts_.start_rad[to_index(j)];
    const auto limits = target_limits(j);
    const auto within = [&](double least, double most) {
      return std::array{std::max({joint.lower_rad, -widest_command_rad, least - start}),
                        std::min({joint.upper_rad, widest_command_rad, most - start})};
    };
    constexpr double none = std::numeric_limits<double>::infinity();
    auto range = within(limits[0], limits[1]);
    // Limits that leave no target but the start are none.
    if (!(range[0] < range[1])) range = within(-none, none);
    if (range[0] == joint.lower_rad && range[1] == joint.upper_rad) return std::nullopt;
    return std::array{inward(start + range[0], start), inward(start + range[1], start)};
  }

  /// Whether the model's limits of targets leave less of a joint's range.
  bool is_limited(int j) const {
    const double start = parts_.start_rad[to_index(j)];
    const robot::Joint& joint = parts_.joints[to_index(j)];
    const auto limits = target_limits(j);
    return limits[0] - start > std::max(joint.lower_rad, -widest_command_rad) ||
           limits[1] - start < std::min(joint.upper_rad, widest_command_rad);
  }

  /// Which limits of targets the ranges of command keep to.
  std::string limits_of_targets() const {
    std::vector<std::string> names;
    for (const LegGuess& leg : legs_.legs)
      for (const int j : leg.joints)
        if (is_limited(j)) names.push_back(parts_.joints[to_index(j)].name);
    if (names.empty()) return "";
    return fmt::format(", and within {} ({})",
                       file_.is_urdf() ? "the soft limits of safety controllers"
                                       : "ctrlrange of position actuators, which MuJoCo clips targets at",
                       io::first_few(names));
  }

  void write_commands() {
    std::string of_types;
    std::map<std::string, std::string> of_legs;
    for (std::size_t t = 0; t < legs_.joint_types.size(); ++t) {
      std::vector<std::optional<std::array<double, 2>>> ranges;
      for (const LegGuess& leg : legs_.legs)
        if (leg.joint_of_type[t] >= 0) ranges.push_back(command(leg.joint_of_type[t]));
      const auto text = [&](const std::array<double, 2>& range) {
        return fmt::format("{} = [{}, {}]\n", io::toml_key(legs_.joint_types[t]), range[0], range[1]);
      };
      if (std::ranges::all_of(ranges, [&](const auto& range) { return range == ranges.front(); })) {
        if (ranges.front()) of_types += text(*ranges.front());
        continue;
      }
      for (const LegGuess& leg : legs_.legs)
        if (const int j = leg.joint_of_type[t]; j >= 0 && command(j)) of_legs[leg.name] += text(*command(j));
    }
    if (of_types.empty() && of_legs.empty()) return;
    line("");
    comment(
        fmt::format("Targets of controllers, rad as the model counts: at most {} rad to either side of the "
                    "start, within the stops{}. Wider ranges are harder to search.",
                    widest_command_rad, limits_of_targets()));
    line("[command]");
    guess_.toml += of_types;
    for (const LegGuess& leg : legs_.legs)
      if (of_legs.contains(leg.name)) line("[command.{}]\n{}", io::toml_key(leg.name), of_legs[leg.name]);
  }

  void write_rotation() {
    if (!options_.start_rotation) return;
    comment(fmt::format(
        "Of the root's frame: roll, pitch, yaw, degrees. The model's is turned, as {}; forward is +x.",
        start_.turned));
    const RollPitchYaw turn = roll_pitch_yaw(*options_.start_rotation);
    const auto degrees = [](double rad) {
      return std::round(1e4 * rad * 180.0 / std::numbers::pi) / 1e4 + 0.0;
    };
    line("start_rpy_deg = [{}, {}, {}]", degrees(turn.roll_rad), degrees(turn.pitch_rad),
         degrees(turn.yaw_rad));
  }

  void write_start_angles() {
    if (options_.start_angles_rad.empty()) return;
    line("");
    comment(why_start_angles(start_, why_not_));
    line("[start_angle]");
    for (const auto& [name, angle] : options_.start_angles_rad) line("{} = {}", io::toml_key(name), angle);
  }

  void write_contact() {
    double mass_kg = 0.0;
    for (const robot::Body& body : parts_.bodies) mass_kg += body.mass_kg;
    line("\n[contact]");
    const FootFriction friction = foot_friction(file_, parts_, legs_);
    line("friction = {:.4g}  # {}", friction.coefficient, friction.source);
    comment("As the paper's quadruped; softness by weight, so that the robot sinks in as far.");
    line("erp = 0.1");
    line("cfm_s_per_kg = {:.3g}  # {} × {} kg / {:.4g} kg", paper_cfm_s_per_kg * paper_mass_kg / mass_kg,
         paper_cfm_s_per_kg, paper_mass_kg, mass_kg);
  }

  const ModelFile& file_;
  std::filesystem::path model_;
  const StartGuess& start_;
  const ReadingOptions& options_;
  const ModelParts& parts_;
  const LegsGuess& legs_;
  const std::string& why_not_;
  double bearing_nm_ = 0.0;
  std::vector<ServoGuess> servos_;
  robot::RobotSpec robot_;
  RobotGuess guess_;
};

}  // namespace

RobotGuess guess_robot(const ModelFile& file, const std::filesystem::path& model, const StartGuess& start,
                       const std::string& why_not, bool keep) {
  return RobotGuesser(file, model, start, why_not).guess(keep);
}

RobotGuess guess_robot(const ModelFile& file, const std::filesystem::path& model, bool keep) {
  return guess_robot(file, model, guess_start(file, start_plans(file).front()), {}, keep);
}

}  // namespace amble::morphology
