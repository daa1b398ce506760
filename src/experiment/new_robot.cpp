#include "amble/experiment/new_robot.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/start_look.hpp"
#include "amble/morphology/robot_file.hpp"
#include "amble/morphology/side_file.hpp"
#include "amble/morphology/start_guess.hpp"
#include "amble/physics/batch/solver_error.hpp"
#include "amble/physics/engine.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::experiment {
namespace {

namespace fs = std::filesystem;

/// How bad a fault of a start is: the start with the least sum is taken.
constexpr int without_legs = 100, unreadable = 80, does_not_stand = 20, other_fault = 10, leg_in_the_air = 5,
              outside_stops = 1;
/// A leg is in the air if its foot is higher than this share of the legs' height.
constexpr double in_the_air = 0.1;

struct Faults {
  int sum = 0, lies = 0;
  std::vector<std::string> lines;

  void add(int weight, std::string line) {
    sum += weight;
    lines.push_back(std::move(line));
  }
};

/// A start that was tried.
struct Try {
  morphology::StartGuess start;
  NewRobot made;
  Faults faults;
};

class RobotMaker {
 public:
  RobotMaker(const morphology::ModelFile& model_file, const fs::path& model, const fs::path& file)
      : model_file_(model_file), model_(model), file_(file) {}

  NewRobot make() {
    const std::vector<morphology::StartPlan> plans = morphology::start_plans(model_file_);
    Try own = attempt(plans.front());
    before_ = &own.start.parts;
    const std::vector<std::string> at_stops =
        own.faults.sum > 0 ? joints_at_stops(own) : std::vector<std::string>();
    const bool good = is_good(own);
    if (good && at_stops.empty()) return with_model(own, {});
    const std::string& keyframe = plans.front().keyframe;
    const std::string why_not =
        (keyframe.empty() ? "" : fmt::format("in its keyframe '{}' ", keyframe)) + reasons(own.faults.lines) +
        (at_stops.empty() ? "" : fmt::format(", with joints at their stops: {}", fmt::join(at_stops, ", ")));
    std::optional<Try> best;
    for (std::size_t p = 1; p < plans.size() && !(best && best->faults.sum == 0); ++p) {
      Try next = attempt(plans[p]);
      if (worth_a_look(next) && (!best || next.faults.sum < best->faults.sum)) best = std::move(next);
    }
    if (!best || best->faults.sum >= own.faults.sum || (good && best->faults.sum > 0))
      return with_model(own, {});
    return with_model(*best, why_not);
  }

 private:
  /// What was chosen, carrying its model if it can.
  NewRobot with_model(Try& chosen, const std::string& why_not) const {
    NewRobot& made = chosen.made;
    std::vector<std::string> asked = std::move(made.guess.asked);
    made.guess = morphology::guess_robot(model_file_, model_, chosen.start, why_not, true);
    made.guess.asked = std::move(asked);
    if (made.robot)
      made.robot = morphology::make_robot(morphology::parse_side_file(made.guess.toml, file_), model_file_,
                                          file_.string(), &made.notes, &chosen.start.parts);
    return std::move(made);
  }

  /// On one or two legs a robot whose joints are only held falls sooner or later, wherever it starts.
  static bool is_good(const Try& own) {
    const bool falls_anyway = own.made.robot && own.made.robot->legs.size() <= 2 && own.faults.lies == 0 &&
                              own.start.outside.empty() && !own.start.legs.legs.empty();
    return own.faults.sum == 0 || falls_anyway;
  }

  /// Joints of legs that start at a stop. As in the Open Dynamics Engine, a motor that pushes against a stop
  /// gives all its torque, whatever speed it aims at: it throws a robot that would stand otherwise.
  /// Joints that went to the stop nearest to the model's own start stay there.
  static std::vector<std::string> joints_at_stops(const Try& own) {
    if (!own.start.slightly_outside.empty()) return {};
    constexpr double at_stop_rad = 2e-3;
    std::vector<std::string> names;
    for (const robot::Leg& leg : own.made.robot ? own.made.robot->legs : std::vector<robot::Leg>())
      for (const int j : leg.joints) {
        if (j < 0) continue;
        const robot::Joint& joint = own.made.robot->joints[to_index(j)];
        if (std::min(std::abs(joint.lower_rad), std::abs(joint.upper_rad)) < at_stop_rad)
          names.push_back(joint.name);
      }
    return names;
  }

  /// Faults without what to do about them.
  static std::string reasons(const std::vector<std::string>& faults) {
    std::vector<std::string> lines;
    for (std::string line : faults) {
      const bool points = line.starts_with("legs:");
      if (points && faults.size() > 1) continue;
      for (const char* advice : {": if the model", ". Give", ": look for", ": its servos", ": it starts"})
        line = line.substr(0, line.find(advice));
      constexpr std::string_view held = "held in its start pose ";
      if (line.starts_with(held)) line = line.substr(held.size());
      lines.push_back(line);
    }
    return fmt::format("{}", fmt::join(lines, ", "));
  }

  /// A root that was to be turned and was not makes no new start.
  static bool worth_a_look(const Try& tried) {
    return tried.start.plan.upright == morphology::Upright::no || !tried.start.turned.empty();
  }

  Try attempt(const morphology::StartPlan& plan) {
    Try tried;
    tried.start = morphology::guess_start(model_file_, plan, before_);
    tried.made.guess = morphology::guess_robot(model_file_, model_, tried.start);
    if (tried.start.legs.legs.empty()) tried.faults.add(without_legs, "no leg was found");
    if (!plan.stands && !tried.start.outside.empty())
      tried.faults.add(outside_stops, fmt::format("joints are far outside their stops: {}",
                                                  fmt::join(tried.start.outside, ", ")));
    if (!worth_a_look(tried)) return tried;
    try {
      tried.made.robot =
          morphology::make_robot(morphology::parse_side_file(tried.made.guess.toml, file_), model_file_,
                                 file_.string(), &tried.made.notes, &tried.start.parts);
    } catch (const UserError& error) {
      tried.made.guess.asked.emplace_back(error.what());
      tried.faults.add(unreadable, "it needs more than the model says");
      return tried;
    }
    if (!tried.made.robot->legs.empty()) look_at(*tried.made.robot, tried.faults);
    return tried;
  }

  /// With as many sweeps of the batch engine's solver as the robot's file will ask for.
  static std::vector<std::string> odd_pose_of(robot::RobotSpec robot) {
    const double timestep_s = physics::EngineSettings{}.timestep_s;
    const std::string engine = fastest_engine(robot).engine;
    if (engine == "batch") robot.contact.sweeps = physics::sweeps_advice(robot, timestep_s).better_sweeps;
    return odd_pose(robot, engine, timestep_s);
  }

  static void look_at(const robot::RobotSpec& robot, Faults& faults) {
    for (const std::string& fault : odd_pose_of(robot)) {
      const auto has = [&](const char* word) { return fault.find(word) != std::string::npos; };
      const bool lies =
          has("it lies") || has("it crouches") || has("with no foot") || has("they point along");
      faults.add(lies ? does_not_stand : other_fault, fault);
      faults.lies += lies ? 1 : 0;
    }
    std::vector<std::string> high;
    for (const robot::Leg& leg : robot.legs)
      if (robot::foot_bottom_m(robot, leg, robot::start_poses(robot)) >
          in_the_air * robot::leg_height_m(robot))
        high.push_back(leg.name);
    if (!high.empty())
      faults.add(leg_in_the_air, fmt::format("feet start in the air: {}", fmt::join(high, ", ")));
  }

  const morphology::ModelFile& model_file_;
  const fs::path& model_;
  const fs::path& file_;
  const morphology::ModelParts* before_ = nullptr;  ///< of the first try
};

}  // namespace

NewRobot make_new_robot(const morphology::ModelFile& model_file, const fs::path& model,
                        const fs::path& file) {
  return RobotMaker(model_file, model, file).make();
}

EngineChoice fastest_engine(const robot::RobotSpec& robot) {
  try {
    physics::make_engine("batch", robot, {.timestep_s = 0.01});
    return {"batch", ""};
  } catch (const UserError& error) {
    const bool by_model_alone =
        robot.original &&
        std::ranges::any_of(robot.joints, [](const robot::Joint& joint) { return joint.servo.hold_torque; });
    return {by_model_alone ? "mujoco-model" : "ode", error.what()};
  }
}

}  // namespace amble::experiment
