#include "amble/morphology/number_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace amble::morphology {

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  for (;;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) return numbers;
    numbers.push_back(number);
    at = end;
  }
}

double number_or_zero(const std::optional<std::string>& text) {
  const double number = text ? std::strtod(text->c_str(), nullptr) : 0.0;
  return std::isfinite(number) ? number : 0.0;
}

double positive_or_zero(const std::optional<std::string>& text) {
  const double number = number_or_zero(text);
  return number > 0.0 && number < 1e9 ? number : 0.0;
}

double weaker_side(double lower, double upper) {
  const double weaker = std::min(-lower, upper);
  const double side = weaker > 0.0 ? weaker : std::max(std::abs(lower), std::abs(upper));
  return side < 1e9 ? side : 0.0;
}

namespace {

struct OddLimits {
  std::vector<std::string> crossed, empty, missing, endless;
};

/// As it is told: by its name, its joint's or its class's.
std::string who(const XmlElement& element) {
  for (const char* key : {"name", "joint", "class"})
    if (const auto name = element.attribute(key); name && !name->empty()) return *name;
  return fmt::format("<{}> of line {}", element.name, element.line);
}

void look_at_urdf_joint(XmlElement& joint, OddLimits& odd) {
  const std::string type = joint.attribute_or("type", "");
  // MuJoCo would heed them.
  if (XmlElement* limit = joint.name == "joint" && type == "continuous" ? joint.child("limit") : nullptr) {
    for (const char* key : {"lower", "upper"}) {
      if (number_or_zero(limit->attribute_or(key, "0")) != 0.0 &&
          (odd.endless.empty() || odd.endless.back() != who(joint)))
        odd.endless.push_back(who(joint));
      limit->remove_attribute(key);
    }
  }
  if (joint.name != "joint" || (type != "revolute" && type != "prismatic")) return;
  XmlElement* limit = joint.child("limit");
  if (limit == nullptr) {
    odd.missing.push_back(who(joint));
    return;
  }
  const std::string lower = limit->attribute_or("lower", "0"), upper = limit->attribute_or("upper", "0");
  const double from = number_or_zero(lower), to = number_or_zero(upper);
  if (from > to) {
    odd.crossed.push_back(fmt::format("{} ({} to {})", who(joint), from, to));
    limit->set("lower", upper);
    limit->set("upper", lower);
  } else if (from == to) {
    odd.empty.push_back(who(joint));
  }
}

/// What says whether the range holds: "ctrllimited" of "ctrlrange".
std::string with_limited(std::string_view key) {
  return std::string(key.substr(0, key.size() - std::string_view("range").size())) + "limited";
}

void look_at_mjcf_range(XmlElement& element, const char* key, OddLimits& odd) {
  const auto text = element.attribute(key);
  const std::vector<double> ends = text ? numbers_of(*text) : std::vector<double>();
  if (ends.size() != 2 || ends[0] < ends[1]) return;
  if (ends[0] > ends[1]) {
    odd.crossed.push_back(fmt::format("{} ({} to {})", who(element), ends[0], ends[1]));
    element.set(key, fmt::format("{} {}", ends[1], ends[0]));
    return;
  }
  const std::string limited = with_limited(key);
  if (element.name == "joint" && key == std::string_view("range")) {
    if (element.attribute_or(limited, "") == "false") return;
    odd.empty.push_back(who(element));
  }
  element.remove_attribute(key);
  if (element.attribute(limited)) element.set(limited, "false");
}

}  // namespace

void mend_limits(XmlElement& root, bool urdf, ReadingNotes& notes) {
  OddLimits odd;
  root.visit([&](XmlElement& element, XmlElement* parent) {
    if (urdf) {
      if (parent == &root) look_at_urdf_joint(element, odd);
      return;
    }
    if (element.name == "joint" || element.name == "spatial" || element.name == "fixed")
      look_at_mjcf_range(element, "range", odd);
    for (const char* key : {"ctrlrange", "forcerange", "actuatorfrcrange"})
      look_at_mjcf_range(element, key, odd);
  });
  const auto note = [&](const char* what, const std::vector<std::string>& names) {
    if (!names.empty()) notes.add(Reading::replaced, fmt::format("{}: {}", what, fmt::join(names, ", ")));
  };
  note("limits whose lower is above their upper, which were put the right way round", odd.crossed);
  note("limits that leave no range, as exporters write them where none are known: these joints have no stops",
       odd.empty);
  note("joints without <limit>: they have no stops", odd.missing);
  note("stops of continuous joints, which have none", odd.endless);
}

double inward(double value, double start) {
  const double scaled = value * 1e4;
  if (value < start) return std::min(std::ceil(scaled - 1e-6) / 1e4, start);
  if (value > start) return std::max(std::floor(scaled + 1e-6) / 1e4, start);
  return value;
}

double rounded_down(double length_m) {
  double steps_per_m = 1e3;
  while (length_m > 0.0 && length_m * steps_per_m < 10.0 && steps_per_m < 1e12) steps_per_m *= 10.0;
  return std::floor(steps_per_m * length_m) / steps_per_m;
}

double rounded_up(double length_m) {
  double steps_per_m = 1e4;
  while (length_m > 0.0 && length_m * steps_per_m < 10.0 && steps_per_m < 1e12) steps_per_m *= 10.0;
  return std::ceil(length_m * steps_per_m - 1e-6) / steps_per_m;
}

}  // namespace amble::morphology
