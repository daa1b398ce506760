#include "amble/exporting/mixed_tables.hpp"

#include "amble/core/index.hpp"

namespace amble::exporting {
namespace {

using controllers::MixedNet;
using controllers::MixedParameters;

/// Links of weight 0 are left out; they change no sum.
std::vector<WeightedLink> expressed(const MixedNet::Sum& sum, const MixedParameters& parameters) {
  std::vector<WeightedLink> links;
  for (const MixedNet::Link& link : sum.links)
    if (const float weight = parameters.weights[to_index(link.index)]; weight != 0.0f)
      links.push_back({link.source, weight});
  return links;
}

/// As controllers::MixedBatch has them.
std::vector<std::vector<WeightedLink>> pulls(const MixedNet& net, const MixedParameters& parameters) {
  const int legs = static_cast<int>(net.rates.size());
  std::vector<std::vector<WeightedLink>> all(to_index(2 * legs));
  for (const bool sine : {true, false})
    for (std::size_t k = 0; k < net.couplings.size(); ++k) {
      const auto& [leg, other, index] = net.couplings[k];
      auto& links = all[to_index(sine ? leg : legs + leg)];
      const float in = parameters.in_phase[k], out = parameters.out_of_phase[k];
      links.push_back({other, sine ? in : out});
      links.push_back({legs + other, sine ? -out : in});
    }
  return all;
}

}  // namespace

SupgTables::Mixed mixed_tables(const controllers::MixedArchitecture& architecture,
                               const controllers::MixedParameters& parameters,
                               const robot::RobotSpec& robot) {
  const MixedNet& net = architecture.net();
  SupgTables::Mixed mixed{.sensors = net.sensors, .sensor_names = net.sensor_names};
  const std::vector<std::string> names = architecture.neuron_names();
  for (std::size_t n = 0; n < names.size(); ++n)
    mixed.neurons.push_back({.name = names[n],
                             .bias = parameters.biases[n],
                             .step = parameters.steps[n],
                             .links = expressed(net.hidden[n], parameters)});
  for (const MixedNet::Sum& sum : net.rates) mixed.rates.push_back(expressed(sum, parameters));
  if (!net.couplings.empty()) mixed.pulls = pulls(net, parameters);
  mixed.amplitudes.resize(robot.joints.size());
  mixed.shifts.resize(robot.joints.size());
  std::vector<int> joint_of;  // SUPG by SUPG
  for (const robot::Leg& leg : robot.legs)
    joint_of.insert(joint_of.end(), leg.joints.begin(), leg.joints.end());
  const auto ranges = controllers::joint_ranges(robot);
  for (const controllers::JointRange& range : ranges)
    mixed.ranges_rad.push_back({static_cast<float>(0.5 * (range.lower_rad + range.upper_rad)),
                                static_cast<float>(0.5 * (range.upper_rad - range.lower_rad))});
  for (std::size_t supg = 0; supg < joint_of.size(); ++supg) {
    if (joint_of[supg] < 0) continue;
    mixed.amplitudes[to_index(joint_of[supg])] = expressed(net.amplitudes[supg], parameters);
    mixed.shifts[to_index(joint_of[supg])] = expressed(net.shifts[supg], parameters);
  }
  for (const int supg : net.listened) {
    const int joint = joint_of[to_index(supg)];
    const double width_rad = ranges[to_index(joint)].upper_rad - ranges[to_index(joint)].lower_rad;
    mixed.listened.push_back({joint, static_cast<float>(width_rad > 0.0 ? 2.0 / width_rad : 0.0)});
  }
  return mixed;
}

}  // namespace amble::exporting
