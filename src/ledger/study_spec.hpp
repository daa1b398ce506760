#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/settings.hpp"
#include "amble/ledger/claim_spec.hpp"

namespace amble::ledger {

/// Versions of what decides verdicts beside the claims themselves. StudySpec::claims_hash() covers them, so a
/// record tells under which rules its claims were written. docs/STUDIES.md lists what each version was;
/// tests/report/judging_rules_test.cpp fails if the rules' behaviour changes without a new number here.
struct JudgingRules {
  int verdicts = 0;  ///< report/verdict_rules.hpp, and what makes a claim not testable
  int stop = 0;      ///< score::StandingRule, and how score::WalkingMeter applies it

  friend bool operator==(const JudgingRules&, const JudgingRules&) = default;
};

/// Those that hashes without versions stand for: records made before the rules were part of the hash.
inline constexpr JudgingRules first_rules{.verdicts = 1, .stop = 1};
inline constexpr JudgingRules current_rules{.verdicts = 2, .stop = 1};

/// One experiment of a study: a config with settings laid over it, run once per seed.
struct ConditionSpec {
  std::string name;    ///< in file names and claims: a-z, 0-9, '-', '_'
  std::string title;   ///< for people; empty: the name
  std::string config;  ///< config file; relative to the study file until load_study() resolves it
  std::string robot;   ///< robot file; likewise; empty: the config's
  std::vector<std::string> settings;  ///< "key.path=value", laid over the config after StudySpec::settings
  /// [controller.differential] in one line, by which champions are steered in tests with commands; empty: by
  /// their own config.
  std::string steering;
  /// > 0: champions that switch between so many elites of the run's map as they are told.
  int gaits = 0;
  std::vector<double> seeds;  ///< empty: StudySpec::seeds
  int generations = 0;        ///< 0: StudySpec::generations

  const std::string& label() const { return title.empty() ? name : title; }
  void describe(io::SettingsVisitor& visitor);
};

/// A trial of every finished run's champion.
struct TestSpec {
  std::string name;
  std::string engine;  ///< empty: the engine of the run
  std::vector<std::string>
      engine_own;  ///< "NAME=NUMBER", settings of that engine (physics::EngineKind::numbers)
  double seconds = 300.0;
  std::string noise;  ///< config file whose [noise] disturbs the trials; empty: no noise
  std::string
      level;  ///< record::Level that disturbs them, or record::own_noise, in place of `noise`; empty: none
  std::string ground;  ///< config file whose [ground] the champion walks on; empty: that of its own config
  std::string damage;  ///< config file whose [damage] the champion has; empty: that of its own config
  std::string
      command;  ///< what it is told (trial::parse_commands); empty: by the [command] of its own config
  /// Trials under noise, on uneven ground, or from places that evolution has not used; 1 without any of it.
  int episodes = 1;
  /// > 0: also finds the first of the run's successive bests whose median trial gets that far, m.
  double reach_m = 0.0;
  bool score = false;   ///< also measures what the trials are worth by the [score] of each condition's config
  bool energy = false;  ///< also measures what the trials cost (Spent)
  bool seam = false;    ///< also measures how targets pass from cycle to cycle (Seam), of the first trial
  /// > 0: also tries so many mutants of the champion in the same trials (record::Mutant).
  int mutants = 0;
  std::vector<std::string> conditions;  ///< names; empty: all

  bool applies_to(std::string_view condition) const;
  bool is_disturbed() const { return !noise.empty() || !level.empty(); }
  void describe(io::SettingsVisitor& visitor);
};

/// A comparison of conditions over seeds, the tests of its champions, and its claims.
struct StudySpec {
  std::string name = "study";
  std::string title;
  std::vector<double> seeds;  ///< whole numbers, all different
  int generations = 0;        ///< 0: as in each config
  int map_trials = 0;         ///< > 0: each elite of a run's map is tried again so often (corrected maps)
  std::vector<std::string> settings;
  std::vector<ConditionSpec> conditions;
  std::vector<TestSpec> tests;
  std::vector<ClaimSpec> claims;
  /// Where a key was set ("FILE:LINE"), for diagnostics found later; empty unless read from a file.
  std::function<std::string(const std::string& key)> where;

  void describe(io::SettingsVisitor& visitor);
  std::vector<std::int64_t> seeds_of(const ConditionSpec& condition) const;
  const ConditionSpec* find(std::string_view condition) const;
  const TestSpec* find_test(std::string_view test) const;
  std::string to_toml() const;
  /// Hash of the claims and of the versions of the rules that judge them, hexadecimal.
  std::string claims_hash(JudgingRules rules = current_rules) const;
  /// The versions under which these claims, word for word, have that hash; nothing if they are others.
  std::optional<JudgingRules> rules_of(const std::string& claims_hash) const;
  /// A UserError with the place of a key in front, if that is known.
  UserError error_at(const std::string& key, const std::string& text) const;
};

/// Reads and checks a study file. Paths of configs come back such that they can be opened from the current
/// folder. Throws UserError: syntax, unknown keys, a name or a seed twice, a claim about what is not there.
/// `is_recorded`: a copy beside records, whose claims may have keys without effect, as earlier versions let
/// them.
StudySpec load_study(const std::filesystem::path& path, bool is_recorded = false);

}  // namespace amble::ledger
