#include "amble/motion/supg_patterns.hpp"

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "amble/io/json_file.hpp"

namespace amble::motion {
namespace {

using io::JsonView;

bool read_starts_at_offset(const JsonView& json) {
  const std::string name = json.text();
  if (name == "phase") return true;
  if (name == "delay") return false;
  json.bad("phase or delay");
}

std::int64_t read_period_ticks(const JsonView& json) {
  const std::int64_t ticks = json.integer();
  if (ticks < 1 || ticks > 1'000'000) json.bad("a whole number from 1 to 1000000");
  return ticks;
}

int read_offset_ticks(const JsonView& json) {
  const std::int64_t ticks = json.integer();
  if (std::abs(ticks) > 1'000'000) json.bad("a whole number from -1000000 to 1000000");
  return static_cast<int>(ticks);
}

double read_timestep_s(const JsonView& json) {
  const double timestep_s = json.number();
  if (!(timestep_s > 0.0) || !std::isfinite(timestep_s)) json.bad("a number above 0");
  return timestep_s;
}

std::vector<double> read_pattern(const JsonView& json, int period_ticks) {
  if (json.size() != static_cast<std::size_t>(period_ticks) + 1)
    json.bad("a number for each tick from 0 to period_ticks");
  std::vector<double> pattern;
  for (std::size_t tick = 0; tick < json.size(); ++tick) {
    pattern.push_back(json.at(tick).number());
    if (!std::isfinite(pattern.back())) json.at(tick).bad("a finite number");
  }
  return pattern;
}

}  // namespace

SupgPatterns parse_supg(const std::string& controller_json, const robot::RobotSpec& robot,
                        const std::string& what) {
  const io::Json document = io::parse_json(controller_json, what);
  const JsonView json(document, what);
  SupgPatterns supg;
  supg.period_ticks = static_cast<int>(read_period_ticks(json.at("period_ticks")));
  supg.timestep_s = read_timestep_s(json.at("timestep_s"));
  supg.starts_at_offset = read_starts_at_offset(json.at("offset"));
  const JsonView offsets = json.at("offset_ticks");
  if (offsets.size() != robot.legs.size()) offsets.bad("a number for each leg");
  for (std::size_t leg = 0; leg < offsets.size(); ++leg)
    supg.offset_ticks.push_back(read_offset_ticks(offsets.at(leg)));
  const JsonView patterns = json.at("patterns_rad");
  if (patterns.size() != robot.leg_joint_count()) patterns.bad("a list for each joint of a leg");
  for (std::size_t joint = 0; joint < patterns.size(); ++joint)
    supg.patterns_rad.push_back(read_pattern(patterns.at(joint), supg.period_ticks));
  return supg;
}

}  // namespace amble::motion
