#include "amble/damage/settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::damage {
namespace {

constexpr double most_m = 100.0, most_kg = 1e6, least_kg = 1e-9, most_rad = 1000.0;

/// Checks one part of the list.
class PartCheck {
 public:
  PartCheck(const robot::RobotSpec& robot, const Part& part, std::size_t index)
      : robot_(robot), part_(part), prefix_(fmt::format("damage.parts[{}].", index)) {}

  void check() const {
    const bool of_leg = part_.kind == Kind::missing || part_.kind == Kind::numb;
    const bool of_body = part_.kind == Kind::payload;
    check_name("leg", part_.leg, of_leg, robot_.legs);
    check_name("joint", part_.joint, !of_leg && !of_body, robot_.joints);
    if (!of_body || !part_.body.empty()) check_name("body", part_.body, of_body, robot_.bodies);
    if (part_.kind == Kind::locked) check_angle();
    if (part_.kind == Kind::slack || part_.kind == Kind::weak) check_motor();
    if (part_.kind == Kind::missing) check_removable();
  }

 private:
  template <typename... Args>
  [[noreturn]] void bad(std::string_view key, fmt::format_string<Args...> text, Args&&... args) const {
    fail_setting({prefix_ + std::string(key)}, "{}{}{}", prefix_, key,
                 fmt::format(text, std::forward<Args>(args)...));
  }

  template <typename Item>
  void check_name(std::string_view key, const std::string& name, bool needed,
                  const std::vector<Item>& items) const {
    const std::string_view kind = kind_names[static_cast<std::size_t>(part_.kind)];
    if (!needed && !name.empty()) bad(key, " = \"{}\": the kind {} has no {}", name, kind, key);
    if (!needed || std::ranges::find(items, name, &Item::name) != items.end()) return;
    std::vector<std::string> names;
    names.reserve(items.size());
    for (const Item& item : items) names.push_back(item.name);
    bad(key, " = \"{}\": the robot has no such {}; expected one of {}", name, key, fmt::join(names, ", "));
  }

  void check_angle() const {
    const auto& joint = *std::ranges::find(robot_.joints, part_.joint, &robot::Joint::name);
    if (part_.angle_rad < joint.lower_rad || part_.angle_rad > joint.upper_rad)
      bad("angle_rad", " = {}: joint '{}' turns from {} to {} rad", part_.angle_rad, joint.name,
          joint.lower_rad, joint.upper_rad);
  }

  void check_motor() const {
    const auto& joint = *std::ranges::find(robot_.joints, part_.joint, &robot::Joint::name);
    if (!joint.has_motor())
      bad("joint", " = \"{}\": it has no motor that could be {}", part_.joint,
          kind_names[static_cast<std::size_t>(part_.kind)]);
  }

  void check_removable() const {
    const auto leg =
        static_cast<int>(std::ranges::find(robot_.legs, part_.leg, &robot::Leg::name) - robot_.legs.begin());
    const int foot = robot_.foot_body(robot_.legs[to_index(leg)]);
    bool own = robot_.leg_of_body(foot) == leg;
    for (const int joint : robot_.legs[to_index(leg)].joints)
      own = own && (joint < 0 || robot_.leg_of_body(robot_.joints[to_index(joint)].body) == leg);
    if (!own)
      bad("leg", " = \"{}\": its bodies carry other legs or the trunk, so it cannot be missing", part_.leg);
  }

  const robot::RobotSpec& robot_;
  const Part& part_;
  std::string prefix_;
};

}  // namespace

void Part::describe(io::SettingsVisitor& visitor) {
  visitor.choice("kind", kind, kind_names, {"what is wrong"});
  visitor.text("leg", leg, {"missing, numb: name of the leg"});
  visitor.text("joint", joint, {"locked, slack, weak: name of the joint"});
  visitor.text("body", body, {"payload: name of the body that carries it; empty: the root"});
  visitor.number("angle_rad", angle_rad, {-most_rad, most_rad},
                 {"locked: the angle at which the joint is held, from the start pose, rad"});
  visitor.number("share", share, {0.0, 1.0}, {"weak: of the motor's largest torque"});
  visitor.number("mass_kg", mass_kg, {least_kg, most_kg}, {"payload: a point mass, kg"});
  visitor.number("x_m", x_m, {-most_m, most_m}, {"payload: where it is in the body's frame, m"});
  visitor.number("y_m", y_m, {-most_m, most_m}, {"payload: the same along y"});
  visitor.number("z_m", z_m, {-most_m, most_m}, {"payload: the same along z"});
  visitor.number("from_s", from_s, {0.0, 1e9}, {"since when, from the beginning of the trial, s"});
}

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.tables("parts", parts, {"all that is wrong"});
}

void Settings::validate(const robot::RobotSpec& robot) const {
  for (std::size_t i = 0; i < parts.size(); ++i) PartCheck(robot, parts[i], i).check();
  const auto gone = [this](const robot::Leg& leg) {
    return std::ranges::any_of(
        parts, [&](const Part& part) { return part.kind == Kind::missing && part.leg == leg.name; });
  };
  if (!robot.legs.empty() && std::ranges::all_of(robot.legs, gone))
    fail_setting({"damage.parts"}, "damage.parts: no leg is left; expected at least one that is not missing");
}

bool Settings::changes_body() const {
  return std::ranges::any_of(parts, [](const Part& part) { return part.kind != Kind::numb; });
}

}  // namespace amble::damage
