#include "amble/physics/ode/variant.hpp"

#include <cmath>

namespace amble::physics::ode {
namespace {

constexpr double most_sweeps = 10'000;
constexpr double most_friction_n = 1e6;
constexpr double softest_s_per_kg = 1e3;

double number(const io::OwnSettings& own, const char* name) {
  const auto found = own.numbers.find(name);
  return found == own.numbers.end() ? 0.0 : found->second;
}

}  // namespace

Variant Variant::of(const io::OwnSettings& own) {
  return {.quick_sweeps = static_cast<int>(std::ceil(number(own, "quick_sweeps"))),
          .friction_n = number(own, "friction_n"),
          .foot_erp = number(own, "foot_erp"),
          .foot_cfm_s_per_kg = number(own, "foot_cfm_s_per_kg")};
}

std::vector<io::OwnNumber> variant_numbers() {
  return {
      {.name = "quick_sweeps",
       .range = {0.0, most_sweeps},
       .what = "> 0: ODE's QuickStep with so many sweeps; 0: its exact solver",
       .source = "ODE manual, dWorldSetQuickStepNumIterations (20)"},
      {.name = "friction_n",
       .range = {0.0, most_friction_n},
       .what = "> 0: most friction of a contact, N, whatever presses it; 0: by the robot's coefficient",
       .source = "ODE manual, \"Contact\": mu without dContactApprox1"},
      {.name = "foot_erp",
       .range = {0.0, 1.0},
       .what = "> 0: share of the penetration undone per step in contacts of feet; 0: the robot's",
       .source = "ODE manual, soft_erp"},
      {.name = "foot_cfm_s_per_kg",
       .range = {0.0, softest_s_per_kg},
       .what = "> 0: yielding velocity per force in contacts of feet, m/s per N; 0: the robot's",
       .source = "ODE manual, soft_cfm"},
  };
}

}  // namespace amble::physics::ode
