#include "amble/score/behaviour.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"
#include "amble/core/index.hpp"

namespace amble::score {
namespace {

/// A mean over legs is not circular.
Circle circle_of(const Quantity& quantity, bool of_one_leg) {
  if (!quantity.circular || (quantity.of_legs && !of_one_leg)) return {};
  return {.lowest = quantity.range.lowest, .turn = quantity.range.highest - quantity.range.lowest};
}

/// Of a circular quantity the short way round from the first one.
double mean_of(std::span<const double> values, const Circle& circle) {
  double sum = 0.0;
  for (const double value : values) sum += circle.nearest(value, values.front());
  return circle.inside(sum / static_cast<double>(values.size()));
}

class NoBehaviour final : public Behaviour {
 public:
  explicit NoBehaviour(const BehaviourSettings&) {}
  std::size_t length() const override { return 0; }
  std::vector<float> of(std::span<const record::Trajectory>) const override { return {}; }
};

template <typename Kind>
std::unique_ptr<const Behaviour> make(const BehaviourSettings& settings) {
  return std::make_unique<Kind>(settings);
}

struct Row {
  std::string_view name;
  std::unique_ptr<const Behaviour> (*make)(const BehaviourSettings&);
};
constexpr std::array behaviours{Row{"", make<NoBehaviour>}, Row{"path", make<PathBehaviour>},
                                Row{"descriptors", make<DescriptorBehaviour>}};

}  // namespace

PathBehaviour::PathBehaviour(const BehaviourSettings& settings)
    : path_(settings.path), length_(2 * to_index(settings.path.count(settings.steps))) {}

std::vector<float> PathBehaviour::of(std::span<const record::Trajectory> episodes) const {
  AMBLE_CHECK(!episodes.empty(), "an evaluation has an episode");
  const record::Trajectory& trajectory = episodes.front();
  AMBLE_CHECK(trajectory.com_path_m.size() <= length_, "paths are no longer than trials");
  std::vector<float> behaviour = trajectory.com_path_m;
  behaviour.reserve(length_);
  const Vec3 moved = trajectory.com_end_m - trajectory.com_start_m;
  while (behaviour.size() < length_) {
    behaviour.push_back(static_cast<float>(moved.x));
    behaviour.push_back(static_cast<float>(moved.y));
  }
  return behaviour;
}

DescriptorBehaviour::DescriptorBehaviour(const BehaviourSettings& settings)
    : score_(settings.score), duration_s_(settings.duration_s), weight_n_(settings.weight_n) {
  const std::string key = "search.map_elites.descriptors";
  for (const Descriptor& descriptor : settings.descriptors) {
    const Quantity& named = quantity(descriptor.quantity, key);
    Dimension& dimension = dimensions_.emplace_back(
        Dimension{.quantity = &named, .leg = -1, .circle = circle_of(named, !descriptor.leg.empty())});
    if (descriptor.leg.empty()) continue;
    if (!dimension.quantity->of_legs)
      fail_setting({key}, "{}: {}: leg = \"{}\": it is a quantity of the whole robot", key,
                   descriptor.quantity, descriptor.leg);
    if (settings.leg_names.empty()) continue;
    const auto leg = std::ranges::find(settings.leg_names, descriptor.leg);
    if (leg == settings.leg_names.end())
      fail_setting({key}, "{}: {}: leg = \"{}\": the robot has {}", key, descriptor.quantity, descriptor.leg,
                   fmt::join(settings.leg_names, ", "));
    dimension.leg = static_cast<int>(leg - settings.leg_names.begin());
  }
}

record::Measures DescriptorBehaviour::measures() const {
  record::Measures all;
  for (const Dimension& dimension : dimensions_) all |= dimension.quantity->measures;
  return all;
}

std::vector<Circle> DescriptorBehaviour::circles() const {
  std::vector<Circle> all;
  for (const Dimension& dimension : dimensions_) all.push_back(dimension.circle);
  return all;
}

std::vector<float> DescriptorBehaviour::of(std::span<const record::Trajectory> episodes) const {
  AMBLE_CHECK(!episodes.empty(), "an evaluation has an episode");
  std::vector<float> means;
  means.reserve(dimensions_.size());
  for (const Dimension& dimension : dimensions_) {
    const Context context{
        .settings = score_, .duration_s = duration_s_, .weight_n = weight_n_, .leg = dimension.leg};
    std::vector<double> values;
    for (const record::Trajectory& episode : episodes)
      values.push_back(dimension.quantity->of(episode, context));
    means.push_back(static_cast<float>(mean_of(values, dimension.circle)));
  }
  return means;
}

std::unique_ptr<const Behaviour> make_behaviour(std::string_view name, const BehaviourSettings& settings) {
  const auto row = std::ranges::find(behaviours, name, &Row::name);
  AMBLE_CHECK(row != behaviours.end(), "a behaviour of the table");
  return row->make(settings);
}

}  // namespace amble::score
