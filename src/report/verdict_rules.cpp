#include "amble/report/verdict_rules.hpp"

#include <algorithm>

namespace amble::report {

Verdict difference_verdict(ledger::Relation relation, statistics::Direction direction, double p, double alpha,
                           bool not_inferior) {
  const bool significant = p < alpha, is_claim_of_no_loss = relation == ledger::Relation::not_less;
  if (is_claim_of_no_loss && not_inferior) return Verdict::confirmed;
  if (direction == statistics::Direction::less)
    return significant ? Verdict::contradicted : Verdict::not_confirmed;
  if (significant && direction == statistics::Direction::greater) return Verdict::confirmed;
  return is_claim_of_no_loss ? Verdict::compatible : Verdict::not_confirmed;
}

Verdict bounds_verdict(const statistics::Interval& interval, double at_least, double at_most) {
  if (interval.upper < at_least || interval.lower > at_most) return Verdict::contradicted;
  return interval.lower >= at_least && interval.upper <= at_most ? Verdict::confirmed
                                                                 : Verdict::not_confirmed;
}

Verdict agreement_verdict(const Agreement& agreement) {
  if (agreement.p < agreement.alpha) return Verdict::contradicted;
  if (!agreement.inside || agreement.spreads_differ) return Verdict::not_confirmed;
  return agreement.equivalent ? Verdict::confirmed : Verdict::compatible;
}

Verdict count_verdict(std::size_t successes, std::size_t missing, double at_least, double at_most) {
  const double fewest = static_cast<double>(successes), most = static_cast<double>(successes + missing);
  if (fewest >= at_least && most <= at_most) return Verdict::confirmed;
  return most < at_least || fewest > at_most ? Verdict::contradicted : Verdict::not_testable;
}

bool is_gait(std::string_view name, std::string_view claimed) {
  return name == claimed || (name.starts_with(claimed) && name.substr(claimed.size()).starts_with(' '));
}

Verdict gaits_verdict(const std::set<std::string>& occurring, const std::vector<std::string>& includes,
                      const std::vector<std::string>& only, bool missing) {
  const auto occurs = [&](const std::string& claimed) {
    return std::ranges::any_of(occurring, [&](const auto& name) { return is_gait(name, claimed); });
  };
  const auto is_allowed = [&](const std::string& name) {
    return std::ranges::any_of(only, [&](const auto& claimed) { return is_gait(name, claimed); });
  };
  // Runs to come can add gaits, but not take any away.
  if (!only.empty() && !std::ranges::all_of(occurring, is_allowed)) return Verdict::contradicted;
  const bool all_occur = std::ranges::all_of(includes, occurs);
  if (missing && (!all_occur || !only.empty())) return Verdict::not_testable;
  if (occurring.empty()) return Verdict::not_confirmed;
  return all_occur ? Verdict::confirmed : Verdict::contradicted;
}

}  // namespace amble::report
