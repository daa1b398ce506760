#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "amble/core/index.hpp"
#include "amble/report/gait_counts.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/verdict_kinds.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/proportions.hpp"

namespace amble::report {
namespace {

using ledger::ClaimSpec;

/// Level at which a count is compared with a published one.
constexpr double count_alpha = 0.05;

/// "at least 1", "2 to 5", "at most 0".
std::string count_bounds_text(const ClaimSpec& claim) {
  if (claim.at_most == ledger::unbounded) return fmt::format("at least {:g}", claim.at_least);
  if (claim.at_least == -ledger::unbounded) return fmt::format("at most {:g}", claim.at_most);
  return fmt::format("{:g} to {:g}", claim.at_least, claim.at_most);
}

void conclude_bounded_count(const ClaimSpec& claim, std::size_t successes, Judgement& judgement) {
  const std::size_t missing = judgement.planned - judgement.n;
  judgement.verdict = count_verdict(successes, missing, claim.at_least, claim.at_most);
  const std::string claimed = count_bounds_text(claim);
  if (judgement.verdict == Verdict::not_testable)
    judgement.reason = fmt::format("{} of {} runs so far, claimed {}: the {} missing decide.", successes,
                                   judgement.n, claimed, missing);
  else
    judgement.reason = fmt::format("Claimed: {}.", claimed);
}

void conclude_published_count(const ClaimSpec& claim, const statistics::Count& ours, Judgement& judgement) {
  const statistics::Count published{static_cast<std::uint64_t>(claim.successes),
                                    static_cast<std::uint64_t>(claim.runs)};
  const auto test = *statistics::fisher_exact(ours, published);
  const double share = static_cast<double>(claim.successes) / claim.runs;
  const bool inside = judgement.interval->contains(share);
  judgement.test = "Fisher’s exact";
  judgement.p = test.p;
  judgement.verdict = agreement_verdict({.p = test.p, .alpha = count_alpha, .inside = inside});
  const auto theirs = *statistics::clopper_pearson(published, confidence);
  judgement.reason =
      fmt::format("Published {} of {}, {}; that share lies {} our interval. {}", claim.successes, claim.runs,
                  share_text(share, theirs), inside ? "in" : "outside",
                  judgement.verdict == Verdict::contradicted ? "The shares differ significantly."
                  : judgement.verdict == Verdict::compatible
                      ? "The data do not contradict the claim; that is not evidence for it."
                      : "No difference was found, which does not prove that there is none.");
}

/// The threshold of a count; nothing, with the reason in the judgement, if it cannot be had.
std::optional<double> threshold_of(const StudyData& data, const ClaimSpec& claim, Judgement& judgement) {
  if (claim.threshold_condition.empty()) return claim.threshold;
  const auto others = data.values(claim.threshold_condition, claim.measure);
  judgement.n_against = others.size();
  judgement.planned_against = data.planned(claim.threshold_condition);
  judgement.reason = too_few(data, claim.threshold_condition, others.size(), 2);
  if (judgement.reason.empty())
    judgement.reason = without_mean(data, claim.threshold_condition, claim.measure, others);
  if (!judgement.reason.empty()) return std::nullopt;
  return statistics::mean(others);
}

/// Takes back what is said while runs are missing whose mean is the threshold.
void await_threshold(const StudyData& data, const ClaimSpec& claim, Judgement& judgement) {
  const std::size_t missing = judgement.planned_against - judgement.n_against;
  if (claim.threshold_condition.empty() || missing == 0) return;
  judgement.verdict = Verdict::not_testable;
  judgement.reason =
      fmt::format("The threshold is that of {} so far: {} of it missing move it.",
                  data.study.find(claim.threshold_condition)->label(), counted(missing, "run"));
}

/// Which regular gaits occur that should not, or should and do not.
std::string gaits_misfit(const ClaimSpec& claim, const std::set<std::string>& occurring) {
  std::vector<std::string> besides, absent;
  for (const std::string& name : occurring)
    if (!claim.only.empty() &&
        std::ranges::none_of(claim.only, [&](const std::string& claimed) { return is_gait(name, claimed); }))
      besides.push_back(name);
  for (const std::string& claimed : claim.includes)
    if (std::ranges::none_of(occurring, [&](const std::string& name) { return is_gait(name, claimed); }))
      absent.push_back(claimed);
  std::string text = besides.empty() ? "" : fmt::format("Besides: {}.", fmt::join(besides, ", "));
  if (!absent.empty()) text += fmt::format("{}Absent: {}.", text.empty() ? "" : " ", fmt::join(absent, ", "));
  return text;
}

}  // namespace

Judgement judge_count(const StudyData& data, const ClaimSpec& claim, const std::vector<double>& sample) {
  Judgement judgement = begin_judgement(data, claim, sample.size());
  judgement.quantity = "share of runs";
  judgement.reason = too_few(data, claim.condition, judgement.n, 1);
  if (!judgement.reason.empty()) return judgement;
  const auto threshold = threshold_of(data, claim, judgement);
  if (!threshold) return judgement;
  const auto successes =
      to_index(std::ranges::count_if(sample, [&](double value) { return value >= *threshold; }));
  const statistics::Count ours{successes, sample.size()};
  judgement.estimate = static_cast<double>(successes) / static_cast<double>(sample.size());
  judgement.interval = *statistics::clopper_pearson(ours, confidence);
  judgement.ours = fmt::format("{} of {}, {}", successes, sample.size(),
                               share_text(*judgement.estimate, judgement.interval));
  if (!claim.threshold_condition.empty())
    judgement.ours += fmt::format("; threshold {}{}", number_text(*threshold),
                                  data.unit_of(claim.measure, claim.threshold_condition));
  if (claim.runs > 0 && judgement.n < 2)
    judgement.reason = too_few(data, claim.condition, judgement.n, 2);
  else if (claim.runs > 0)
    conclude_published_count(claim, ours, judgement);
  else
    conclude_bounded_count(claim, successes, judgement);
  await_threshold(data, claim, judgement);
  return judgement;
}

Judgement judge_gaits(const StudyData& data, const ClaimSpec& claim) {
  const GaitCounts counts = count_gaits(data, claim.measure, claim.condition);
  Judgement judgement = begin_judgement(data, claim, counts.n);
  judgement.quantity = "gaits";
  judgement.reason = too_few(data, claim.condition, judgement.n, 1);
  if (!judgement.reason.empty()) return judgement;
  std::set<std::string> occurring;
  for (const auto& [name, count] : counts.runs) {
    judgement.ours += fmt::format("{}{} {}", judgement.ours.empty() ? "" : ", ", name, count);
    if (is_regular(name)) occurring.insert(name);
  }
  const bool missing = judgement.n < judgement.planned;
  judgement.verdict = gaits_verdict(occurring, claim.includes, claim.only, missing);
  if (judgement.verdict == Verdict::not_testable)
    judgement.reason =
        fmt::format("The {} missing can still decide.", counted(judgement.planned - judgement.n, "run"));
  else if (occurring.empty())
    judgement.reason = "No run has a regular gait.";
  else if (judgement.verdict == Verdict::confirmed)
    judgement.reason =
        claim.only.empty() ? "All gaits that are named occur." : "No other regular gait occurs.";
  else
    judgement.reason = gaits_misfit(claim, occurring);
  return judgement;
}

}  // namespace amble::report
