// A controller of one's own: every joint swings by a sine, whose amplitude and phase a CPPN paints over
// the robot's joints.
// Use:
//   amble --plugin build/extend/libswing.so evolve examples/extend/swing.toml --out runs/swing
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "amble/controllers/factory.hpp"
#include "amble/core/plugin.hpp"

namespace {

using namespace amble;

struct Swing : controllers::Parameters {
  std::vector<float> amplitude_rad, phase_rad;  // by joint
};

class SwingBatch final : public controllers::Batch {
 public:
  SwingBatch(const std::vector<robot::AngleRange>& ranges, double rate_rad_s, double timestep_s, int lanes)
      : ranges_(ranges),
        step_rad_(static_cast<float>(rate_rad_s * timestep_s)),
        loaded_(lanes, nullptr),
        angle_(lanes) {}

  int lanes() const override { return static_cast<int>(loaded_.size()); }
  void load(int lane, const controllers::Parameters& parameters) override {
    loaded_[lane] = dynamic_cast<const Swing*>(&parameters);
    angle_[lane] = 0.0f;
  }
  void step(const robot::SensorFrame&, LaneArray& targets_rad) override {
    for (int lane = 0; lane < lanes(); ++lane) {
      if (loaded_[lane] == nullptr) continue;
      angle_[lane] += step_rad_;
      for (std::size_t j = 0; j < ranges_.size(); ++j) {
        const float target =
            loaded_[lane]->amplitude_rad[j] * std::sin(angle_[lane] + loaded_[lane]->phase_rad[j]);
        targets_rad.at(static_cast<int>(j), lane) = std::clamp(
            target, static_cast<float>(ranges_[j].lower_rad), static_cast<float>(ranges_[j].upper_rad));
      }
    }
  }
  std::vector<std::string> state_names() const override { return {"swing"}; }
  void state(int lane, std::span<float> values) const override { values[0] = std::sin(angle_[lane]); }

 private:
  std::vector<robot::AngleRange> ranges_;
  float step_rad_;
  std::vector<const Swing*> loaded_;
  std::vector<float> angle_;
};

class SwingArchitecture final : public controllers::Architecture {
 public:
  SwingArchitecture(const robot::RobotSpec& robot, double frequency_hz, double timestep_s)
      : rate_rad_s_(2.0 * 3.14159265358979 * frequency_hz), timestep_s_(timestep_s) {
    // Where a joint is: its leg and its place in the leg, both from -1 to 1.
    for (std::size_t leg = 0; leg < robot.legs.size(); ++leg)
      for (std::size_t type = 0; type < robot.joint_types.size(); ++type) {
        if (robot.legs[leg].joints[type] < 0) continue;
        ranges_.push_back(robot.joints[robot.legs[leg].joints[type]].command_range());
        places_.push_back({scaled(leg, robot.legs.size()), scaled(type, robot.joint_types.size())});
      }
  }

  std::string name() const override { return "swing"; }
  const std::vector<std::string>& cppn_inputs() const override { return inputs_; }
  const std::vector<std::string>& cppn_outputs() const override { return outputs_; }
  std::unique_ptr<controllers::Parameters> decode(const cppn::Network& network) const override {
    const int joints = static_cast<int>(places_.size());
    cppn::Points points(2, joints);
    for (int j = 0; j < joints; ++j)
      for (int input = 0; input < 2; ++input) points.set(j, input, places_[j][input]);
    std::vector<float> painted(2 * points.capacity());
    network.evaluate(points, painted);
    auto swing = std::make_unique<Swing>();
    for (int j = 0; j < joints; ++j) {
      const double reach = std::min(-ranges_[j].lower_rad, ranges_[j].upper_rad);
      swing->amplitude_rad.push_back(static_cast<float>(std::max(reach, 0.0)) *
                                     std::clamp(painted[j], -1.0f, 1.0f));
      swing->phase_rad.push_back(3.14159265f * std::clamp(painted[points.capacity() + j], -1.0f, 1.0f));
    }
    return swing;
  }
  std::unique_ptr<controllers::Batch> make_batch(int lanes) const override {
    return std::make_unique<SwingBatch>(ranges_, rate_rad_s_, timestep_s_, lanes);
  }
  std::string parameters_json(const controllers::Parameters&) const override {
    return R"({"kind": "swing"})";
  }

 private:
  static float scaled(std::size_t i, std::size_t count) {
    return count < 2 ? 0.0f : 2.0f * static_cast<float>(i) / static_cast<float>(count - 1) - 1.0f;
  }

  std::vector<std::string> inputs_{"leg", "joint"}, outputs_{"amplitude", "phase"};
  double rate_rad_s_, timestep_s_;
  std::vector<robot::AngleRange> ranges_;
  std::vector<std::array<float, 2>> places_;
};

}  // namespace

AMBLE_PLUGIN {
  amble::controllers::register_controller(
      {.name = "swing",
       .what = "sines that a CPPN paints (swing)",
       .make = [](const amble::controllers::ControllerSettings& settings,
                  const amble::robot::RobotSpec& robot,
                  double timestep_s) -> std::unique_ptr<const amble::controllers::Architecture> {
         return std::make_unique<SwingArchitecture>(robot, settings.own.numbers.at("frequency_hz"),
                                                    timestep_s);
       },
       .numbers = {
           {.name = "frequency_hz", .value = 1.0, .range = {0.01, 20.0}, .what = "swings per second, Hz"}}});
}
