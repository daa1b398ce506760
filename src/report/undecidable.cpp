#include "amble/report/undecidable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/study_data.hpp"
#include "amble/score/walking.hpp"
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
  const int needed = claim.from_generation + 2;  // they count from 0, and one must follow
  if (generations == 0 || generations >= needed) return {};
  return fmt::format("with {} of '{}' it cannot be decided; from_generation = {} needs {}",
                     counted(to_index(generations), "generation"), claim.condition, claim.from_generation,
                     needed);
}

/// What no run's measure exceeds; infinite where that is not known.
double most_of(const ledger::StudySpec& study, std::string_view measure) {
  const ledger::TestSpec* const test = ledger::test_of(study, measure);
  if (test != nullptr && measure.ends_with("_s"))
    for (const std::string_view time : {".upright_s", ".walking_s", ".moving_s"})
      if (measure.ends_with(time)) return test->seconds;
  const bool is_share = ledger::is_share(measure) || (test != nullptr && measure.ends_with(".tracking"));
  return is_share ? 1.0 : ledger::unbounded;
}

/// A threshold that no run can reach, or that all do.
std::string beyond_reach(const ledger::StudySpec& study, const ClaimSpec& claim) {
  if (!claim.threshold_condition.empty()) return {};
  const double most = most_of(study, claim.measure);
  if (claim.threshold > most)
    return fmt::format("threshold = {:g}: {} is at most {:g}", claim.threshold, claim.measure, most);
  const double stop_s = score::StandingRule().window_s;
  if (claim.measure.ends_with(".walking_s") && most <= stop_s)
    return fmt::format("{} cannot tell who stops: a stop takes {:g} s, and the test is {:g} s long",
                       claim.measure, stop_s, most);
  return {};
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
  if (claim.kind == ClaimKind::count) {
    if (std::string line = beyond_reach(data.study, claim); !line.empty()) return line;
    if (std::string line = too_few(claim, data.planned(claim.condition)); !line.empty()) return line;
  }
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
