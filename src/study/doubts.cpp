#include "amble/study/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "amble/io/settings.hpp"

namespace amble::study {
namespace {

/// Measures in the unit of the score that a condition evolves by.
constexpr std::array<std::string_view, 4> measures_of_scores{"train_m", "map_best", "qd_score",
                                                             "corrected_qd_score"};

bool are_the_same(const PlannedCondition& a, const PlannedCondition& b) {
  return a.recorded_hash() == b.recorded_hash() && a.config.generations == b.config.generations &&
         a.spec.steering == b.spec.steering;
}

void compare_conditions(const Plan& plan, std::vector<std::string>& doubts) {
  for (std::size_t j = 0; j < plan.conditions.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (are_the_same(plan.conditions[i], plan.conditions[j]))
        doubts.push_back(fmt::format(
            "conditions '{}' and '{}' have the same settings: with the same seeds their runs are the same",
            plan.conditions[i].spec.name, plan.conditions[j].spec.name));
}

/// Of a condition that a claim names; null: it names none.
const experiment::Config* config_of(const Plan& plan, const std::string& condition) {
  const auto found = std::ranges::find(plan.conditions, condition,
                                       [](const PlannedCondition& planned) { return planned.spec.name; });
  return found == plan.conditions.end() ? nullptr : &found->config;
}

void compare_scores(const Plan& plan, std::vector<std::string>& doubts) {
  for (std::size_t i = 0; i < plan.study.claims.size(); ++i) {
    const ledger::ClaimSpec& claim = plan.study.claims[i];
    const std::string& other = claim.against.empty() ? claim.threshold_condition : claim.against;
    const auto *const a = config_of(plan, claim.condition), *const b = config_of(plan, other);
    if (std::ranges::find(measures_of_scores, claim.measure) == measures_of_scores.end() || a == nullptr ||
        b == nullptr || io::settings_to_json(a->score) == io::settings_to_json(b->score))
      continue;
    doubts.push_back(fmt::format(
        "claims[{}], \"{}\": '{}' and '{}' evolve by different scores, so that {} of one says nothing about "
        "the other; expected a measure of a test",
        i, claim.text, claim.condition, other, claim.measure));
  }
}

}  // namespace

std::vector<std::string> doubts_of(const Plan& plan) {
  std::vector<std::string> doubts;
  compare_conditions(plan, doubts);
  compare_scores(plan, doubts);
  return doubts;
}

}  // namespace amble::study
