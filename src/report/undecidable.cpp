#include "amble/report/undecidable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/study_data.hpp"
#include "amble/statistics/hypothesis_tests.hpp"

namespace amble::report {
namespace {

using ledger::ClaimKind;
using ledger::ClaimSpec;

/// The fewest runs of two equal conditions in which a rank test can have so small a p.
std::size_t needed_by_ranks(double alpha) {
  std::size_t runs = fewest_judged;
  while (runs < 100 && statistics::smallest_mann_whitney_p(runs, runs) >= alpha) ++runs;
  return runs;
}

/// The shortest of its runs must go on after the generation from which a plateau counts.
std::string too_short(const ledger::StudySpec& study, const ClaimSpec& claim) {
  const ledger::ConditionSpec& condition = *study.find(claim.condition);
  const int generations = condition.generations > 0 ? condition.generations : study.generations;
  if (generations == 0 || generations > claim.from_generation) return {};
  return fmt::format("with {} of '{}' it cannot be decided; more than from_generation = {} are needed",
                     counted(to_index(generations), "generation"), claim.condition, claim.from_generation);
}

/// No outcome can confirm a count of more runs than there are.
std::string too_few(const ClaimSpec& claim, std::size_t planned) {
  if (claim.at_least <= static_cast<double>(planned)) return {};
  return fmt::format("with {} of '{}' it cannot be confirmed; {:g} are needed", counted(planned, "run"),
                     claim.condition, std::ceil(claim.at_least));
}

std::string line_of(const StudyData& data, const ClaimSpec& claim) {
  if (claim.kind == ClaimKind::plateau)
    if (std::string line = too_short(data.study, claim); !line.empty()) return line;
  if (claim.kind == ClaimKind::count)
    if (std::string line = too_few(claim, data.planned(claim.condition)); !line.empty()) return line;
  std::size_t least = data.planned(claim.condition);
  std::string fewest = claim.condition;
  const std::string& other = claim.against.empty() ? claim.threshold_condition : claim.against;
  if (!other.empty() && data.planned(other) < least) {
    least = data.planned(other);
    fewest = other;
  }
  std::size_t needed = fewest_runs(claim.kind);
  if (claim.kind == ClaimKind::difference && claim.test == ledger::TwoSampleTest::mann_whitney &&
      statistics::smallest_mann_whitney_p(data.planned(claim.condition), data.planned(claim.against)) >=
          claim.alpha)
    needed = std::max(needed, needed_by_ranks(claim.alpha));
  if (least >= needed) return {};
  return fmt::format("with {} of '{}' it cannot be decided; {} are needed", counted(least, "run"), fewest,
                     needed);
}

/// The claims of differences of one relation are adjusted together (Holm): the smallest p counts as many
/// times over as there are claims, so that ranks of few runs can confirm none of many. Nothing where any of
/// them could be confirmed.
std::string too_many(const StudyData& data, ledger::Relation relation) {
  std::vector<const ClaimSpec*> family;
  for (const ClaimSpec& claim : data.study.claims)
    if (claim.kind == ClaimKind::difference && claim.relation == relation) family.push_back(&claim);
  if (family.size() < 2) return {};
  double smallest_p = 1.0;
  for (const ClaimSpec* const claim : family) {
    if (claim->test != ledger::TwoSampleTest::mann_whitney) return {};
    const double p =
        statistics::smallest_mann_whitney_p(data.planned(claim->condition), data.planned(claim->against));
    if (p >= claim->alpha) return {};  // has a line of its own
    if (p * static_cast<double>(family.size()) < claim->alpha) return {};
    smallest_p = std::min(smallest_p, p);
  }
  return fmt::format(
      "the {} claims that one condition is {} another are adjusted together, and with these runs the "
      "smallest p of "
      "ranks is {:.2g}: none can be confirmed; {} runs of each condition are needed, or fewer claims",
      family.size(), relation == ledger::Relation::greater ? "ahead of" : "not behind", smallest_p,
      needed_by_ranks(family.front()->alpha / static_cast<double>(family.size())));
}

}  // namespace

std::vector<std::string> undecidable_claims(const ledger::StudySpec& study) {
  const StudyData data{.study = study, .records = {}, .unknown_files = {}};
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < study.claims.size(); ++i)
    if (const std::string line = line_of(data, study.claims[i]); !line.empty())
      lines.push_back(fmt::format("claims[{}], \"{}\": {}", i, study.claims[i].text, line));
  for (const auto relation : {ledger::Relation::greater, ledger::Relation::not_less})
    if (std::string line = too_many(data, relation); !line.empty()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace amble::report
