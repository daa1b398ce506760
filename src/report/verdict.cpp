#include "amble/report/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "amble/core/index.hpp"
#include "amble/report/number_text.hpp"
#include "amble/report/verdict_kinds.hpp"
#include "amble/statistics/multiple_tests.hpp"

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
      return judge_count(data, claim);
    case ledger::ClaimKind::gaits:
      return judge_gaits(data, claim);
    case ledger::ClaimKind::plateau:
      return judge_plateau(data, claim);
  }
  return {};
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

std::string without_mean(const StudyData& data, const std::string& condition,
                         const std::vector<double>& values) {
  const auto never =
      to_index(std::ranges::count_if(values, [](double value) { return !std::isfinite(value); }));
  if (never == 0) return {};
  return fmt::format("{} of {} of {} never reached it: there is no mean.", never,
                     counted(values.size(), "run"), data.study.find(condition)->label());
}

std::vector<Judgement> judge(const StudyData& data) {
  const auto& claims = data.study.claims;
  std::vector<Judgement> judgements;
  judgements.reserve(claims.size());
  for (const ledger::ClaimSpec& claim : claims) judgements.push_back(judge_one(data, claim));

  std::vector<std::size_t> family;
  std::vector<double> p;
  for (std::size_t i = 0; i < claims.size(); ++i)
    if (claims[i].kind == ledger::ClaimKind::difference && judgements[i].p) {
      family.push_back(i);
      p.push_back(*judgements[i].p);
    }
  const auto adjusted = statistics::holm(p);
  for (std::size_t k = 0; k < family.size(); ++k) {
    judgements[family[k]].p_holm = adjusted[k];
    conclude_difference(claims[family[k]], judgements[family[k]]);
  }
  return judgements;
}

std::array<std::size_t, 4> count_verdicts(const std::vector<Judgement>& judgements) {
  std::array<std::size_t, 4> counts{};
  for (const Judgement& judgement : judgements) ++counts[to_index(judgement.verdict)];
  return counts;
}

}  // namespace amble::report
