#include "amble/morphology/mass_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/morphology/number_text.hpp"

namespace amble::morphology {
namespace {

constexpr const char *small_mass = "1e-6", *small_moment = "1e-9";

/// The principal values of a symmetric tensor given row by row, falling.
std::array<mjtNum, 3> principal(const std::array<mjtNum, 9>& matrix) {
  std::array<mjtNum, 3> moments{};
  std::array<mjtNum, 9> axes{};
  std::array<mjtNum, 4> turn{};
  mju_eig3(moments.data(), axes.data(), turn.data(), matrix.data());
  return moments;
}

bool possible(std::array<mjtNum, 3> moments) {
  std::ranges::sort(moments, std::greater<>());
  return moments[2] >= 0.0 && moments[1] + moments[2] >= moments[0];
}

/// What is to be added to each of the moments, so that a body can have them, where they miss that by the
/// digits of a file; else 0.
double rounding_of(const std::array<mjtNum, 3>& falling) {
  constexpr double most_share = 0.01;
  const double excess = falling[0] - falling[1] - falling[2];
  return falling[2] >= 0.0 && excess <= most_share * falling[0] ? excess * (1.0 + 1e-6) : 0.0;
}

/// One <inertial>, of either format.
class Inertial {
 public:
  Inertial(XmlElement& element, bool urdf) : element_(element), urdf_(urdf) {}

  double mass_kg() const {
    const XmlElement* mass = urdf_ ? element_.child("mass") : &element_;
    return mass != nullptr ? number_or_zero(mass->attribute(urdf_ ? "value" : "mass")) : 0.0;
  }

  /// Ixx, Iyy, Izz, Ixy, Ixz, Iyz.
  std::array<double, 6> moments() const {
    std::array<double, 6> all{};
    if (urdf_) {
      static constexpr std::array<const char*, 6> keys{"ixx", "iyy", "izz", "ixy", "ixz", "iyz"};
      if (const XmlElement* inertia = element_.child("inertia"))
        for (std::size_t i = 0; i < 6; ++i) all[i] = number_or_zero(inertia->attribute(keys[i]));
      return all;
    }
    const auto full = element_.attribute("fullinertia");
    const std::vector<double> given = numbers_of(full ? *full : element_.attribute_or("diaginertia", ""));
    for (std::size_t i = 0; i < std::min<std::size_t>(full ? 6 : 3, given.size()); ++i) all[i] = given[i];
    return all;
  }

  void set_mass(const std::string& kg) {
    XmlElement& mass = urdf_ ? child("mass") : element_;
    mass.set(urdf_ ? "value" : "mass", kg);
  }

  /// The axes stay.
  void add_to_moments(double each) {
    const auto all = moments();
    const std::array sums{all[0] + each, all[1] + each, all[2] + each};
    if (urdf_) {
      XmlElement& inertia = child("inertia");
      for (std::size_t i = 0; i < 3; ++i)
        inertia.set(std::array{"ixx", "iyy", "izz"}[i], fmt::format("{:.9g}", sums[i]));
    } else if (element_.attribute("fullinertia")) {
      element_.set("fullinertia", fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}", sums[0], sums[1],
                                              sums[2], all[3], all[4], all[5]));
    } else {
      element_.set("diaginertia", fmt::format("{:.9g} {:.9g} {:.9g}", sums[0], sums[1], sums[2]));
    }
  }

  void set_moments(const std::string& each) {
    if (!urdf_) {
      element_.remove_attribute("fullinertia");
      element_.set("diaginertia", fmt::format("{0} {0} {0}", each));
      return;
    }
    XmlElement& inertia = child("inertia");
    for (const char* key : {"ixx", "iyy", "izz"}) inertia.set(key, each);
    for (const char* key : {"ixy", "ixz", "iyz"}) inertia.set(key, "0");
  }

 private:
  XmlElement& child(const char* name) {
    if (XmlElement* found = element_.child(name)) return *found;
    element_.children.push_back({.name = name, .file = element_.file, .line = element_.line});
    return element_.children.back();
  }

  XmlElement& element_;
  bool urdf_;
};

/// Gives it small numbers where it has none.
void fill(XmlElement& body, bool urdf, MissingMass& missing) {
  if (body.child("inertial") == nullptr) {
    XmlElement element{.name = "inertial", .file = body.file, .line = body.line};
    if (!urdf) element.set("pos", "0 0 0");
    body.children.insert(body.children.begin(), std::move(element));
  }
  Inertial inertial(*body.child("inertial"), urdf);
  missing.mass_kg = std::max(0.0, inertial.mass_kg());
  if (!(missing.mass_kg > 0.0)) inertial.set_mass(small_mass);
  inertial.set_moments(small_moment);
}

bool has_no_moments(XmlElement& body, bool urdf) {
  XmlElement* element = body.child("inertial");
  if (element == nullptr) return false;
  const auto moments = Inertial(*element, urdf).moments();
  return std::ranges::all_of(moments, [](double moment) { return moment == 0.0; });
}

/// Links that a joint moves.
std::set<std::string> moved_links(const XmlElement& root) {
  std::set<std::string> links;
  for (const XmlElement& joint : root.children) {
    const XmlElement* child = joint.name == "joint" ? joint.child("child") : nullptr;
    if (child != nullptr && joint.attribute_or("type", "") != "fixed")
      links.insert(child->attribute_or("link", ""));
  }
  return links;
}

bool give_small_mass_urdf(XmlElement& root, const std::string& name, MissingMasses& missing) {
  const std::set<std::string> moved = moved_links(root);
  bool found = false;
  for (XmlElement& link : root.children) {
    if (link.name != "link") continue;
    const std::string own = link.attribute_or("name", "");
    const bool empty = link.child("inertial") == nullptr && link.child("collision") == nullptr &&
                       link.child("visual") == nullptr;
    if (own != name && !(moved.contains(own) && (empty || has_no_moments(link, true)))) continue;
    const auto [at, is_new] = missing.try_emplace(own);
    if (!is_new) continue;
    fill(link, true, at->second);
    found = found || own == name;
  }
  return found;
}

bool give_small_mass_mjcf(XmlElement& root, const std::string& name, int id, MissingMasses& missing) {
  bool found = false;
  int number = 0;
  const auto look = [&](const auto& self, XmlElement& parent) -> void {
    for (XmlElement& body : parent.children) {
      if (body.name != "body") continue;
      ++number;
      const std::string own = body.attribute_or("name", "");
      const bool named = name.empty() ? number == id : own == name;
      if (named || has_no_moments(body, false)) {
        const auto [at, is_new] = missing.try_emplace(own.empty() ? fmt::format("#{}", number) : own);
        if (is_new) fill(body, false, at->second);
        found = found || (named && is_new);
      }
      self(self, body);
    }
  };
  for (XmlElement& section : root.children)
    if (section.name == "worldbody") look(look, section);
  return found;
}

}  // namespace

void balance_inertias(XmlElement& root, bool urdf, ReadingNotes& notes) {
  std::vector<std::string> balanced, rounded, negative;
  root.visit([&](XmlElement& body, XmlElement*) {
    XmlElement* element = body.name == (urdf ? "link" : "body") ? body.child("inertial") : nullptr;
    if (element == nullptr) return;
    Inertial inertial(*element, urdf);
    const std::string name = body.attribute_or("name", "");
    if (inertial.mass_kg() < 0.0) {
      negative.push_back(name);
      inertial.set_mass("0");
    }
    const auto [xx, yy, zz, xy, xz, yz] = inertial.moments();
    const double sum = xx + yy + zz;
    const auto moments = principal({xx, xy, xz, xy, yy, yz, xz, yz, zz});
    if (possible(moments)) return;
    if (const double rounding = rounding_of(moments); rounding > 0.0) {
      rounded.push_back(name);
      inertial.add_to_moments(rounding);
    } else if (sum > 0.0) {
      balanced.push_back(name);
      inertial.set_moments(fmt::format("{:.6g}", sum / 3.0));
    } else {
      negative.push_back(name);
      inertial.set_moments("0");
    }
  });
  if (!balanced.empty())
    notes.add(Reading::replaced,
              fmt::format("principal moments of inertia that no body can have, by their mean: {}",
                          fmt::join(balanced, ", ")));
  if (!rounded.empty())
    notes.add(Reading::replaced,
              fmt::format("moments of inertia that are too unequal by less than a hundredth, "
                          "by ones that a body can have: {}",
                          fmt::join(rounded, ", ")));
  if (!negative.empty())
    notes.add(Reading::replaced,
              fmt::format("negative masses or moments of inertia, which are taken as not given: {}",
                          fmt::join(negative, ", ")));
}

std::vector<bool> bodies_with_inertial(const XmlElement& root, int count) {
  bool from_geoms = false;
  std::vector<bool> has{true};  // the world weighs nothing
  const auto add = [&](const auto& self, const XmlElement& parent) -> void {
    for (const XmlElement& child : parent.children) {
      if (child.name != "body") continue;
      has.push_back(child.child("inertial") != nullptr);
      self(self, child);
    }
  };
  for (const XmlElement& section : root.children) {
    if (section.name == "worldbody") add(add, section);
    if (section.name == "compiler" && section.attribute_or("inertiafromgeom", "auto") == "true")
      from_geoms = true;
  }
  if (from_geoms || has.size() != to_index(count)) has.assign(to_index(count), false);
  has[0] = true;
  return has;
}

void complete_inertials(XmlElement& root, MissingMasses& missing) {
  for (XmlElement& link : root.children) {
    XmlElement* const inertial = link.name == "link" ? link.child("inertial") : nullptr;
    if (inertial == nullptr || (inertial->child("mass") != nullptr && inertial->child("inertia") != nullptr))
      continue;
    fill(link, true, missing[link.attribute_or("name", "")]);
  }
}

bool fill_empty_inertials(XmlElement& root, MissingMasses& missing) {
  const std::size_t before = missing.size();
  give_small_mass_mjcf(root, "", -1, missing);
  return missing.size() > before;
}

bool give_small_mass(XmlElement& root, bool urdf, const std::string& name, int id, MissingMasses& missing) {
  return urdf ? give_small_mass_urdf(root, name, missing) : give_small_mass_mjcf(root, name, id, missing);
}

}  // namespace amble::morphology
