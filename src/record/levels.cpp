#include "amble/record/levels.hpp"

#include <algorithm>
#include <array>

namespace amble::record {
namespace {

constexpr std::array all_levels{
    Level{.name = "control", .meaning = "pushes too weak to change a bit: 1e-20 m/s", .push_m_s = 1e-20},
    Level{.name = "micro", .meaning = "starts that differ by a micro-radian", .start_rad = 1e-6},
    Level{.name = "100-micro", .meaning = "starts that differ by 100 micro-radians", .start_rad = 1e-4},
    Level{.name = "milli",
          .meaning = "starts that differ by a milli-radian and a tenth of a millimetre",
          .start_rad = 1e-3}};

}  // namespace

std::span<const Level> levels() {
  return all_levels;
}

const Level* find_level(std::string_view name) {
  const auto found = std::ranges::find(all_levels, name, &Level::name);
  return found == all_levels.end() ? nullptr : &*found;
}

std::string level_names() {
  std::string text;
  for (std::size_t i = 0; i < all_levels.size(); ++i) {
    if (i > 0) text += i + 1 == all_levels.size() ? " or " : ", ";
    text += all_levels[i].name;
  }
  return text;
}

}  // namespace amble::record
