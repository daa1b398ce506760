#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "amble/study/worker.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::study {

inline std::string config_file(const std::string& name) {
  return std::string(AMBLE_SOURCE_DIR) + "/configs/" + name + ".toml";
}

inline ledger::ConditionSpec condition(const std::string& name, const std::string& config) {
  ledger::ConditionSpec spec;
  spec.name = name;
  spec.config = config_file(config);
  return spec;
}

inline ledger::TestSpec trial_test(const std::string& name, double seconds, const std::string& noise = "",
                                   int episodes = 1) {
  ledger::TestSpec spec;
  spec.name = name;
  spec.seconds = seconds;
  spec.noise = noise;
  spec.episodes = episodes;
  return spec;
}

/// One condition and one seed, made small: 20 genomes, five generations, trials of one second.
inline ledger::StudySpec small_study(std::vector<std::string> more = {}) {
  ledger::StudySpec study;
  study.seeds = {3};
  study.generations = 5;
  study.settings = {"engine=batch", "population.size=20", "speciation.target_min=3",
                    "speciation.target_max=6", "trial.duration_s=1"};
  study.settings.insert(study.settings.end(), more.begin(), more.end());
  study.conditions = {condition("sine", "authors/sine-objective")};
  return study;
}

/// Notes what is finished.
class Notes : public Listener {
 public:
  void on_start(const PlannedRun&, int) override { ++started; }
  void on_generation(const PlannedRun&, int) override { ++generations; }
  void on_finish(const PlannedRun&, const ledger::Record& record) override { records.push_back(record); }
  void on_failure(const PlannedRun&, const std::string& reason) override { failures.push_back(reason); }
  int started = 0, generations = 0;
  std::vector<ledger::Record> records;
  std::vector<std::string> failures;
};

inline WorkResult work_on(const ledger::StudySpec& study, const std::filesystem::path& folder, Notes& notes,
                          bool discard_runs = false) {
  const Plan plan = make_plan(study, folder);
  const std::atomic<bool> never{false};
  return work(plan, survey(plan), {.shard = {}, .discard_runs = discard_runs}, notes, never);
}

}  // namespace amble::study
