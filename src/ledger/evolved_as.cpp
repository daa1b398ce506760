#include "amble/ledger/evolved_as.hpp"

#include <fmt/format.h>

#include "amble/io/json_file.hpp"
#include "amble/score/score.hpp"

namespace amble::ledger {

record::Objective objective_of(const Record& record) {
  const auto score = record.champion.find("score");
  if (score == record.champion.end()) return {};
  const std::string what = fmt::format("the record of {}, seed {}", record.condition, record.seed);
  return score::objective_of(
      io::settings_from_json<score::Settings>(io::JsonView(*score, what, "champion.score")));
}

std::string score_of(const Record& record) {
  const auto score = record.champion.find("score");
  return score == record.champion.end() ? std::string() : score->dump();
}

std::optional<double> evolution_trial_s(const Record& record) {
  const auto trial = record.champion.find("trial");
  if (trial == record.champion.end() || !trial->is_object()) return std::nullopt;
  const auto duration = trial->find("duration_s");
  if (duration == trial->end() || !duration->is_number()) return std::nullopt;
  return duration->get<double>();
}

bool evolved_undisturbed(const Record& record) {
  return !record.champion.contains("noise") && !record.champion.contains("ground");
}

}  // namespace amble::ledger
