#include "amble/morphology/foot_contact.hpp"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/model_shapes.hpp"

namespace amble::morphology {
namespace {

/// What MuJoCo makes of a foot on the floor of its model.
struct FloorContact {
  int pair = -1;   ///< of which contact has its numbers
  int floor = -1;  ///< a plane that the foot touches; negative: none
  int ahead = 0;   ///< > 0: the foot has the higher priority, < 0: the floor
};

/// A plane that nothing touches is none.
bool is_floor(const mjModel& model, int g) {
  return model.geom_type[g] == mjGEOM_PLANE && model.body_weldid[model.geom_bodyid[g]] == 0 &&
         collides(model, g);
}

bool has_floor(const mjModel& model) {
  for (int g = 0; g < model.ngeom; ++g)
    if (is_floor(model, g)) return true;
  return false;
}

/// By an <exclude> of their bodies.
bool are_excluded(const mjModel& model, int geom, int other) {
  const int a = model.geom_bodyid[geom], b = model.geom_bodyid[other];
  const int signature = (std::min(a, b) << 16) + std::max(a, b);
  return std::find(model.exclude_signature, model.exclude_signature + model.nexclude, signature) !=
         model.exclude_signature + model.nexclude;
}

FloorContact floor_contact(const mjModel& model, int foot) {
  for (int p = 0; p < model.npair; ++p) {
    const int one = model.pair_geom1[p], two = model.pair_geom2[p], other = one == foot ? two : one;
    if ((one == foot || two == foot) && is_floor(model, other)) return {.pair = p, .floor = other};
  }
  for (int g = 0; g < model.ngeom; ++g)
    if (is_floor(model, g) && !are_excluded(model, g, foot) &&
        ((model.geom_contype[g] & model.geom_conaffinity[foot]) != 0 ||
         (model.geom_conaffinity[g] & model.geom_contype[foot]) != 0))
      return {.floor = g, .ahead = model.geom_priority[foot] - model.geom_priority[g]};
  return {};
}

/// 1: without friction.
int dimensions(const mjModel& model, int foot, const FloorContact& contact) {
  if (contact.pair >= 0) return model.pair_dim[contact.pair];
  const int own = model.geom_condim[foot], of_floor = model.geom_condim[contact.floor];
  return contact.ahead == 0 ? std::max(own, of_floor) : contact.ahead > 0 ? own : of_floor;
}

}  // namespace

FootFriction foot_friction(const ModelFile& file, const ModelParts& parts, const LegsGuess& legs) {
  if (legs.legs.empty()) return {1.0, "of no foot"};
  const mjModel& model = *file.model;
  const int foot = parts.model_geoms[to_index(legs.legs[0].foot_geom)];
  const FloorContact contact = floor_contact(model, foot);
  if (contact.pair >= 0)
    return {model.pair_friction[5 * contact.pair],
            "of the pair of the first foot and the floor, as in MuJoCo"};
  const double own = model.geom_friction[3 * foot];
  if (contact.floor < 0)
    return {own, fmt::format("of the first foot in the model, {}",
                             has_floor(model) ? "whose floor it does not touch" : "which has no floor")};
  const double of_floor = model.geom_friction[3 * contact.floor];
  if (contact.ahead == 0)
    return {std::max(own, of_floor),
            fmt::format("the greater of the first foot's, {:.4g}, and the floor's, {:.4g}, as in MuJoCo", own,
                        of_floor)};
  const bool of_foot = contact.ahead > 0;
  return {of_foot ? own : of_floor, fmt::format("of the {}, which has the higher priority; the {} has {:.4g}",
                                                of_foot ? "first foot" : "floor",
                                                of_foot ? "floor" : "first foot", of_foot ? of_floor : own)};
}

std::vector<std::string> bodies_beyond_foot(const ModelParts& parts, const LegGuess& leg) {
  const int foot_body = parts.geoms[to_index(leg.foot_geom)].body;
  std::vector<std::string> beyond;
  for (const int j : leg.joints)
    for (int body = parts.bodies[to_index(parts.joints[to_index(j)].body)].parent; body >= 0;
         body = parts.bodies[to_index(body)].parent)
      if (body == foot_body) {
        beyond.push_back(parts.bodies[to_index(parts.joints[to_index(j)].body)].name);
        break;
      }
  return beyond;
}

namespace {

std::vector<std::string> doubts_of_shapeless(const ModelParts& parts, const LegsGuess& legs) {
  std::vector<std::string> shapeless;
  for (const LegGuess& leg : legs.legs)
    for (std::string& body : bodies_beyond_foot(parts, leg)) shapeless.push_back(std::move(body));
  if (shapeless.empty()) return {};
  return {
      fmt::format("outer parts of legs have no shape that collides, and pass through the ground: {}; their "
                  "legs stand on what comes before: give them one",
                  io::first_few(shapeless))};
}

}  // namespace

std::vector<std::string> doubts_of_feet(const ModelFile& file, const ModelParts& parts,
                                        const LegsGuess& legs) {
  const mjModel& model = *file.model;
  std::vector<std::string> doubts = doubts_of_shapeless(parts, legs);
  if (!has_floor(model)) return doubts;
  std::vector<std::string> through, smooth;
  for (const LegGuess& leg : legs.legs) {
    bool touches = false, rubs = false;
    for (const int geom : leg.foot_geoms) {
      const int foot = parts.model_geoms[to_index(geom)];
      const FloorContact contact = floor_contact(model, foot);
      touches = touches || contact.floor >= 0;
      rubs = rubs || (contact.floor >= 0 && dimensions(model, foot, contact) > 1);
    }
    if (!touches)
      through.push_back(leg.name);
    else if (!rubs)
      smooth.push_back(leg.name);
  }
  if (!through.empty())
    doubts.push_back(
        fmt::format("in MuJoCo the feet of these legs go through the model's floor, by contype, "
                    "conaffinity or an <exclude>; here they stand on the ground: {}",
                    io::first_few(through)));
  if (!smooth.empty())
    doubts.push_back(
        fmt::format("in MuJoCo the feet of these legs have no friction on the model's floor, by "
                    "condim = 1; here they have: {}",
                    io::first_few(smooth)));
  return doubts;
}

}  // namespace amble::morphology
