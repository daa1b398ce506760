#include "tests/page/synthetic.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "amble/ground/recorded.hpp"
#include "tests/motion/fixture.hpp"

namespace amble::tests {
namespace {

constexpr int legs = 4, joints = 12, period_ticks = 10;
constexpr double turn = 2.0 * std::numbers::pi;

}  // namespace

record::RecordingHeader SyntheticWalk::header() const {
  std::vector<std::string> joint_names, leg_names;
  const auto model = robot();
  for (const auto& joint : model.joints) joint_names.push_back(joint.name);
  for (const auto& leg : model.legs) leg_names.push_back(leg.name);
  auto columns = record::standard_columns(joint_names, leg_names);
  for (const char* state : {"timer.", "trigger."})
    for (const auto& leg : leg_names) columns.push_back(state + leg);
  return {.frame_s = frame_s,
          .columns = columns,
          .robot_json = robot_json(),
          .controller_json = supg_json(),
          .origin = "a made-up walk",
          .ground_json = uneven ? ground::to_json(hills(), {}).dump() : std::string()};
}

ground::Settings SyntheticWalk::hills() {
  ground::Settings settings;
  settings.kind = "hills";
  settings.height_m = 0.3;
  return settings;
}

std::vector<float> SyntheticWalk::frame(int k) const {
  std::minstd_rand noise(static_cast<unsigned>(k) + 1u);
  const auto jitter = [&] { return 1e-3 * (static_cast<double>(noise()) / noise.max() - 0.5); };
  const double t = (k + 1) * frame_s;
  const double x = speed_m_s * t + jitter(), y = 0.05 * std::sin(0.3 * t) + jitter();
  const double yaw = 0.1 * std::sin(0.2 * t) + jitter();
  std::vector<float> row;
  const auto put = [&](double value) { row.push_back(static_cast<float>(value)); };
  for (const double value :
       {x, y, 0.87 + jitter(), std::cos(yaw / 2), 0.0, 0.0, std::sin(yaw / 2), x, y, 0.8 + jitter()})
    put(value);
  const auto phase = [&](int leg) { return t + (leg == 1 || leg == 2 ? 0.5 : 0.0); };
  for (int joint = 0; joint < joints; ++joint)
    put(0.2 * std::sin(turn * phase(joint / 3) + joint % 3) + (joint < 6 ? -0.2 : 0.2) + jitter());
  for (int joint = 0; joint < joints; ++joint)
    put(joint * 0.01 + std::fmod(phase(joint / 3), 1.0) * period_ticks * 0.001);
  for (int leg = 0; leg < legs; ++leg) {
    const double stride = std::fmod(phase(leg), 1.0);
    const bool chatter = chatters && std::abs(std::fmod(stride, 0.5) - 0.25) < 0.015;
    put(touches && (stride < 0.5) != chatter);
  }
  for (int leg = 0; leg < legs; ++leg) put(std::floor(std::fmod(phase(leg), 1.0) * period_ticks));
  for (int leg = 0; leg < legs; ++leg) put(touches && k > 0 && std::fmod(phase(leg), 1.0) < frame_s);
  return row;
}

void SyntheticWalk::write(const std::filesystem::path& path) const {
  record::RecordingWriter writer(path, header());
  for (int k = 0; k < frames; ++k) writer.add(frame(k));
  writer.finish(outcome);
}

}  // namespace amble::tests
