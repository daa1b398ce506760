#include "amble/substrate/supg_layout.hpp"

#include <cstddef>

#include "amble/core/check.hpp"
#include "amble/core/error.hpp"

namespace amble::substrate {

void SupgLayoutSettings::describe(io::SettingsVisitor& visitor) {
  constexpr io::Range coordinates{-1e6, 1e6};
  visitor.choice("leg_axis", leg_axis, leg_axis_names,
                 {"which CPPN input tells the legs apart: x (the first) or y (the second); the other tells "
                  "the joint types apart",
                  "the authors' code: x; Morse et al. 2013, sec. 3: y"});
  visitor.numbers(
      "leg_coordinates", leg_coordinates, coordinates,
      {"coordinate of each leg before division, in the robot's order of legs", "the authors' code"});
  visitor.number("leg_divisor", leg_divisor, {1e-6, 1e6},
                 {"leg coordinates are divided by this, so that SUPGs of one joint type stand close together",
                  "the authors' code"});
  visitor.numbers("type_coordinates", type_coordinates, coordinates,
                  {"coordinate of each joint type, in the robot's order of types", "the authors' code"});
}

namespace {

void expect_one_each(const char* key, std::size_t values, const char* things, int count) {
  if (values != static_cast<std::size_t>(count))
    fail(ExitCode::bad_input, "controller.supg.layout.{} has {} values, but the robot has {} {}", key, values,
         count, things);
}

}  // namespace

SupgLayout::SupgLayout(const SupgLayoutSettings& settings, int legs, int types, int period_ticks)
    : legs_(legs),
      types_(types),
      period_ticks_(period_ticks),
      points_(inputs, legs * types * (period_ticks + 1) + legs) {
  AMBLE_CHECK(period_ticks >= 1, "a period has at least one tick");
  expect_one_each("leg_coordinates", settings.leg_coordinates.size(), "legs", legs);
  expect_one_each("type_coordinates", settings.type_coordinates.size(), "joint types", types);

  const auto set = [&](int point, double leg, double type, double time) {
    const bool leg_first = settings.leg_axis == LegAxis::x;
    points_.set(point, 0, static_cast<float>(leg_first ? leg : type));
    points_.set(point, 1, static_cast<float>(leg_first ? type : leg));
    points_.set(point, 2, static_cast<float>(time));
  };
  for (int leg = 0; leg < legs; ++leg) {
    const double leg_coordinate =
        settings.leg_coordinates[static_cast<std::size_t>(leg)] / settings.leg_divisor;
    for (int type = 0; type < types; ++type)
      for (int tick = 0; tick <= period_ticks; ++tick)
        set(pattern_point(leg, type, tick), leg_coordinate,
            settings.type_coordinates[static_cast<std::size_t>(type)],
            static_cast<double>(tick) / period_ticks);
    set(offset_point(leg), leg_coordinate, 0.0, 0.0);
  }
}

}  // namespace amble::substrate
