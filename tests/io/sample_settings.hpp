#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "amble/io/settings.hpp"

namespace amble::test {

enum class Colour { red, green, blue };
inline constexpr std::array<std::string_view, 3> colour_names{"red", "green", "blue"};

struct Inner {
  double rate = 0.25;
  std::int64_t seed = 1;

  void describe(io::SettingsVisitor& visitor) {
    visitor.number("rate", rate, {0.0, 1.0}, {"Share of offspring, 0 to 1.", "Somebody 2013"});
    visitor.integer("seed", seed, {}, {"Seed of all randomness."});
  }
};

/// An item of a list of tables.
struct Knot {
  std::string name;
  std::vector<double> at;
  double length = 0.5;
  bool tight = false;

  void describe(io::SettingsVisitor& visitor) {
    visitor.text("name", name, {"What it is called."});
    visitor.numbers("at", at, {-10.0, 10.0}, {"Where it is."});
    visitor.number("length", length, {0.0, 1.0}, {"Length, m."});
    visitor.flag("tight", tight, {"Whether it holds."});
  }
};

/// Settings with a field of every kind, a scalar after a table, and a table in a table.
struct Sample {
  Inner inner;
  std::string name = "walker";
  int population = 300;
  double friction = std::numeric_limits<double>::infinity();
  bool elitism = true;
  Colour colour = Colour::green;
  std::vector<double> weights{1.0, -2.5};
  std::vector<std::string> legs{"FL", "FR"};
  std::vector<Knot> knots{{"first", {1.0, 2.0}, 0.5, false}, {"second", {}, 0.25, true}};
  Inner deep;

  void describe(io::SettingsVisitor& visitor) {
    visitor.table("inner", inner, {"What lies within."});
    visitor.text("name", name, {"Name of the robot."});
    visitor.integer("population", population, {2, 1000000},
                    {"Genomes per generation.", "Somebody 2013, sec. 4"});
    visitor.number("friction", friction, {0.0}, {"Coulomb coefficient."});
    visitor.flag("elitism", elitism, {"Whether the best survive."});
    visitor.choice("colour", colour, colour_names, {"Colour of the torso."});
    visitor.numbers("weights", weights, {-10.0, 10.0}, {"Weights, without unit."});
    visitor.texts("legs", legs, {"Names of the legs."});
    visitor.tables("knots", knots, {"A list of tables."});
    visitor.begin("outer", {"A table that holds only a table."});
    visitor.table("deep", deep, {"The innermost table."});
    visitor.end();
  }
};

}  // namespace amble::test
