#include "amble/substrate/sensor.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "amble/core/error.hpp"

namespace amble::substrate {
namespace {

template <typename Items>
int index_of(const Items& items, std::string_view name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return found == items.end() ? -1 : static_cast<int>(found - items.begin());
}

}  // namespace

Sensor parse_sensor(std::string_view name, const robot::RobotSpec& robot, const std::string& key) {
  using Kind = Sensor::Kind;
  constexpr std::array<std::pair<std::string_view, Kind>, 4> plain{
      {{"roll", Kind::roll}, {"pitch", Kind::pitch}, {"yaw", Kind::yaw}, {"sine", Kind::sine}}};
  for (const auto& [word, kind] : plain)
    if (name == word) return {kind, 0};

  const std::size_t dot = name.find('.');
  const std::string_view what = name.substr(0, dot);
  if (dot == std::string_view::npos || (what != "angle" && what != "touch"))
    fail_setting({key}, "{} = \"{}\": expected angle.JOINT, touch.LEG, roll, pitch, yaw or sine", key, name);
  const std::string_view owner = name.substr(dot + 1);
  const int index = what == "angle" ? index_of(robot.joints, owner) : index_of(robot.legs, owner);
  if (index < 0)
    fail_setting({key}, "{} = \"{}\": the robot has no {} {}", key, name, what == "angle" ? "joint" : "leg",
                 owner);
  return {what == "angle" ? Kind::angle : Kind::touch, index};
}

}  // namespace amble::substrate
