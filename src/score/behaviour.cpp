#include "amble/score/behaviour.hpp"

#include <algorithm>
#include <array>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"

namespace amble::score {
namespace {

class NoBehaviour final : public Behaviour {
 public:
  explicit NoBehaviour(const BehaviourSettings&) {}
  std::size_t length() const override { return 0; }
  std::vector<float> of(const record::Trajectory&) const override { return {}; }
};

template <typename Kind>
std::unique_ptr<const Behaviour> make(const BehaviourSettings& settings) {
  return std::make_unique<Kind>(settings);
}

struct Row {
  std::string_view name;
  std::unique_ptr<const Behaviour> (*make)(const BehaviourSettings&);
};
constexpr std::array behaviours{Row{"", make<NoBehaviour>}, Row{"path", make<PathBehaviour>}};

}  // namespace

PathBehaviour::PathBehaviour(const BehaviourSettings& settings)
    : path_(settings.path), length_(2 * to_index(settings.path.count(settings.steps))) {}

std::vector<float> PathBehaviour::of(const record::Trajectory& trajectory) const {
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

std::unique_ptr<const Behaviour> make_behaviour(std::string_view name, const BehaviourSettings& settings) {
  const auto row = std::ranges::find(behaviours, name, &Row::name);
  AMBLE_CHECK(row != behaviours.end(), "a behaviour of the table");
  return row->make(settings);
}

}  // namespace amble::score
