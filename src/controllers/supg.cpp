#include "amble/controllers/supg.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "amble/controllers/supg_batch.hpp"
#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::controllers {

SupgParameters::SupgParameters(int legs, int types, int period_ticks)
    : legs_(legs),
      types_(types),
      period_ticks_(period_ticks),
      offset_ticks_(static_cast<std::size_t>(legs), 1),
      targets_rad_(static_cast<std::size_t>(legs * (period_ticks + 2) * types)) {}

namespace {

SupgJoints joints_of(const robot::RobotSpec& robot) {
  SupgJoints joints;
  for (const robot::Leg& leg : robot.legs)
    joints.of_legs.insert(joints.of_legs.end(), leg.joints.begin(), leg.joints.end());
  for (std::size_t joint = robot.leg_joint_count(); joint < robot.joints.size(); ++joint)
    joints.others.push_back({static_cast<int>(joint), held_target_rad(robot.joints[joint])});
  return joints;
}

}  // namespace

SupgArchitecture::SupgArchitecture(const SupgSettings& settings, const substrate::Settings& substrate,
                                   const robot::RobotSpec& robot, double timestep_s)
    : settings_(settings),
      timestep_s_(timestep_s),
      period_ticks_(controllers::period_ticks(settings, timestep_s)),
      joint_types_(robot.joint_types),
      joints_(joints_of(robot)),
      ranges_(joint_ranges(robot)),
      layout_(substrate,
              {.kind = "supg",
               .network = false,
               .properties = {std::string(substrate::pattern_property), std::string(offset_property)},
               .pattern_ticks = period_ticks_},
              robot) {
  for (const robot::Leg& leg : robot.legs) leg_names_.push_back(leg.name);
  for (int leg = 0; leg < legs(); ++leg) {
    const int first = first_driver(leg);
    for (int type = 0; type < types(); ++type) {
      const int other = driver(leg, type);
      if (other < 0 || layout_.shared(offset_property, first, other)) continue;
      const auto& nodes = layout_.nodes();
      fail_setting(
          {"controller.substrate.properties"},
          "controller.substrate.properties: \"{}\" and \"{}\" are SUPGs of leg {} but could get different "
          "offsets: name in 'zero' the coordinates that tell them apart",
          nodes[to_index(first)].name, nodes[to_index(other)].name, leg_names_[to_index(leg)]);
    }
  }
}

int SupgArchitecture::first_driver(int leg) const {
  for (int type = 0; type < types(); ++type)
    if (driver(leg, type) >= 0) return driver(leg, type);
  return -1;
}

SupgParameters SupgArchitecture::blank() const {
  SupgParameters parameters(legs(), types(), period_ticks_);
  for (int leg = 0; leg < legs(); ++leg)
    for (int timer = SupgParameters::stopped; timer <= period_ticks_; ++timer)
      for (int type = 0; type < types(); ++type)
        if (const int j = joint(leg, type); j >= 0)
          parameters.targets_rad(leg, timer)[type] = ranges_[to_index(j)].at(0.5);
  return parameters;
}

std::unique_ptr<Parameters> SupgArchitecture::decode(const cppn::Network& network) const {
  const substrate::Decoded decoded = layout_.decode(network);
  const auto offsets = decoded.of(offset_property);
  auto parameters = std::make_unique<SupgParameters>(blank());
  for (int leg = 0; leg < legs(); ++leg) {
    if (first_driver(leg) < 0) continue;
    const auto a = static_cast<double>(offsets[to_index(first_driver(leg))]);
    const double ticks = std::ceil((a + 1.0) * 0.5 * period_ticks_);
    parameters->set_offset_ticks(leg, static_cast<int>(std::clamp(ticks, 1.0, period_ticks_ - 1.0)));
    for (int type = 0; type < types(); ++type) {
      if (driver(leg, type) < 0) continue;
      const JointRange& range = ranges_[to_index(joint(leg, type))];
      const float* const pattern =
          decoded.patterns.data() + static_cast<std::ptrdiff_t>(driver(leg, type)) * (period_ticks_ + 1);
      for (int tick = 0; tick <= period_ticks_; ++tick) {
        const auto p = static_cast<double>(pattern[tick]);
        parameters->targets_rad(leg, tick)[type] = range.at(std::clamp((p + 1.0) * 0.5, 0.0, 1.0));
      }
    }
  }
  return parameters;
}

std::unique_ptr<Batch> SupgArchitecture::make_batch(int lanes) const {
  return std::make_unique<SupgBatch>(settings_, leg_names_, joints_, blank(), lanes);
}

std::string SupgArchitecture::parameters_json(const Parameters& parameters) const {
  const auto* const supg = dynamic_cast<const SupgParameters*>(&parameters);
  AMBLE_CHECK(supg != nullptr, "the parameters are not a SUPG's");
  nlohmann::ordered_json json{{"kind", name()},
                              {"period_ticks", period_ticks_},
                              {"period_s", settings_.period_s},
                              {"timestep_s", timestep_s_},
                              {"trigger", trigger_names[static_cast<std::size_t>(settings_.trigger)]},
                              {"trigger_debounce_ticks", settings_.trigger_debounce_ticks},
                              {"offset", offset_names[static_cast<std::size_t>(settings_.offset)]},
                              {"start_tick", settings_.start_tick},
                              {"idle", idle_names[static_cast<std::size_t>(settings_.idle)]},
                              {"legs", leg_names_},
                              {"joint_types", joint_types_},
                              {"offset_ticks", nlohmann::ordered_json::array()},
                              {"patterns_rad", nlohmann::ordered_json::array()}};
  for (int leg = 0; leg < legs(); ++leg) {
    json["offset_ticks"].push_back(supg->offset_ticks(leg));
    for (int type = 0; type < types(); ++type) {
      if (joint(leg, type) < 0) continue;
      auto& pattern = json["patterns_rad"].emplace_back(nlohmann::ordered_json::array());
      for (int tick = 0; tick <= period_ticks_; ++tick) pattern.push_back(supg->targets_rad(leg, tick)[type]);
    }
  }
  return json.dump();
}

}  // namespace amble::controllers
