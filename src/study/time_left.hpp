#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "amble/study/plan.hpp"

namespace amble::study {

/// How long the evolution of a study's runs still takes, from the pace seen so far. Times are of any one
/// clock.
class TimeLeft {
 public:
  /// `left`: generations left of each of Plan::runs; 0: evolved already, or of another shard. `processes`:
  /// number of parallel ones.
  TimeLeft(const Plan& plan, std::vector<int> left, int processes);

  /// A run begins, or goes on after so many generations.
  void begin(std::size_t run, int generations_done, double now_s);
  void advance(std::size_t run, int generations_done, double now_s);
  /// A run is finished, or failed.
  void end(std::size_t run);

  /// Generations done of each run that has begun and not ended.
  std::map<std::size_t, int> running() const;
  /// With each condition at its own pace, one that has none yet at the mean of the others, and no run shared
  /// by processes. Nothing before the first pace is known, nor when only tests are left: how long they take
  /// is not known.
  std::optional<double> seconds() const;

 private:
  struct Pace {
    double generations = 0.0, seconds = 0.0;
  };

  int total(std::size_t run) const;

  const Plan& plan_;
  int processes_;
  std::vector<int> left_;               ///< generations left, by run
  std::map<std::size_t, double> at_s_;  ///< when a run was last heard of
  std::vector<Pace> pace_;              ///< by condition
};

}  // namespace amble::study
