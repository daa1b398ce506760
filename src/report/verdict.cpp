#include "amble/report/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/verdict_kinds.hpp"
#include "amble/statistics/hypothesis_tests.hpp"

namespace amble::report {
namespace {

Judgement judge_one(const StudyData& data, const ledger::ClaimSpec& claim) {
  switch (claim.kind) {
    case ledger::ClaimKind::difference:
      return judge_difference(data, claim);
    case ledger::ClaimKind::ratio:
      return judge_ratio(data, claim);
    case ledger::ClaimKind::value:
      return judge_value(data, claim);
    case ledger::ClaimKind::count:
      return judge_count(data, claim, data.values(claim.condition, claim.measure));
    case ledger::ClaimKind::gaits:
      return judge_gaits(data, claim);
    case ledger::ClaimKind::plateau:
      return judge_plateau(data, claim);
  }
  return {};
}

/// Adjusts what `member` has of the claims' p values by Holm's method.
void adjust(const std::vector<std::size_t>& family, std::vector<Judgement>& judgements,
            std::optional<double> Judgement::*member, std::optional<double> Judgement::*adjusted) {
  std::vector<std::size_t> having;
  std::vector<double> p;
  for (const std::size_t i : family)
    if (judgements[i].*member) {
      having.push_back(i);
      p.push_back(*(judgements[i].*member));
    }
  const auto holm = statistics::holm(p);
  for (std::size_t k = 0; k < having.size(); ++k) judgements[having[k]].*adjusted = holm[k];
}

/// The verdicts on all claims of differences of one relation, which are a family. A claim of not_less is none
/// of superiority: counted among these it would only take from their power.
void conclude_differences(const std::vector<ledger::ClaimSpec>& claims, ledger::Relation relation,
                          std::vector<Judgement>& judgements) {
  std::vector<std::size_t> family;
  for (std::size_t i = 0; i < claims.size(); ++i)
    if (claims[i].kind == ledger::ClaimKind::difference && claims[i].relation == relation && judgements[i].p)
      family.push_back(i);
  adjust(family, judgements, &Judgement::p, &Judgement::p_holm);
  adjust(family, judgements, &Judgement::p_equivalence, &Judgement::p_equivalence);
  for (const std::size_t i : family) conclude_difference(claims[i], judgements[i]);
}

/// Takes back what too few runs say.
void need_enough_runs(const StudyData& data, const ledger::ClaimSpec& claim, Judgement& judgement) {
  if (judgement.verdict == Verdict::not_testable) return;
  const std::string& other = claim.against.empty() ? claim.threshold_condition : claim.against;
  std::string lacking = too_few(data, claim.condition, judgement.n, fewest_judged);
  if (lacking.empty() && judgement.planned_against > 0)
    lacking = too_few(data, other, judgement.n_against, fewest_judged);
  if (lacking.empty()) return;
  judgement.verdict = Verdict::not_confirmed;
  judgement.reason = lacking + " " + judgement.reason;
}

}  // namespace

Judgement begin_judgement(const StudyData& data, const ledger::ClaimSpec& claim, std::size_t n) {
  Judgement judgement;
  judgement.n = n;
  judgement.planned = data.planned(claim.condition);
  return judgement;
}

std::string too_few(const StudyData& data, const std::string& condition, std::size_t n, std::size_t needed) {
  if (n >= needed) return {};
  const std::string& label = data.study.find(condition)->label();
  if (n == 0) return fmt::format("No finished run of {} has what is measured.", label);
  return fmt::format("Too few runs: {} has {}, {} are needed.", label, n, needed);
}

std::string without_mean(const StudyData& data, const std::string& condition, const std::string& measure,
                         const std::vector<double>& values) {
  const auto never =
      to_index(std::ranges::count_if(values, [](double value) { return !std::isfinite(value); }));
  if (never == 0) return {};
  const bool is_cost = measure.ends_with(".cost_of_transport");
  return fmt::format("{} of {} of {} {}: there is no mean.", never, counted(values.size(), "run"),
                     data.study.find(condition)->label(), is_cost ? "went nowhere" : "never reached it");
}

Judgement judge_count_of(const StudyData& data, const ledger::ClaimSpec& claim,
                         const std::vector<double>& sample) {
  Judgement judgement = judge_count(data, claim, sample);
  need_enough_runs(data, claim, judgement);
  return judgement;
}

std::vector<Judgement> judge(const StudyData& data) {
  const auto& claims = data.study.claims;
  std::vector<Judgement> judgements;
  judgements.reserve(claims.size());
  for (const ledger::ClaimSpec& claim : claims) judgements.push_back(judge_one(data, claim));

  for (const auto relation : {ledger::Relation::greater, ledger::Relation::not_less})
    conclude_differences(claims, relation, judgements);
  for (std::size_t i = 0; i < claims.size(); ++i) need_enough_runs(data, claims[i], judgements[i]);
  return judgements;
}

std::array<std::size_t, verdict_names.size()> count_verdicts(const std::vector<Judgement>& judgements) {
  std::array<std::size_t, verdict_names.size()> counts{};
  for (const Judgement& judgement : judgements) ++counts[to_index(judgement.verdict)];
  return counts;
}

}  // namespace amble::report
