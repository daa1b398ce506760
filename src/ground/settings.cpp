#include "amble/ground/settings.hpp"

#include <algorithm>
#include <cmath>

#include "amble/core/error.hpp"
#include "amble/ground/height_field.hpp"
#include "amble/ground/kinds.hpp"
#include "amble/io/json_file.hpp"

namespace amble::ground {

void Settings::describe(io::SettingsVisitor& visitor) {
  visitor.row_name("kind", kind, kinds(), {"what is on the ground"});
  visitor.number(
      "height_m", height_m, {0.0, 10.0},
      {"hills, rough, stones: from the lowest to the highest point; else of one step or obstacle, m"});
  visitor.number("length_m", length_m, {0.01, 100.0},
                 {"hills: wavelength; else distance from one step, stone or obstacle to the next, m"});
  visitor.number("cell_m", cell_m, {0.005, 1.0},
                 {"distance between the heights that describe the ground, m; it repeats after 256 of them"});
  visitor.number("start_radius_m", start_radius_m, {0.0, 100.0},
                 {"the ground is flat, at height 0, so far around the origin, where robots start, m"});
  visitor.number("start_place_m", start_place_m, {0.0, 1000.0},
                 {"each trial starts elsewhere instead: up to ± this from the origin along x and y, m"});
  visitor.number("slope_x", slope_x, {-10.0, 10.0}, {"rise of the ground along x, m per m"});
  visitor.number("slope_y", slope_y, {-10.0, 10.0}, {"rise of the ground along y, m per m"});
  visitor.number("friction", friction, {-1.0, 1e6},
                 {"coefficient of friction between robot and ground; -1: as in the robot's file"});
  visitor.integer("seed", seed, {0, 2147483647}, {"names one of all grounds of these settings"});
  visitor.choice("vary", vary, vary_names, {"whether each generation has another ground of its own"});
  visitor.integer(
      "grow_generations", grow_generations, {0, 1e9},
      {"curriculum: heights grow from 0 in the first generation to all of height_m after so many"});
  if (const auto& numbers = kind_of(*this).numbers; !numbers.empty()) {
    visitor.begin("own", {"settings of this kind, which is not one of amble's own"});
    own.describe(visitor, numbers);
    visitor.end();
  }
}

bool Settings::concentric() const {
  return kind_of(*this).concentric;
}

void Settings::validate() const {
  if (friction < 0.0 && friction != -1.0)
    fail_setting({"ground.friction"}, "ground.friction = {}: expected 0 or more, or -1 for the robot's own",
                 friction);
  if (!has_field()) return;
  if (length_m < 2.0 * cell_m)
    fail_setting({"ground.length_m", "ground.cell_m"},
                 "ground.length_m = {}: expected at least two cells of {} m (ground.cell_m)", length_m,
                 cell_m);
  if (kind == "hurdles" && cell_m > hurdle_m)
    fail_setting(
        {"ground.cell_m"},
        "ground.cell_m = {}: walls are {} m thick, and would be missed between two places; expected at "
        "most that, or smaller ground.length_m and ground.start_radius_m",
        cell_m, hurdle_m);
  // At least one whole step or obstacle around the start, or two waves or stones.
  const double period_m = HeightField::cells * cell_m;
  const double needed_m =
      2.0 * (concentric() ? start_radius_m + length_m : std::max(start_radius_m, length_m));
  if (needed_m > period_m)
    fail_setting(
        {"ground.length_m", "ground.start_radius_m", "ground.cell_m"},
        "ground.length_m = {} and ground.start_radius_m = {} do not fit into the {} m after which the "
        "ground repeats: expected a larger ground.cell_m, which is {} m",
        length_m, start_radius_m, period_m, cell_m);
}

bool Settings::is_default() const {
  Settings copy = *this, standard;
  return io::settings_to_json(copy) == io::settings_to_json(standard);
}

Vec3 Settings::tilted(Vec3 gravity_m_s2) const {
  if (slope_x == 0.0 && slope_y == 0.0) return gravity_m_s2;
  if (gravity_m_s2.x != 0.0 || gravity_m_s2.y != 0.0)
    fail_setting({slope_x != 0.0 ? "ground.slope_x" : "ground.slope_y"},
                 "ground.slope_x, slope_y = {:g}, {:g}: the robot's own gravity leans already, "
                 "({:.4g}, {:.4g}, {:.4g}) m/s2; expected either, such as gravity along -z in the model",
                 slope_x, slope_y, gravity_m_s2.x, gravity_m_s2.y, gravity_m_s2.z);
  // Seen from the slope, down leans downhill: without sines, whose last bits differ between CPUs.
  const double along = gravity_m_s2.z / std::sqrt(1.0 + slope_x * slope_x + slope_y * slope_y);
  return {slope_x * along, slope_y * along, along};
}

}  // namespace amble::ground
