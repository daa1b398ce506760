#include "amble/morphology/robot_spec.hpp"

#include <algorithm>

namespace amble::morphology {

double RobotSpec::total_mass_kg() const {
  double mass = 0.0;
  for (const Body& body : bodies) mass += body.mass_kg;
  return mass;
}

std::vector<int> RobotSpec::joints_of_body(int body) const {
  std::vector<int> found;
  for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
    if (joints[static_cast<std::size_t>(j)].body == body) found.push_back(j);
  }
  const auto place = [this](int j) { return joints[static_cast<std::size_t>(j)].chain_index; };
  std::stable_sort(found.begin(), found.end(), [&](int a, int b) { return place(a) < place(b); });
  return found;
}

}  // namespace amble::morphology
