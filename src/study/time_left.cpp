#include "amble/study/time_left.hpp"

#include <algorithm>
#include <utility>

namespace amble::study {

TimeLeft::TimeLeft(const Plan& plan, std::vector<int> left, int processes)
    : plan_(plan), processes_(processes), left_(std::move(left)), pace_(plan.conditions.size()) {}

int TimeLeft::total(std::size_t run) const {
  return plan_.condition(plan_.runs[run]).config.generations;
}

void TimeLeft::begin(std::size_t run, int generations_done, double now_s) {
  left_[run] = total(run) - generations_done;
  at_s_[run] = now_s;
}

void TimeLeft::advance(std::size_t run, int generations_done, double now_s) {
  const int left = std::max(0, total(run) - generations_done);
  if (const auto heard = at_s_.find(run); heard != at_s_.end()) {
    Pace& pace = pace_[plan_.runs[run].condition];
    pace.generations += left_[run] - left;
    pace.seconds += now_s - heard->second;
  }
  at_s_[run] = now_s;
  left_[run] = left;
}

void TimeLeft::end(std::size_t run) {
  at_s_.erase(run);
  left_[run] = 0;
}

std::map<std::size_t, int> TimeLeft::running() const {
  std::map<std::size_t, int> generations_done;
  for (const auto& [run, heard_s] : at_s_) generations_done[run] = total(run) - left_[run];
  return generations_done;
}

std::optional<double> TimeLeft::seconds() const {
  Pace all;
  for (const Pace& pace : pace_) {
    all.generations += pace.generations;
    all.seconds += pace.seconds;
  }
  if (all.generations <= 0.0 || std::ranges::all_of(left_, [](int left) { return left == 0; }))
    return std::nullopt;
  double seconds = 0.0, longest_s = 0.0;
  for (std::size_t run = 0; run < left_.size(); ++run) {
    const Pace& own = pace_[plan_.runs[run].condition];
    const Pace& pace = own.generations > 0.0 ? own : all;
    const double run_s = left_[run] * pace.seconds / pace.generations;
    seconds += run_s;
    longest_s = std::max(longest_s, run_s);
  }
  return std::max(seconds / processes_, longest_s);
}

}  // namespace amble::study
