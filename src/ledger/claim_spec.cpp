#include "amble/ledger/claim_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/gait/gait.hpp"
#include "amble/io/text.hpp"
#include "amble/ledger/measures.hpp"
#include "amble/ledger/study_spec.hpp"

namespace amble::ledger {
namespace {

/// Beyond it squares of a sample have no meaning left in a double.
constexpr double largest_value = 1e12;

/// Checks of one claim, each with the place of its key.
class ClaimCheck {
 public:
  ClaimCheck(const StudySpec& study, std::size_t index) : study_(study), index_(index) {}

  void that(bool holds, std::string_view key, std::string_view expected) const {
    if (holds) return;
    const std::string path = fmt::format("claims[{}].{}", index_, key);
    throw study_.error_at(path, fmt::format("'{}': expected {}", path, expected));
  }
  void condition(std::string_view key, const std::string& name) const {
    that(study_.find(name) != nullptr, key,
         fmt::format("the name of a condition, not \"{}\"", io::printable(name)));
  }
  void measure(std::string_view key, const std::string& name) const {
    const std::string not_this = fmt::format("not \"{}\"", io::printable(name));
    if (const auto dot = name.find('.'); dot != std::string::npos)
      that(study_.find_test(name.substr(0, dot)) != nullptr, key,
           fmt::format("a measure of a test that the study has ({}); {}", test_names(), not_this));
    that(is_measure(study_, name), key, fmt::format("{}; {}", measure_names(), not_this));
  }
  /// Conditions whose champions a test does not try have none of its measures.
  void tried(std::string_view key, const std::string& condition, const TestSpec* test) const {
    if (test == nullptr || condition.empty()) return;
    that(test->applies_to(condition), key,
         fmt::format("a condition that test '{}' tries (its 'conditions'), not \"{}\"", test->name,
                     io::printable(condition)));
  }
  std::string test_names() const {
    std::vector<std::string> names;
    for (const TestSpec& test : study_.tests) names.push_back(io::printable(test.name));
    return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
  }
  /// Names of regular gaits, "walk" for both walks among them: no others can occur.
  void gaits(std::string_view key, const std::vector<std::string>& names) const {
    const auto regular = std::span(gait::gait_names).first(to_index(gait::Gait::irregular));
    for (const std::string& name : names)
      that(std::ranges::find(regular, name) != regular.end(), key,
           fmt::format("{}; not \"{}\"", fmt::join(regular, ", "), io::printable(name)));
  }

 private:
  const StudySpec& study_;
  std::size_t index_;
};

/// A key of some kinds of claims, and whether a claim says more there than nothing.
struct OwnKey {
  std::string_view name;
  std::initializer_list<ClaimKind> kinds;
  bool (*is_set)(const ClaimSpec&);
};

/// What a kind does not use would look like a rule and be none.
void check_unused(const ClaimSpec& claim, const ClaimCheck& check) {
  using enum ClaimKind;
  static const ClaimSpec nothing;
  static const std::array keys{
      OwnKey{"against", {difference, ratio}, [](const ClaimSpec& c) { return !c.against.empty(); }},
      OwnKey{"base_measure", {ratio}, [](const ClaimSpec& c) { return !c.base_measure.empty(); }},
      OwnKey{"relation", {difference}, [](const ClaimSpec& c) { return c.relation != nothing.relation; }},
      OwnKey{"test", {difference}, [](const ClaimSpec& c) { return c.test != nothing.test; }},
      OwnKey{"alpha", {difference, value}, [](const ClaimSpec& c) { return c.alpha != nothing.alpha; }},
      OwnKey{"margin", {difference}, [](const ClaimSpec& c) { return c.margin != nothing.margin; }},
      OwnKey{"at_least", {ratio, count}, [](const ClaimSpec& c) { return c.at_least > -unbounded; }},
      OwnKey{"at_most", {ratio, count, plateau}, [](const ClaimSpec& c) { return c.at_most < unbounded; }},
      OwnKey{"threshold", {count}, [](const ClaimSpec& c) { return c.threshold > -unbounded; }},
      OwnKey{
          "threshold_condition", {count}, [](const ClaimSpec& c) { return !c.threshold_condition.empty(); }},
      OwnKey{"mean", {value}, [](const ClaimSpec& c) { return c.mean != nothing.mean; }},
      OwnKey{"sd", {value}, [](const ClaimSpec& c) { return c.sd != nothing.sd; }},
      OwnKey{"within", {value}, [](const ClaimSpec& c) { return c.within != nothing.within; }},
      OwnKey{"runs", {value, count}, [](const ClaimSpec& c) { return c.runs != nothing.runs; }},
      OwnKey{"successes", {count}, [](const ClaimSpec& c) { return c.successes != nothing.successes; }},
      OwnKey{"includes", {gaits}, [](const ClaimSpec& c) { return !c.includes.empty(); }},
      OwnKey{"only", {gaits}, [](const ClaimSpec& c) { return !c.only.empty(); }},
      OwnKey{"from_generation", {plateau}, [](const ClaimSpec& c) { return c.from_generation != 0; }}};
  for (const OwnKey& key : keys)
    check.that(!key.is_set(claim) || std::ranges::find(key.kinds, claim.kind) != key.kinds.end(), key.name,
               fmt::format("nothing: a claim of kind \"{}\" does not use it",
                           claim_kind_names[to_index(claim.kind)]));
}

void check_ratio(const ClaimSpec& claim, const ClaimCheck& check) {
  check.that(claim.against.empty() != claim.base_measure.empty(), "against",
             "either 'against' (a condition) or 'base_measure' for a ratio");
  if (claim.against.empty())
    check.measure("base_measure", claim.base_measure);
  else
    check.condition("against", claim.against);
  check.that(claim.at_least > -unbounded || claim.at_most < unbounded, "at_least",
             "at_least, at_most or both for a ratio");
}

void check_count(const ClaimSpec& claim, const ClaimCheck& check, bool is_recorded) {
  check.that((claim.threshold > -unbounded) != !claim.threshold_condition.empty(), "threshold",
             "either 'threshold' or 'threshold_condition' for a count");
  if (!claim.threshold_condition.empty()) check.condition("threshold_condition", claim.threshold_condition);
  const bool bounded = claim.at_least > -unbounded || claim.at_most < unbounded;
  check.that(bounded != (claim.runs > 0), "at_least",
             "either bounds (at_least, at_most) or a published count (successes, runs)");
  check.that(claim.successes <= claim.runs, "successes", "at most 'runs', the number of runs that it is of");
  for (const auto& [key, bound] : {std::pair{"at_least", claim.at_least}, {"at_most", claim.at_most}})
    check.that(is_recorded || !std::isfinite(bound) || bound == std::floor(bound), key,
               fmt::format("a whole number of runs for a count, not {}", bound));
}

void check_difference(const ClaimSpec& claim, const ClaimCheck& check) {
  check.condition("against", claim.against);
  check.that(claim.margin == 0.0 || claim.relation == Relation::not_less, "margin",
             "0 unless relation = \"not_less\"");
  check.that(claim.margin == 0.0 || claim.test != TwoSampleTest::mann_whitney, "margin",
             "0 for ranks: test = \"student\" or \"welch\" have a margin");
}

}  // namespace

void ClaimSpec::describe(io::SettingsVisitor& visitor) {
  visitor.text("text", text, {"the sentence"});
  visitor.text("source", source, {"where it was claimed"});
  visitor.text("figure", figure, {"the published figure, as text"});
  visitor.choice("kind", kind, claim_kind_names, {"the rule that judges it"});
  visitor.text("measure", measure, {"what is measured in each run"});
  visitor.text("condition", condition, {"whose runs it is about"});
  visitor.text("against", against, {"difference, ratio: the other condition"});
  visitor.text("base_measure", base_measure, {"ratio: the denominator, in the same condition"});
  visitor.choice("relation", relation, relation_names, {"difference: what the condition is to the other"});
  visitor.choice("test", test, two_sample_test_names, {"difference: the test that decides"});
  visitor.number("alpha", alpha, {1e-9, 0.5}, {"difference, value: level of significance"});
  visitor.number("margin", margin, {0.0, largest_value},
                 {"difference that is not_less: by how much less is no worse; 0: not stated"});
  visitor.number("at_least", at_least, {-unbounded, largest_value},
                 {"ratio, count: lower bound; -inf: none"});
  visitor.number("at_most", at_most, {-largest_value, unbounded},
                 {"ratio, count, plateau: upper bound; inf: none"});
  visitor.number("threshold", threshold, {-unbounded, largest_value},
                 {"count: runs whose measure is at least this; -inf: not given"});
  visitor.text("threshold_condition", threshold_condition,
               {"count: the threshold is the mean of the measure in this condition"});
  visitor.number("mean", mean, {-largest_value, largest_value}, {"value: the published mean"});
  visitor.number("sd", sd, {0.0, largest_value}, {"value: the published standard deviation"});
  visitor.number("within", within, {1e-9, 1.0},
                 {"value: means within this share of the published one are equivalent"});
  visitor.integer("runs", runs, {0, 1e9}, {"value, count: runs behind the published figure"});
  visitor.integer("successes", successes, {0, 1e9}, {"count: the published count"});
  visitor.texts("includes", includes, {"gaits: all of these must occur"});
  visitor.texts("only", only, {"gaits: nothing else may occur, irregular gaits apart"});
  visitor.integer("from_generation", from_generation, {0, 1e9}, {"plateau: from when on the gain counts"});
}

void check_claim(const StudySpec& study, std::size_t index, bool is_recorded) {
  const ClaimSpec& claim = study.claims[index];
  const ClaimCheck check(study, index);
  check.that(!claim.text.empty(), "text", "a sentence");
  check.that(claim.at_least <= claim.at_most, "at_least",
             fmt::format("at most 'at_most' = {}, not {}", claim.at_most, claim.at_least));
  check.condition("condition", claim.condition);
  if (!is_recorded) {
    check_unused(claim, check);
    check.that(
        claim.against.empty() || claim.against != claim.condition, "against",
        fmt::format("another condition than 'condition', not \"{}\" again", io::printable(claim.against)));
  }
  if (claim.kind == ClaimKind::gaits) {
    check.that(
        study.find_test(claim.measure) != nullptr, "measure",
        fmt::format("the name of a test ({}), not \"{}\"", check.test_names(), io::printable(claim.measure)));
    check.tried("condition", claim.condition, study.find_test(claim.measure));
    check.that(!claim.includes.empty() || !claim.only.empty(), "includes",
               "names of gaits here or in 'only'");
    check.gaits("includes", claim.includes);
    check.gaits("only", claim.only);
    return;
  }
  check.measure("measure", claim.measure);
  const TestSpec* const test = test_of(study, claim.measure);
  check.tried("condition", claim.condition, test);
  if (claim.kind == ClaimKind::difference) check_difference(claim, check);
  if (claim.kind == ClaimKind::ratio) check_ratio(claim, check);
  if (claim.kind == ClaimKind::count) check_count(claim, check, is_recorded);
  if (claim.kind == ClaimKind::value)
    check.that(claim.sd > 0.0 && claim.runs > 1, "sd", "sd > 0 and runs > 1");
  if (claim.kind == ClaimKind::plateau)
    check.that(claim.at_most < unbounded && claim.from_generation > 0, "at_most",
               "at_most and from_generation for a plateau");
  check.tried("against", claim.against, test);
  check.tried("threshold_condition", claim.threshold_condition, test);
  check.tried("condition", claim.condition, test_of(study, claim.base_measure));
}

}  // namespace amble::ledger
