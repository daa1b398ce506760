#include "amble/morphology/model_drives.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::morphology {
namespace {

/// Whether its force grows as the angle falls, or, without that, as the speed falls.
bool is_position(const mjModel& model, int a) {
  return model.actuator_biastype[a] == mjBIAS_AFFINE && model.actuator_biasprm[mjNBIAS * a + 1] < 0.0;
}
bool is_velocity(const mjModel& model, int a) {
  return model.actuator_biastype[a] == mjBIAS_AFFINE && model.actuator_biasprm[mjNBIAS * a + 1] == 0.0 &&
         model.actuator_biasprm[mjNBIAS * a + 2] < 0.0;
}

class DriveFinder {
 public:
  DriveFinder(const ModelFile& file, const RobotOfModel& robot, ReadingNotes& notes)
      : file_(file), model_(*file.model), robot_(robot), notes_(notes), drives_(to_index(model_.njnt)) {}

  std::vector<Drive> find() {
    read_actuators();
    read_equalities();
    read_tendons();
    read_urdf();
    for (int j = 0; j < model_.njnt; ++j)
      if (robot_.has_joint(j)) drives_[to_index(j)] = drive_of(j);
    return std::move(drives_);
  }

 private:
  template <typename... Args>
  void note(Reading reading, fmt::format_string<Args...> text, Args&&... args) {
    notes_.add(reading, fmt::format(text, std::forward<Args>(args)...));
  }

  std::string joint_name(int j) const { return fmt::format("'{}'", model_.names + model_.name_jntadr[j]); }
  std::string body_name(int b) const {
    return b == 0 ? "the world" : fmt::format("'{}'", model_.names + model_.name_bodyadr[b]);
  }
  std::string joint_names(const std::vector<int>& joints) const {
    std::vector<std::string> names;
    names.reserve(joints.size());
    for (const int j : joints) names.push_back(joint_name(j));
    return fmt::format("{}", fmt::join(names, ", "));
  }

  /// An actuator's own name, or what it acts on.
  std::string actuator_name(int a, const std::string& target) const {
    const std::string name = model_.names + model_.name_actuatoradr[a];
    return name.empty() || fmt::format("'{}'", name) == target ? target
                                                               : fmt::format("'{}' ({})", name, target);
  }

  int joint_of_name(const std::string& name) const {
    for (int j = 0; j < model_.njnt; ++j)
      if (name == model_.names + model_.name_jntadr[j]) return j;
    return -1;
  }

  void read_actuators() {
    std::vector<std::string> servos, seconds, of_no_robot, elsewhere;
    for (int a = 0; a < model_.nu; ++a) {
      const int kind = model_.actuator_trntype[a], target = model_.actuator_trnid[2 * a];
      if (kind == mjTRN_TENDON) continue;  // read_tendons()
      if (kind != mjTRN_JOINT && kind != mjTRN_JOINTINPARENT) {
        elsewhere.push_back(actuator_name(a, fmt::format("number {}", a + 1)));
        continue;
      }
      const std::string name = actuator_name(a, joint_name(target));
      if (!robot_.has_joint(target)) {
        of_no_robot.push_back(name);
        continue;
      }
      actuated_.insert(target);
      const std::vector<int> used = servo_actuators(model_, target);
      (std::ranges::find(used, a) != used.end() ? servos : seconds).push_back(name);
    }
    if (!servos.empty())
      note(Reading::replaced, "{} actuators by the robot file's servos: {}", servos.size(),
           fmt::join(servos, ", "));
    if (!seconds.empty())
      note(Reading::left_out, "actuators beside another of their joint: {}", fmt::join(seconds, ", "));
    if (!of_no_robot.empty())
      note(Reading::left_out, "actuators of joints that the robot does not have: {}",
           fmt::join(of_no_robot, ", "));
    if (!elsewhere.empty())
      note(Reading::left_out, "actuators that act on a site, a slider-crank or a body: {}",
           fmt::join(elsewhere, ", "));
  }

  void read_equalities() {
    std::vector<std::string> loops, inactive;
    for (int e = 0; e < model_.neq; ++e) {
      const int type = model_.eq_type[e];
      if (model_.eq_active[e] == 0) {
        inactive.push_back(type == mjEQ_JOINT || type == mjEQ_TENDON ? equality_text(e) : tie_text(e));
        continue;
      }
      if (type == mjEQ_JOINT)
        read_joint_equality(e);
      else if (type == mjEQ_TENDON)
        read_tendon_equality(e);
      else
        read_tie(e, loops);
    }
    if (!inactive.empty())
      note(Reading::left_out, "equality constraints that are not active: {}", fmt::join(inactive, ", "));
    if (!loops.empty())
      fail(ExitCode::bad_input, "{}: equality constraint {}: robots with closed loops are not supported",
           file_.path.string(), fmt::join(loops, ", "));
  }

  /// The bodies that a connect, a weld or a distance ties together.
  std::pair<int, int> tied_bodies(int e) const {
    const int a = model_.eq_obj1id[e], b = model_.eq_obj2id[e];
    if (model_.eq_type[e] != mjEQ_DISTANCE) return {a, std::max(b, 0)};
    return {model_.geom_bodyid[a], model_.geom_bodyid[b]};
  }

  bool is_named(int e) const { return model_.names[model_.name_eqadr[e]] != '\0'; }

  std::string tie_text(int e) const {
    const auto [a, b] = tied_bodies(e);
    const std::string name = model_.names + model_.name_eqadr[e];
    return name.empty() ? fmt::format("of {} and {}", body_name(a), body_name(b)) : fmt::format("'{}'", name);
  }

  std::string equality_text(int e) const {
    const std::string name = model_.names + model_.name_eqadr[e];
    if (!name.empty()) return fmt::format("'{}'", name);
    if (model_.eq_type[e] == mjEQ_TENDON) return fmt::format("of {}", tendon_name(model_.eq_obj1id[e]));
    return fmt::format("of {}", joint_name(model_.eq_obj1id[e]));
  }

  void read_tie(int e, std::vector<std::string>& loops) {
    const auto [a, b] = tied_bodies(e);
    const int first = robot_.rigid_body(a), second = robot_.rigid_body(b);
    if (first >= 0 && second >= 0 && first != second)
      loops.push_back(tie_text(e));
    else if (first >= 0 && first == second)
      note(Reading::left_out, "equality constraint {}: both ends are on one rigid body", tie_text(e));
    else
      notes_.add(Reading::left_out,
                 fmt::format(
                     "equality constraint {}of {} and {}: one end is not on the robot, which is free to move",
                     is_named(e) ? tie_text(e) + ", " : "", body_name(a), body_name(b)),
                 (first >= 0) != (second >= 0));
  }

  void read_joint_equality(int e) {
    const int follower = model_.eq_obj1id[e], leader = model_.eq_obj2id[e];
    if (leader < 0) {
      locked_.insert(follower);
      note(Reading::replaced, "equality constraint {}, which fixes the angle of joint {}: its servo holds it",
           equality_text(e), joint_name(follower));
      return;
    }
    couplings_.emplace_back(follower, leader);
    note(Reading::left_out,
         "equality constraint {}: joint {} does not follow joint {}, each moves on its own", equality_text(e),
         joint_name(follower), joint_name(leader));
  }

  std::string tendon_name(int t) const {
    const std::string name = model_.names + model_.name_tendonadr[t];
    return name.empty() ? fmt::format("number {}", t + 1) : fmt::format("'{}'", name);
  }

  /// The joints of a fixed tendon; a spatial one passes sites.
  std::vector<int> joints_of_tendon(int t) const {
    std::vector<int> joints;
    for (int w = model_.tendon_adr[t], end = w + model_.tendon_num[t]; w < end; ++w)
      if (model_.wrap_type[w] == mjWRAP_JOINT) joints.push_back(model_.wrap_objid[w]);
    return joints;
  }

  void read_tendon_equality(int e) {
    std::vector<int> joints = joints_of_tendon(model_.eq_obj1id[e]);
    if (model_.eq_obj2id[e] >= 0)
      for (const int j : joints_of_tendon(model_.eq_obj2id[e])) joints.push_back(j);
    for (std::size_t i = 1; i < joints.size(); ++i) couplings_.emplace_back(joints[i], joints[0]);
    note(Reading::left_out, "equality constraint {}: what tendon {} couples moves on its own",
         equality_text(e), tendon_name(model_.eq_obj1id[e]));
  }

  void read_tendons() {
    for (int t = 0; t < model_.ntendon; ++t) {
      const std::vector<int> joints = joints_of_tendon(t);
      std::string text = fmt::format("tendon {}", tendon_name(t));
      if (!joints.empty()) text += fmt::format(" over {}", joint_names(joints));
      const std::vector<std::string> actuators = actuators_of_tendon(t);
      std::vector<std::string> acts;
      if (!actuators.empty()) acts.push_back(fmt::format("its actuators: {}", fmt::join(actuators, ", ")));
      if (model_.tendon_limited[t] != 0) acts.emplace_back("its limits");
      if (model_.tendon_stiffness[t] != 0.0) acts.emplace_back("its spring");
      if (model_.tendon_damping[t] != 0.0) acts.emplace_back("its damping");
      if (model_.tendon_frictionloss[t] != 0.0) acts.emplace_back("its friction");
      if (acts.empty()) {
        note(Reading::left_out, "{}, which only measures", text);
        continue;
      }
      note(Reading::left_out, "{}, with {}", text, fmt::join(acts, ", "));
      if (!actuators.empty()) pulled_.insert(joints.begin(), joints.end());
    }
  }

  std::vector<std::string> actuators_of_tendon(int t) const {
    std::vector<std::string> names;
    for (int a = 0; a < model_.nu; ++a) {
      if (model_.actuator_trntype[a] != mjTRN_TENDON || model_.actuator_trnid[2 * a] != t) continue;
      const std::string name = model_.names + model_.name_actuatoradr[a];
      names.push_back(name.empty() ? fmt::format("number {}", a + 1) : fmt::format("'{}'", name));
    }
    return names;
  }

  /// A URDF's transmissions, ros2_control and mimic, which MuJoCo does not read.
  void read_urdf() {
    for (const std::string& name : file_.motors_named)
      if (const int j = joint_of_name(name); j >= 0 && robot_.has_joint(j)) actuated_.insert(j);
    for (const auto& [follower, leader] : file_.mimics)
      if (const int a = joint_of_name(follower), b = joint_of_name(leader); a >= 0 && b >= 0)
        couplings_.emplace_back(a, b);
  }

  Drive drive_of(int joint) const {
    if (actuated_.contains(joint)) return Drive::motor;
    if (locked_.contains(joint)) return Drive::held;
    if (actuated_.empty()) return Drive::motor;
    // All that is coupled with it, directly or not.
    std::set<int> together{joint};
    for (std::size_t before = 0; before != together.size();) {
      before = together.size();
      for (const auto& [a, b] : couplings_)
        if (together.contains(a) || together.contains(b)) together.insert({a, b});
    }
    if (std::ranges::any_of(together, [this](int j) { return actuated_.contains(j); })) return Drive::motor;
    return std::ranges::any_of(together, [this](int j) { return pulled_.contains(j); }) ? Drive::held
                                                                                        : Drive::none;
  }

  const ModelFile& file_;
  const mjModel& model_;
  const RobotOfModel& robot_;
  ReadingNotes& notes_;
  std::vector<Drive> drives_;
  std::set<int> actuated_, locked_, pulled_;
  std::vector<std::pair<int, int>> couplings_;
};

}  // namespace

std::vector<int> servo_actuators(const mjModel& model, int joint) {
  std::vector<int> all;
  for (int a = 0; a < model.nu; ++a) {
    const int kind = model.actuator_trntype[a];
    if ((kind == mjTRN_JOINT || kind == mjTRN_JOINTINPARENT) && model.actuator_trnid[2 * a] == joint)
      all.push_back(a);
  }
  if (all.empty()) return all;
  const auto position = std::ranges::find_if(all, [&](int a) { return is_position(model, a); });
  if (position == all.end()) return {all.front()};
  std::vector<int> servo{*position};
  std::ranges::copy_if(all, std::back_inserter(servo), [&](int a) { return is_velocity(model, a); });
  return servo;
}

std::vector<Drive> drives_of(const ModelFile& file, const RobotOfModel& robot, ReadingNotes& notes) {
  return DriveFinder(file, robot, notes).find();
}

}  // namespace amble::morphology
