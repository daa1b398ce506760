#include "amble/controllers/oscillators.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/lanes.hpp"

namespace amble::controllers {
namespace {

/// What a batch knows of its architecture.
struct OscillatorRobot {
  std::vector<int> joints, legs;
  std::vector<JointRange> ranges;
  std::vector<std::pair<int, float>> held_rad;
  std::vector<std::string> leg_names;
};

const OscillatorParameters& own(const Parameters& parameters) {
  const auto* const oscillators = dynamic_cast<const OscillatorParameters*>(&parameters);
  AMBLE_CHECK(oscillators != nullptr, "the parameters belong to another architecture");
  return *oscillators;
}

class OscillatorBatch final : public Batch {
 public:
  OscillatorBatch(OscillatorRobot robot, PhaseReset reset, int lanes)
      : robot_(std::move(robot)),
        reset_(reset),
        lanes_(lanes),
        swing_(to_index(lanes)),
        stance_(to_index(lanes)),
        amplitude_(joints(), lanes),
        shift_(joints(), lanes),
        offset_(joints(), lanes),
        phase_(joints(), lanes),
        in_air_(static_cast<int>(robot_.leg_names.size()), lanes),
        landed_(static_cast<int>(robot_.leg_names.size()), lanes) {}

  int lanes() const override { return lanes_; }

  void load(int lane, const Parameters& parameters) override {
    AMBLE_CHECK(lane >= 0 && lane < lanes_, "there is no such lane");
    const OscillatorParameters& walker = own(parameters);
    AMBLE_CHECK(static_cast<int>(walker.amplitude_rad.size()) == joints(), "parameters of another robot");
    swing_[to_index(lane)] = walker.swing_turns;
    stance_[to_index(lane)] = walker.stance_turns;
    for (int joint = 0; joint < joints(); ++joint) {
      amplitude_.at(joint, lane) = walker.amplitude_rad[to_index(joint)];
      shift_.at(joint, lane) = walker.phase_turns[to_index(joint)];
      offset_.at(joint, lane) = walker.offset_rad[to_index(joint)];
    }
    phase_.set_lane(lane, 0.0f);
    in_air_.set_lane(lane, 0.0f);
    landed_.set_lane(lane, 0.0f);
  }

  void step(const robot::SensorFrame& sensors, LaneArray& targets_rad) override {
    AMBLE_CHECK(targets_rad.lanes() == lanes_ && sensors.touch.lanes() == lanes_, "as many lanes");
    for (int leg = 0; leg < in_air_.rows(); ++leg) feel(leg, sensors.touch.row(leg));
    for (int joint = 0; joint < joints(); ++joint)
      swing(joint, targets_rad.row(robot_.joints[to_index(joint)]));
    for (const auto& [joint, target_rad] : robot_.held_rad)
      std::fill_n(targets_rad.row(joint), lanes_, target_rad);
  }

  std::vector<std::string> state_names() const override {
    std::vector<std::string> names{"phase"};
    if (reset_ == PhaseReset::touch)
      for (const std::string& leg : robot_.leg_names) names.push_back("trigger." + leg);
    return names;
  }
  void state(int lane, std::span<float> values) const override {
    values[0] = phase_.at(0, lane);
    if (reset_ == PhaseReset::touch)
      for (int leg = 0; leg < landed_.rows(); ++leg) values[to_index(leg) + 1] = landed_.at(leg, lane);
  }
  std::vector<std::size_t> events() const override {
    std::vector<std::size_t> triggers;
    if (reset_ == PhaseReset::touch)
      for (std::size_t leg = 0; leg < robot_.leg_names.size(); ++leg) triggers.push_back(leg + 1);
    return triggers;
  }

 private:
  int joints() const { return static_cast<int>(robot_.joints.size()); }

  void feel(int leg, const float* touch) {
    float* const in_air = in_air_.row(leg);
    float* const landed = landed_.row(leg);
    for (int lane = 0; lane < lanes_; ++lane) {
      landed[lane] = touch[lane] > 0.5f && in_air[lane] > 0.5f ? 1.0f : 0.0f;
      in_air[lane] = touch[lane] > 0.5f ? 0.0f : 1.0f;
    }
  }

  void swing(int joint, float* targets_rad) {
    const JointRange range = robot_.ranges[to_index(joint)];
    const auto lower = static_cast<float>(range.lower_rad), upper = static_cast<float>(range.upper_rad);
    const float* const landed = landed_.row(robot_.legs[to_index(joint)]);
    const bool resets = reset_ == PhaseReset::touch;
    float* const phase = phase_.row(joint);
    const float* const amplitude = amplitude_.row(joint);
    const float* const shift = shift_.row(joint);
    const float* const offset = offset_.row(joint);
    for (int lane = 0; lane < lanes_; ++lane) {
      const float now = resets && landed[lane] > 0.5f ? 0.0f : phase[lane];
      const float turned = now + shift[lane];
      const float sine = sine_of_turns(turned >= 1.0f ? turned - 1.0f : turned);
      targets_rad[lane] = std::clamp(offset[lane] + amplitude[lane] * sine, lower, upper);
      const float next = now + (sine > 0.0f ? swing_[to_index(lane)] : stance_[to_index(lane)]);
      phase[lane] = next >= 1.0f ? next - 1.0f : next;
    }
  }

  OscillatorRobot robot_;
  PhaseReset reset_;
  int lanes_;
  std::vector<float> swing_, stance_;
  LaneArray amplitude_, shift_, offset_, phase_;  ///< joints × lanes; phases in turns, [0, 1)
  LaneArray in_air_, landed_;                     ///< legs × lanes: in the last tick, in this one
};

}  // namespace

OscillatorArchitecture::OscillatorArchitecture(const OscillatorSettings& settings,
                                               const robot::RobotSpec& robot, double timestep_s)
    : settings_(settings), timestep_s_(timestep_s), outputs_{"swing_frequency", "stance_frequency"} {
  if (settings.least_frequency_hz > settings.most_frequency_hz)
    fail_setting({"controller.oscillators.least_frequency_hz", "controller.oscillators.most_frequency_hz"},
                 "controller.oscillators.least_frequency_hz = {}: expected at most most_frequency_hz = {}",
                 settings.least_frequency_hz, settings.most_frequency_hz);
  if (settings.most_frequency_hz * timestep_s > 0.5)
    fail_setting(
        {"controller.oscillators.most_frequency_hz", "trial.timestep_s"},
        "controller.oscillators.most_frequency_hz = {}: expected at most half a turn a tick of {} s, {}",
        settings.most_frequency_hz, timestep_s, 0.5 / timestep_s);
  const std::vector<JointRange> ranges = joint_ranges(robot);
  std::vector<bool> driven(robot.joints.size(), false);
  for (std::size_t leg = 0; leg < robot.legs.size(); ++leg) {
    leg_names_.push_back(robot.legs[leg].name);
    for (const int joint : robot.legs[leg].joints) {
      if (joint < 0) continue;
      driven[to_index(joint)] = true;
      joints_.push_back(joint);
      legs_.push_back(static_cast<int>(leg));
      ranges_.push_back(ranges[to_index(joint)]);
      joint_names_.push_back(robot.joints[to_index(joint)].name);
    }
  }
  if (joints_.empty()) fail_setting({"robot"}, "oscillators: the robot has no leg with a joint");
  for (std::size_t joint = 0; joint < robot.joints.size(); ++joint)
    if (!driven[joint]) held_rad_.emplace_back(static_cast<int>(joint), held_target_rad(robot.joints[joint]));
  for (const std::string& joint : joint_names_)
    for (const char* what : {"amplitude", "phase", "offset"}) outputs_.push_back(joint + "." + what);
}

std::unique_ptr<Parameters> OscillatorArchitecture::decode(const cppn::Network& network) const {
  const cppn::Points nowhere(0, 1);
  std::vector<float> results(outputs_.size() * to_index(nowhere.capacity()));
  network.evaluate(nowhere, results);
  // 0 to 1 for an output of −1 to 1.
  const auto share = [&](std::size_t output) {
    return std::clamp((static_cast<double>(results[output * to_index(nowhere.capacity())]) + 1.0) * 0.5, 0.0,
                      1.0);
  };
  const auto turns_a_tick = [&](std::size_t output) {
    const double hz = settings_.least_frequency_hz +
                      (settings_.most_frequency_hz - settings_.least_frequency_hz) * share(output);
    return static_cast<float>(hz * timestep_s_);
  };
  auto walker = std::make_unique<OscillatorParameters>();
  walker->swing_turns = turns_a_tick(0);
  walker->stance_turns = turns_a_tick(1);
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    const double half_rad = (ranges_[joint].upper_rad - ranges_[joint].lower_rad) * 0.5;
    walker->amplitude_rad.push_back(static_cast<float>(half_rad * share(2 + 3 * joint)));
    walker->phase_turns.push_back(static_cast<float>(share(3 + 3 * joint)));
    walker->offset_rad.push_back(ranges_[joint].at(share(4 + 3 * joint)));
  }
  return walker;
}

std::unique_ptr<Batch> OscillatorArchitecture::make_batch(int lanes) const {
  return std::make_unique<OscillatorBatch>(OscillatorRobot{joints_, legs_, ranges_, held_rad_, leg_names_},
                                           settings_.reset, lanes);
}

std::string OscillatorArchitecture::parameters_json(const Parameters& parameters) const {
  const OscillatorParameters& walker = own(parameters);
  return nlohmann::ordered_json{{"kind", name()},
                                {"timestep_s", timestep_s_},
                                {"reset", phase_reset_names[to_index(settings_.reset)]},
                                {"legs", leg_names_},
                                {"joints", joint_names_},
                                {"swing_turns_per_tick", walker.swing_turns},
                                {"stance_turns_per_tick", walker.stance_turns},
                                {"amplitude_rad", walker.amplitude_rad},
                                {"phase_turns", walker.phase_turns},
                                {"offset_rad", walker.offset_rad}}
      .dump();
}

float sine_of_turns(float x) {
  // Into the half turn around 0, then, as sin(π − a) = sin a, into the quarter on each side of it.
  if (x > 0.5f) x -= 1.0f;
  if (x < -0.5f) x += 1.0f;
  if (x > 0.25f) x = 0.5f - x;
  if (x < -0.25f) x = -0.5f - x;
  const float s = x * x;
  // Taylor's series: the next term is 6e−8 at the ends.
  return x *
         (6.28318531f +
          s * (-41.3417022f + s * (81.6052493f + s * (-76.7058598f + s * (42.0586939f + s * -15.0946426f)))));
}

}  // namespace amble::controllers
