#include "amble/morphology/odd_joints.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"

namespace amble::morphology {
namespace {

constexpr double tiny_share = 1e-4;
/// A leg is a pendulum of sqrt(g / length) rad/s; a walker's joints turn at about that.
constexpr double slow_share = 0.25;

}  // namespace

std::vector<std::string> joints_of_tiny_links(const ModelParts& parts, const std::vector<int>& joints) {
  std::vector<double> behind_kg;  // of each body and all that hang on it
  behind_kg.reserve(parts.bodies.size());
  for (const robot::Body& body : parts.bodies) behind_kg.push_back(body.mass_kg);
  for (std::size_t b = parts.bodies.size(); b-- > 1;)
    behind_kg[to_index(parts.bodies[b].parent)] += behind_kg[b];
  std::vector<std::string> names;
  for (const int j : joints) {
    const robot::Joint& joint = parts.joints[to_index(j)];
    if (behind_kg[to_index(joint.body)] < tiny_share * behind_kg[0]) names.push_back(joint.name);
  }
  return names;
}

std::string slow_joints(const ModelFile& file, const ModelParts& parts, const std::vector<int>& joints,
                        double leg_length_m) {
  const double usual_rad_s = std::sqrt(norm(parts.gravity_m_s2) / leg_length_m);
  std::vector<std::string> slow;
  for (const int j : joints) {
    const std::string& name = parts.joints[to_index(j)].name;
    const auto hint = file.motors.find(name);
    const bool given = hint != file.motors.end() && !hint->second.is_of_a_template();
    const double limit = given ? hint->second.max_speed_rad_s : 0.0;
    if (limit > 0.0 && limit < slow_share * usual_rad_s)
      slow.push_back(fmt::format("{} ({:.3g})", name, limit));
  }
  if (slow.empty()) return {};
  return fmt::format(
      "limits of speed, rad/s, with which legs of {:.2g} m walk at a crawl, as templates have them: {}; a "
      "walker's "
      "joints turn at about {:.2g} rad/s: check velocity of <limit>",
      leg_length_m, fmt::join(slow, ", "), usual_rad_s);
}

}  // namespace amble::morphology
