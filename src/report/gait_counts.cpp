#include "amble/report/gait_counts.hpp"

#include <algorithm>
#include <map>

#include "amble/core/index.hpp"
#include "amble/gait/gait.hpp"

namespace amble::report {
namespace {

const std::string_view irregular_gait = gait::gait_names[to_index(gait::Gait::irregular)];

/// Position of a gait in tables: in the order of gait::gait_names, then unknown names, irregular, nameless.
std::size_t place(std::string_view gait) {
  const auto known = to_index(std::ranges::find(gait::gait_names, gait) - gait::gait_names.begin());
  const std::size_t count = gait::gait_names.size();
  if (gait == nameless_gait) return count + 2;
  if (gait == irregular_gait) return count + 1;
  return known;
}

bool before(const std::string& a, const std::string& b) {
  return std::pair(place(a), a) < std::pair(place(b), b);
}

}  // namespace

bool is_regular(std::string_view gait) {
  return gait != irregular_gait && gait != nameless_gait;
}

std::size_t GaitCounts::count(std::string_view gait) const {
  const auto found = std::ranges::find(runs, gait, &std::pair<std::string, std::size_t>::first);
  return found == runs.end() ? 0 : found->second;
}

GaitCounts count_gaits(const StudyData& data, std::string_view test, std::string_view condition) {
  GaitCounts counts{.condition = std::string(condition), .n = 0, .runs = {}};
  std::map<std::string, std::size_t> runs;
  for (const ledger::Record* record : data.runs(condition))
    if (const auto* result = data.result(*record, test)) {
      ++counts.n;
      ++runs[result->gait.empty() ? std::string(nameless_gait) : result->gait];
    }
  counts.runs.assign(runs.begin(), runs.end());
  std::ranges::sort(counts.runs, before, &std::pair<std::string, std::size_t>::first);
  return counts;
}

std::vector<GaitTable> gait_tables(const StudyData& data) {
  std::vector<GaitTable> tables;
  for (const ledger::TestSpec& test : data.study.tests) {
    GaitTable table{.test = test.name, .gaits = {}, .rows = {}};
    for (const ledger::ConditionSpec& condition : data.study.conditions) {
      GaitCounts counts = count_gaits(data, test.name, condition.name);
      if (counts.n == 0) continue;
      for (const auto& [gait, runs] : counts.runs)
        if (std::ranges::find(table.gaits, gait) == table.gaits.end()) table.gaits.push_back(gait);
      table.rows.push_back(std::move(counts));
    }
    std::ranges::sort(table.gaits, before);
    if (!table.rows.empty()) tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace amble::report
