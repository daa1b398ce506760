#include "amble/morphology/start_guess.hpp"

#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/morphology/facing.hpp"
#include "amble/morphology/limbs.hpp"
#include "amble/morphology/servo_guess.hpp"
#include "amble/morphology/stand_pose.hpp"
#include "amble/morphology/start_pose.hpp"
#include "amble/robot/pose.hpp"

namespace amble::morphology {
namespace {

class StartGuesser {
 public:
  StartGuesser(const ModelFile& file, const StartPlan& plan, const ModelParts* before)
      : file_(file), before_(before) {
    start_.plan = plan;
  }

  StartGuess guess() {
    start_.options.start_keyframe = start_.plan.keyframe;
    fix_what_is_no_hinge();
    extract();
    keep_within_stops();
    add_motors();
    weld_tiny_links();
    join_what_branches_off();
    const bool as_planned = start_.plan.upright == Upright::no || set_upright();
    if (start_.plan.stands && as_planned) bend_legs();
    find_legs();
    if (const auto turn = turn_to_face_x(start_.parts, start_.legs)) {
      turn_root(*turn);
      find_legs();
    }
    return std::move(start_);
  }

 private:
  void extract() {
    const ModelParts last = std::move(start_.parts);
    start_.parts = extract_parts(file_, start_.options, last.geoms.empty() ? before_ : &last);
    if (motors_added_) std::ranges::fill(start_.parts.drives, Drive::motor);
  }

  /// Where the model's list of motors is incomplete.
  void add_motors() {
    ModelParts& parts = start_.parts;
    motors_added_ = lacks_motors(parts, choose_legs(parts, find_limbs(parts), start_.plan.search));
    if (motors_added_) std::ranges::fill(parts.drives, Drive::motor);
  }

  /// Links of next to nothing, which no motor can hold.
  void weld_tiny_links() {
    const ModelParts& parts = start_.parts;
    const LegsGuess legs = guess_legs(parts, choose_legs(parts, find_limbs(parts), start_.plan.search));
    start_.tiny = joints_of_tiny_links(parts, legs.held);
    if (start_.tiny.empty()) return;
    auto& fixed = start_.options.fixed_joints;
    fixed.insert(fixed.end(), start_.tiny.begin(), start_.tiny.end());
    extract();
  }

  void fix_what_is_no_hinge() {
    const mjModel& model = *file_.model;
    for (int j = 0; j < model.njnt; ++j) {
      const bool of_root = model.body_parentid[model.jnt_bodyid[j]] == 0;
      const std::string name = model.names + model.name_jntadr[j];
      if (!of_root && model.jnt_type[j] != mjJNT_HINGE && !name.empty())
        start_.options.fixed_joints.push_back(name);
    }
  }

  void keep_within_stops() {
    const ModelParts& parts = start_.parts;
    for (std::size_t j = 0; j < parts.joints.size(); ++j) {
      const robot::Joint& joint = parts.joints[j];
      if (joint.lower_rad <= 0.0 && joint.upper_rad >= 0.0) continue;
      const bool below = joint.lower_rad > 0.0;
      const double lower = joint.lower_rad + parts.start_rad[j], upper = joint.upper_rad + parts.start_rad[j];
      const bool slight = (below ? joint.lower_rad : -joint.upper_rad) <= slight_rad;
      const double inside = std::min(inside_stops_share * (upper - lower), most_inside_stops_rad);
      double angle = std::round(1e4 * (below ? lower + inside : upper - inside)) / 1e4;
      if (slight) angle = below ? std::ceil(1e4 * lower) / 1e4 : std::floor(1e4 * upper) / 1e4;
      if (slight && (angle > upper || angle < lower)) angle = 0.5 * (lower + upper);
      start_.options.start_angles_rad[joint.name] = angle;
      (slight ? start_.slightly_outside : start_.outside).push_back(joint.name);
    }
    if (!start_.options.start_angles_rad.empty()) extract();
  }

  /// Toes and levers of legs are welded, unless they move without a motor: a foot is one part with all its
  /// shapes.
  void join_what_branches_off() {
    const std::vector<Limb> limbs = find_limbs(start_.parts);
    const LegChoice choice = choose_legs(start_.parts, limbs, start_.plan.search);
    for (const int l : choice.limbs) {
      const Limb& limb = limbs[to_index(l)];
      for (const auto* joints : {&limb.toe_joints, &limb.side_joints})
        for (const int j : *joints)
          if (start_.parts.drives[to_index(j)] != Drive::none)
            start_.joined.push_back(start_.parts.joints[to_index(j)].name);
    }
    if (start_.joined.empty()) return;
    auto& fixed = start_.options.fixed_joints;
    fixed.insert(fixed.end(), start_.joined.begin(), start_.joined.end());
    extract();
  }

  void find_legs() {
    start_.legs = guess_legs(start_.parts, legs_.limbs.empty() ? choose() : legs_);
    start_.legs.motors_added = motors_added_;
    start_.off_ground.clear();
    for (const LegGuess& leg : start_.legs.legs)
      if (std::ranges::find(off_ground_, leg.limb) != off_ground_.end())
        start_.off_ground.push_back(leg.name);
  }

  /// The limbs that are legs, chosen once: a pose that is made does not change them.
  LegChoice choose() {
    LegChoice choice = choose_legs(start_.parts, find_limbs(start_.parts), start_.plan.search);
    off_ground_ = choice.off_ground;
    return choice;
  }

  bool set_upright() {
    start_.legs =
        guess_legs(start_.parts, choose_legs(start_.parts, find_limbs(start_.parts), LegSearch::any_height));
    const auto turn = turn_upright(start_.parts, start_.legs, start_.plan.upright == Upright::from_any);
    if (turn) turn_root(*turn);
    return turn.has_value();
  }

  void turn_root(const RootTurn& turn) {
    const robot::Body& root = start_.parts.bodies[0];
    start_.options.start_rotation = turn.turn * root.rotation;
    start_.turned += (start_.turned.empty() ? "" : "; ") + turn.why;
    extract();
  }

  void bend_legs() {
    legs_ = choose();
    find_legs();
    if (start_.legs.legs.empty()) return;
    robot::RobotSpec robot;
    robot.bodies = start_.parts.bodies;
    const std::vector<robot::Pose> poses = robot::start_poses(robot);
    const std::vector<Limb> limbs = find_limbs(start_.parts);
    for (LegGuess& leg : start_.legs.legs)
      leg.foot_geom = end_geom(start_.parts, limbs[to_index(leg.limb)], poses);
    const bool few = start_.legs.legs.size() <= 2;
    start_.reach = few ? 1.0 - (1.0 - start_.plan.reach) / 3.0 : start_.plan.reach;
    std::vector<std::optional<std::array<double, 2>>> targets_rad;
    for (const ServoGuess& servo : guess_servos(file_, start_.parts, 1.0))  // whatever its torque
      targets_rad.push_back(servo.target_range_rad);
    const StandPose pose = find_stand_pose(start_.parts, start_.legs.legs, targets_rad, start_.reach);
    for (const auto& [joint, angle] : pose.angles_rad) start_.options.start_angles_rad[joint] = angle;
    start_.uneven_share = pose.uneven_share;
    start_.off_share = pose.off_share;
    extract();
  }

  const ModelFile& file_;
  const ModelParts* before_;
  StartGuess start_;
  LegChoice legs_;
  std::vector<int> off_ground_;
  bool motors_added_ = false;
};

}  // namespace

std::vector<StartPlan> start_plans(const ModelFile& file) {
  const std::vector<std::string> names = keyframes(*file.model);
  std::vector<std::string> order;
  for (const char* good : {"home", "stand", "standing", "init", "default"})
    for (const std::string& name : names)
      if (name == good) order.push_back(name);
  for (const std::string& name : names)
    if (!name.empty() && std::ranges::find(order, name) == order.end()) order.push_back(name);
  order.emplace_back();
  std::vector<StartPlan> plans;
  constexpr std::size_t most_keyframes = 6;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (k < most_keyframes || k + 1 == order.size()) plans.push_back({.keyframe = order[k]});
  // A root on its side before legs that bend far; legs that point up are more likely folded than turned over.
  for (const Upright upright : {Upright::from_side, Upright::no, Upright::from_any}) {
    if (upright != Upright::no) plans.push_back({.upright = upright});
    for (const double reach : {0.85, 0.95, 0.7})
      for (const LegSearch search : {LegSearch::either, LegSearch::by_structure})
        plans.push_back({.stands = true, .reach = reach, .search = search, .upright = upright});
  }
  return plans;
}

StartGuess guess_start(const ModelFile& file, const StartPlan& plan, const ModelParts* before) {
  return StartGuesser(file, plan, before).guess();
}

std::string why_start_angles(const StartGuess& start, const std::string& why_not) {
  if (start.plan.stands)
    return fmt::format(
        "Rad as the model counts. A standing start, made from the geometry: feet below the hips on one "
        "level, at {:.3g} "
        "of the reach of the shortest leg, trunk as in the model, joints within their stops. As the model "
        "starts: {}.",
        start.reach, why_not.empty() ? "not tried" : why_not);
  if (start.outside.empty())
    return "Rad as the model counts. Where the model itself starts slightly outside the stops of a joint: "
           "the nearest "
           "angle inside.";
  return fmt::format(
      "Rad as the model counts. Where the model itself starts outside the stops of a joint: {} of the way "
      "from the "
      "nearer stop to the other, at most {} rad.",
      inside_stops_share, most_inside_stops_rad);
}

std::vector<std::string> settled(const StartGuess& start, const std::string& why_not) {
  std::vector<std::string> lines;
  const auto say = [&](std::string text) { lines.push_back(std::move(text)); };
  const std::string is = why_not.empty() ? "" : fmt::format("as the model starts: {}; ", why_not);
  if (start.plan.stands)
    say(fmt::format("{}a standing start was made from the geometry, [start_angle]", is));
  else if (!is.empty() && start.plan.upright == Upright::no)
    say(start.plan.keyframe.empty() ? is + "its default pose is taken"
                                    : fmt::format("{}keyframe '{}' is taken", is, start.plan.keyframe));
  if (!start.turned.empty())
    say(fmt::format("{}the root is turned, start_rpy_deg, as {}; forward is +x",
                    start.plan.upright != Upright::no && !start.plan.stands ? is : "", start.turned));
  if (!start.slightly_outside.empty() && !start.plan.stands)
    say(fmt::format("slightly outside their stops in the model, at the nearest angle inside: {}",
                    fmt::join(start.slightly_outside, ", ")));
  if (!start.outside.empty() && !start.plan.stands)
    say(fmt::format("outside their stops in the model, at most {} rad inside: {}", most_inside_stops_rad,
                    fmt::join(start.outside, ", ")));
  if (!start.tiny.empty())
    say(fmt::format("links that weigh next to nothing, welded: {}", fmt::join(start.tiny, ", ")));
  if (!start.joined.empty())
    say(fmt::format("toes and levers within legs, welded, so that a foot is one part: {}",
                    fmt::join(start.joined, ", ")));
  if (!start.off_ground.empty() && !start.plan.stands)
    say(fmt::format("legs by their joints, though they do not end near the ground: {}",
                    fmt::join(start.off_ground, ", ")));
  if (!start.legs.legs.empty() && !start.legs.held.empty()) {
    std::vector<std::string> held;
    for (const int j : start.legs.held) held.push_back(start.parts.joints[to_index(j)].name);
    say(fmt::format("held where they start, of no leg: {}", fmt::join(held, ", ")));
  }
  return lines;
}

}  // namespace amble::morphology
