#include "amble/report/curves.hpp"

#include <algorithm>

#include "amble/statistics/descriptive.hpp"

namespace amble::report {
namespace {

constexpr int most_points = 121;

/// 0 … last, evenly, at most `most_points` of them.
std::vector<int> sampled(int last) {
  const int count = std::min(last + 1, most_points);
  std::vector<int> generations{0};
  for (int i = 1; i < count; ++i)
    generations.push_back(static_cast<int>(static_cast<std::int64_t>(last) * i / (count - 1)));
  return generations;
}

}  // namespace

std::vector<BestCurve> best_curves(const StudyData& data) {
  std::vector<BestCurve> curves;
  for (const ledger::ConditionSpec& condition : data.study.conditions) {
    const auto runs = data.runs(condition.name);
    if (runs.empty()) continue;
    const auto* shortest =
        *std::ranges::min_element(runs, {}, [](const ledger::Record* run) { return run->generations; });
    BestCurve curve{.condition = condition.name,
                    .n = runs.size(),
                    .generation = sampled(std::max(0, shortest->generations - 1)),
                    .lower_quartile_m = {},
                    .median_m = {},
                    .upper_quartile_m = {}};
    for (const int generation : curve.generation) {
      std::vector<double> best;
      best.reserve(runs.size());
      for (const ledger::Record* run : runs) best.push_back(run->best_after(generation));
      curve.lower_quartile_m.push_back(statistics::quantile(best, 0.25));
      curve.median_m.push_back(statistics::median(best));
      curve.upper_quartile_m.push_back(statistics::quantile(best, 0.75));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace amble::report
