#include "amble/report/undecidable.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/core/index.hpp"
#include "amble/report/study_data.hpp"
#include "amble/statistics/hypothesis_tests.hpp"

namespace amble::report {
namespace {

using ledger::ClaimKind;
using ledger::ClaimSpec;

std::size_t planned(const ledger::StudySpec& study, const std::string& condition) {
  const auto* spec = study.find(condition);
  AMBLE_CHECK(spec != nullptr, "a condition of the study");
  return study.seeds_of(*spec).size();
}

std::size_t needed_by(const ClaimSpec& claim) {
  const bool resampled = claim.kind == ClaimKind::ratio || claim.kind == ClaimKind::plateau;
  return resampled ? std::max(fewest_judged, fewest_resampled) : fewest_judged;
}

/// The fewest runs of two equal conditions in which a rank test can have so small a p.
std::size_t needed_by_ranks(double alpha) {
  std::size_t runs = fewest_judged;
  while (runs < 100 && statistics::smallest_mann_whitney_p(runs, runs) >= alpha) ++runs;
  return runs;
}

std::string line_of(const ledger::StudySpec& study, const ClaimSpec& claim) {
  std::size_t least = planned(study, claim.condition);
  std::string fewest = claim.condition;
  if (!claim.against.empty() && planned(study, claim.against) < least) {
    least = planned(study, claim.against);
    fewest = claim.against;
  }
  std::size_t needed = needed_by(claim);
  if (claim.kind == ClaimKind::difference && claim.test == ledger::TwoSampleTest::mann_whitney &&
      statistics::smallest_mann_whitney_p(planned(study, claim.condition), planned(study, claim.against)) >=
          claim.alpha)
    needed = std::max(needed, needed_by_ranks(claim.alpha));
  if (least >= needed) return {};
  return fmt::format("with {} of '{}' it cannot be decided; {} are needed", counted(least, "run"), fewest,
                     needed);
}

}  // namespace

std::vector<std::string> undecidable_claims(const ledger::StudySpec& study) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < study.claims.size(); ++i)
    if (const std::string line = line_of(study, study.claims[i]); !line.empty())
      lines.push_back(fmt::format("claims[{}], \"{}\": {}", i + 1, study.claims[i].text, line));
  return lines;
}

}  // namespace amble::report
