#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/figures/svg.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/verdict_kinds.hpp"
#include "amble/statistics/bootstrap.hpp"
#include "amble/statistics/descriptive.hpp"
#include "amble/statistics/hypothesis_tests.hpp"

namespace amble::report {
namespace {

using ledger::ClaimSpec;
using ledger::TwoSampleTest;

/// Two conditions with the runs that are used.
struct TwoSamples {
  std::vector<double> first, second;
};

bool is_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

std::optional<double> mean_of(const std::vector<double>& values) {
  return values.empty() || !is_finite(values) ? std::nullopt : std::optional(statistics::mean(values));
}

/// Says so if one of them has no mean.
bool have_means(const StudyData& data, const ClaimSpec& claim, const TwoSamples& samples,
                Judgement& judgement) {
  judgement.reason = without_mean(data, claim.condition, claim.measure, samples.first);
  const std::string against = without_mean(data, claim.against, claim.measure, samples.second);
  if (!judgement.reason.empty() && !against.empty()) judgement.reason += " ";
  judgement.reason += against;
  return judgement.reason.empty();
}

/// Sample sizes, and the means of samples that have one; says so if there are too few runs.
bool begin_two(const StudyData& data, const ClaimSpec& claim, const TwoSamples& samples, std::size_t fewest,
               Judgement& judgement) {
  judgement = begin_judgement(data, claim, samples.first.size());
  judgement.n_against = samples.second.size();
  judgement.planned_against = data.planned(claim.against);
  judgement.mean = mean_of(samples.first);
  judgement.mean_against = mean_of(samples.second);
  judgement.reason = too_few(data, claim.condition, judgement.n, fewest);
  if (judgement.reason.empty()) judgement.reason = too_few(data, claim.against, judgement.n_against, fewest);
  return judgement.reason.empty();
}

void use_t_test(const std::optional<statistics::TTest>& test, double margin, Judgement& judgement) {
  judgement.quantity = "difference of means";
  if (!test) {
    judgement.reason =
        "All runs of each condition have the same value, which leaves the test without a scale.";
    return;
  }
  judgement.p = test->p;
  judgement.estimate = test->difference;
  judgement.interval = test->interval;
  if (margin > 0.0) judgement.p_equivalence = statistics::non_inferiority_p(*test, margin);
}

void use_mann_whitney(const TwoSamples& samples, double alpha, Judgement& judgement) {
  const double smallest = statistics::smallest_mann_whitney_p(samples.first.size(), samples.second.size());
  if (smallest >= alpha) {
    judgement.reason = fmt::format("Too few runs: with {} and {} no outcome of this test has a p below {}.",
                                   samples.first.size(), samples.second.size(), p_number(smallest));
    return;
  }
  judgement.p = statistics::mann_whitney(samples.first, samples.second)->p;
  const auto superiority = statistics::vargha_delaney(samples.first, samples.second, confidence);
  judgement.quantity = "A12";
  judgement.estimate = superiority->a12;
  judgement.interval = superiority->interval;
}

/// "18 of 20 runs reached it against 20 of 20".
std::string reached_text(const TwoSamples& samples) {
  const auto reached = [](const std::vector<double>& values) {
    return std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
  };
  return fmt::format("{} of {} reached it against {} of {}", reached(samples.first),
                     counted(samples.first.size(), "run"), reached(samples.second), samples.second.size());
}

std::string two_means_text(const Judgement& judgement, std::string_view unit) {
  const int decimals = decimals_for({*judgement.mean, *judgement.mean_against});
  return fmt::format("{}{} against {}{}", number_text(*judgement.mean, decimals), unit,
                     number_text(*judgement.mean_against, decimals), unit);
}

/// "at least 8", "1.18 to 1.54"; of a plateau "at most 5 %".
std::string bounds_text(const ClaimSpec& claim) {
  const auto text = [&claim](double bound) {
    return claim.kind == ledger::ClaimKind::plateau ? figures::number(100.0 * bound) + " %"
                                                    : figures::number(bound, 3);
  };
  if (claim.at_most == ledger::unbounded) return "at least " + text(claim.at_least);
  if (claim.at_least == -ledger::unbounded) return "at most " + text(claim.at_most);
  return text(claim.at_least) + " to " + text(claim.at_most);
}

/// Verdict and reason from an interval and the claimed range.
void conclude_bounds(const ClaimSpec& claim, Judgement& judgement) {
  judgement.verdict = bounds_verdict(*judgement.interval, claim.at_least, claim.at_most);
  const std::string claimed = bounds_text(claim);
  if (judgement.verdict == Verdict::confirmed)
    judgement.reason = fmt::format("The whole interval is in the claimed range ({}).", claimed);
  else if (judgement.verdict == Verdict::contradicted)
    judgement.reason = fmt::format("The whole interval is outside the claimed range ({}).", claimed);
  else {
    const bool inside = *judgement.estimate >= claim.at_least && *judgement.estimate <= claim.at_most;
    judgement.reason = fmt::format(
        "The interval reaches across a bound of the claimed range ({}); the estimate itself lies {} it.",
        claimed, inside ? "inside" : "outside");
  }
}

void use_bootstrap(const std::optional<statistics::BootstrapInterval>& found, Judgement& judgement) {
  if (!found) {
    judgement.reason = "The denominator can be zero, which leaves the ratio without an interval.";
    return;
  }
  judgement.estimate = found->estimate;
  judgement.interval = found->interval;
}

Judgement judge_ratio_within(const StudyData& data, const ClaimSpec& claim) {
  std::vector<double> numerators, denominators;
  for (const ledger::Record* run : data.runs(claim.condition)) {
    const auto above = data.value(*run, claim.measure), below = data.value(*run, claim.base_measure);
    if (!above || !below) continue;
    numerators.push_back(*above);
    denominators.push_back(*below);
  }
  Judgement judgement = begin_judgement(data, claim, numerators.size());
  judgement.quantity = "ratio of sums";
  judgement.reason = too_few(data, claim.condition, judgement.n, fewest_runs(claim.kind));
  if (!judgement.reason.empty()) return judgement;
  judgement.mean = mean_of(numerators);
  judgement.mean_against = mean_of(denominators);
  for (const auto& [measure, values] :
       {std::pair(&claim.measure, &numerators), std::pair(&claim.base_measure, &denominators)})
    if (judgement.reason.empty()) judgement.reason = without_mean(data, claim.condition, *measure, *values);
  if (!judgement.reason.empty()) return judgement;
  use_bootstrap(statistics::bootstrap_paired_ratio(numerators, denominators), judgement);
  return judgement;
}

Judgement judge_ratio_between(const StudyData& data, const ClaimSpec& claim) {
  const TwoSamples samples{data.values(claim.condition, claim.measure),
                           data.values(claim.against, claim.measure)};
  Judgement judgement;
  const bool enough = begin_two(data, claim, samples, fewest_runs(claim.kind), judgement);
  judgement.quantity = "ratio of means";
  if (enough && have_means(data, claim, samples, judgement))
    use_bootstrap(statistics::bootstrap_ratio(samples.first, samples.second, statistics::mean), judgement);
  return judgement;
}

/// What there is to add of a claim that the condition does not do worse.
std::string no_loss_text(const ClaimSpec& claim, const Judgement& judgement, bool not_inferior) {
  std::string text;
  if (claim.margin > 0.0)
    text = fmt::format(" That it is not worse by more than the stated {} is {} (one-sided {}).",
                       figures::number(claim.margin, 9), not_inferior ? "shown" : "not shown",
                       p_text(*judgement.p_equivalence));
  else if (judgement.verdict == Verdict::compatible)
    text = " No margin was stated, so no test can show that it does not do worse.";
  if (judgement.verdict == Verdict::compatible)
    text += " The data do not contradict the claim; that is not evidence for it.";
  return text;
}

/// How the spread and mean of a value compare with the published ones.
std::string agreement_text(const ClaimSpec& claim, const Judgement& judgement, const Agreement& agreement) {
  std::string text = fmt::format(
      " The spreads {} (F test, {}). That the means differ by less than {} of the published one is {} (two "
      "one-sided tests, {}).",
      agreement.spreads_differ ? "differ significantly" : "do not differ significantly",
      p_text(*judgement.p_spread), percent_text(claim.within), agreement.equivalent ? "shown" : "not shown",
      p_text(*judgement.p_equivalence));
  switch (judgement.verdict) {
    case Verdict::contradicted:
      return " The means differ significantly." + text;
    case Verdict::compatible:
      return text + " The data do not contradict the claim; that is not evidence for it.";
    default:
      return text;
  }
}

}  // namespace

Judgement judge_difference(const StudyData& data, const ClaimSpec& claim) {
  const TwoSamples samples{data.values(claim.condition, claim.measure),
                           data.values(claim.against, claim.measure)};
  Judgement judgement;
  if (!begin_two(data, claim, samples, 2, judgement)) return judgement;
  const bool rank_test = claim.test == TwoSampleTest::mann_whitney;
  if (!rank_test && !have_means(data, claim, samples, judgement)) return judgement;
  switch (claim.test) {
    case TwoSampleTest::student:
      judgement.test = "Student’s t";
      use_t_test(statistics::student_t_test(samples.first, samples.second, confidence), claim.margin,
                 judgement);
      break;
    case TwoSampleTest::welch:
      judgement.test = "Welch’s t";
      use_t_test(statistics::welch_t_test(samples.first, samples.second, confidence), claim.margin,
                 judgement);
      break;
    case TwoSampleTest::mann_whitney:
      judgement.test = "Mann–Whitney";
      use_mann_whitney(samples, claim.alpha, judgement);
      break;
  }
  const std::string of_first = data.unit_of(claim.measure, claim.condition);
  const std::string unit = of_first == data.unit_of(claim.measure, claim.against) ? of_first : "";
  judgement.ours =
      judgement.mean && judgement.mean_against ? two_means_text(judgement, unit) : reached_text(samples);
  if (judgement.estimate)
    judgement.ours +=
        fmt::format("; {} {}", rank_test ? "A12" : "difference",
                    estimate_text(*judgement.estimate, judgement.interval, rank_test ? "" : unit));
  return judgement;
}

void conclude_difference(const ClaimSpec& claim, Judgement& judgement) {
  const double neutral = claim.test == TwoSampleTest::mann_whitney ? 0.5 : 0.0;
  const auto direction = statistics::direction_of(*judgement.estimate - neutral);
  // One-sided at alpha / 2, as the end of an interval at 1 − alpha.
  const bool not_inferior = judgement.p_equivalence && *judgement.p_equivalence < 0.5 * claim.alpha;
  judgement.verdict =
      difference_verdict(claim.relation, direction, *judgement.p_holm, claim.alpha, not_inferior);
  const bool significant = *judgement.p_holm < claim.alpha;
  const std::string_view where =
      direction == statistics::Direction::less      ? "The difference points the other way"
      : direction == statistics::Direction::greater ? "The difference points as claimed"
                                                    : "There is no difference";
  judgement.reason =
      direction == statistics::Direction::equal
          ? std::string(where) + "."
          : fmt::format("{} {} significant at {} after Holm’s adjustment.", where,
                        significant ? "and is" : "but is not", figures::number(claim.alpha, 9));
  if (claim.relation == ledger::Relation::not_less)
    judgement.reason += no_loss_text(claim, judgement, not_inferior);
}

Judgement judge_ratio(const StudyData& data, const ClaimSpec& claim) {
  Judgement judgement =
      claim.against.empty() ? judge_ratio_within(data, claim) : judge_ratio_between(data, claim);
  if (!judgement.interval) return judgement;
  judgement.ours = estimate_text(*judgement.estimate, judgement.interval, " ×");
  conclude_bounds(claim, judgement);
  return judgement;
}

Judgement judge_value(const StudyData& data, const ClaimSpec& claim) {
  const auto sample = data.values(claim.condition, claim.measure);
  Judgement judgement = begin_judgement(data, claim, sample.size());
  judgement.quantity = "mean";
  judgement.reason = too_few(data, claim.condition, judgement.n, 2);
  if (judgement.reason.empty()) judgement.reason = without_mean(data, claim.condition, claim.measure, sample);
  if (!judgement.reason.empty()) return judgement;
  const auto moments = *statistics::moments(sample);
  const statistics::Moments published{to_index(claim.runs), claim.mean, claim.sd};
  const auto test = *statistics::welch_t_test(moments, published, 1.0 - claim.alpha);
  judgement.test = "Welch’s t";
  judgement.p = test.p;
  judgement.mean = judgement.estimate = moments.mean;
  judgement.interval = *statistics::mean_interval(moments, 1.0 - claim.alpha);
  const auto theirs = *statistics::mean_interval(published, 1.0 - claim.alpha);
  judgement.p_spread = statistics::f_test(moments, published)->p;
  judgement.p_equivalence = statistics::equivalence_p(test, claim.within * std::abs(claim.mean));
  const Agreement agreement{.p = test.p,
                            .alpha = claim.alpha,
                            .inside = judgement.interval->contains(claim.mean),
                            .spreads_differ = *judgement.p_spread < claim.alpha,
                            .equivalent = *judgement.p_equivalence < 0.5 * claim.alpha};
  judgement.verdict = agreement_verdict(agreement);
  judgement.ours = fmt::format(
      "{}, sd {}",
      estimate_text(moments.mean, judgement.interval, data.unit_of(claim.measure, claim.condition)),
      number_text(moments.sd));
  judgement.reason =
      fmt::format("Published {} {}; the published mean lies {} our interval.{}", number_text(claim.mean),
                  interval_text(theirs, decimals_for({claim.mean, theirs.lower, theirs.upper})),
                  agreement.inside ? "in" : "outside", agreement_text(claim, judgement, agreement));
  return judgement;
}

Judgement judge_plateau(const StudyData& data, const ClaimSpec& claim) {
  std::vector<double> gains;
  for (const ledger::Record* run : data.runs(claim.condition)) {
    const int last = run->generations - 1;
    if (last <= claim.from_generation) continue;
    const double best = run->best_after(last);
    // A run that got nowhere gains nothing.
    gains.push_back(best > 0.0 ? (best - run->best_after(claim.from_generation)) / best : 0.0);
  }
  Judgement judgement = begin_judgement(data, claim, gains.size());
  judgement.quantity = "mean gain, share of the final best";
  judgement.reason =
      too_few(data, claim.condition, data.runs(claim.condition).size(), fewest_runs(claim.kind));
  if (judgement.reason.empty() && gains.size() < fewest_runs(claim.kind))
    judgement.reason = fmt::format("The runs are not longer than {} generations.", claim.from_generation);
  if (!judgement.reason.empty()) return judgement;
  const auto found = *statistics::bootstrap(gains, statistics::mean);
  judgement.estimate = found.estimate;
  judgement.interval = found.interval;
  judgement.ours =
      fmt::format("{} [{}, {}] % of the final best", number_text(100.0 * found.estimate, 1),
                  number_text(100.0 * found.interval.lower, 1), number_text(100.0 * found.interval.upper, 1));
  conclude_bounds(claim, judgement);
  return judgement;
}

}  // namespace amble::report
