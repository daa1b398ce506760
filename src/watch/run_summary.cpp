#include "amble/watch/run_summary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/text.hpp"
#include "amble/record/generations_csv.hpp"
#include "amble/score/score.hpp"

namespace amble::watch {
namespace {

constexpr std::array<std::string_view, 5> stage_names{"waiting", "running", "stopped", "ended", "gone"};
/// What is read of a table: its header, and the latest generations.
constexpr std::uint64_t header_bytes = 4096, tail_bytes = 8192;
/// Without a lock in sight a run goes on as long as its table grew so many generations ago, or seconds.
constexpr double patience_generations = 3.0, patience_s = 5.0;

std::optional<double> cell(const std::vector<std::string_view>& header, std::string_view line,
                           std::string_view column) {
  const auto place = to_index(std::ranges::find(header, column) - header.begin());
  const auto cells = io::split(line, ',');
  if (place >= header.size() || place >= cells.size()) return std::nullopt;
  return number_in(cells[place]);
}

/// The whole lines of the end of a table, without its header.
std::vector<std::string_view> last_lines(std::string_view text) {
  std::vector<std::string_view> lines = io::split(text, '\n');
  lines.pop_back();                                // what comes after the last line's end
  if (!lines.empty()) lines.erase(lines.begin());  // the header, or a part of a line
  return lines;
}

io::Json or_null(const std::optional<double>& value) {
  return value ? io::Json(*value) : io::Json();
}

std::optional<int> latest_champion(const experiment::RunPaths& paths) {
  const auto files = paths.champion_files();
  if (files.empty()) return std::nullopt;
  return std::stoi(files.back().stem().string());
}

}  // namespace

io::Json Summary::json() const {
  return {{"id", id},
          {"stage", stage_names[static_cast<std::size_t>(stage)]},
          {"name", name},
          {"search", search},
          {"unit", unit},
          {"seed", seed},
          {"generations", generations},
          {"done", done},
          {"best", or_null(best)},
          {"typical", or_null(typical)},
          {"median", or_null(median)},
          {"left_s", or_null(left_s)},
          {"champion", champion ? io::Json(*champion) : io::Json()},
          {"trouble", trouble}};
}

SummaryReader::SummaryReader(const std::filesystem::path& folder, std::string id) : paths_(folder) {
  summary_.id = std::move(id);
}

bool SummaryReader::poll(const LockHolders& locks, double now_s) {
  const Summary before = summary_;
  const FileMark config = FileMark::of(paths_.config), table = FileMark::of(paths_.generations);
  if (config.exists() && config != config_) read_config();
  if (table.exists() && table != table_) {
    if (table_.exists()) grew_s_ = now_s;
    table_ = table;
    read_table();
  }
  config_ = config;
  if (!table.exists()) table_ = {};
  summary_.stage = stage(locks, now_s);
  const int left = summary_.generations - summary_.done;
  summary_.left_s.reset();
  if (summary_.stage == Stage::running && summary_.done > 0 && left > 0)
    summary_.left_s = std::round(left * generation_s_);
  return !(summary_ == before);
}

Stage SummaryReader::stage(const LockHolders& locks, double now_s) const {
  if (!config_.exists()) return summary_.name.empty() && summary_.done == 0 ? Stage::waiting : Stage::gone;
  if (summary_.generations > 0 && summary_.done >= summary_.generations) return Stage::ended;
  const double patience = std::max(patience_s, patience_generations * generation_s_);
  return locks.hold(paths_.folder) || now_s - grew_s_ < patience ? Stage::running : Stage::stopped;
}

void SummaryReader::read_config() {
  try {
    const auto config = experiment::load_config(paths_.config, {});
    summary_.name = config.name;
    summary_.search = config.search.kind;
    summary_.unit = score::objective_of(config.score).unit;
    summary_.seed = config.seed;
    summary_.generations = config.generations;
    summary_.trouble.clear();
  } catch (const UserError& error) {
    summary_.trouble = error.what();
  }
}

void SummaryReader::read_table() {
  namespace column = record::column;
  const std::string begin = read_part(paths_.generations, 0, header_bytes);
  const auto header = io::split(std::string_view(begin).substr(0, begin.find('\n')), ',');
  const auto bytes = static_cast<std::uint64_t>(std::max<std::int64_t>(table_.bytes, 0));
  const std::uint64_t from = bytes > tail_bytes ? bytes - tail_bytes : 0;
  const std::string text = read_part(paths_.generations, from, bytes - from);
  const auto lines = last_lines(text);
  summary_.done = 0;
  summary_.best = summary_.typical = summary_.median = std::nullopt;
  summary_.champion = latest_champion(paths_);
  if (lines.empty()) return;
  summary_.done = static_cast<int>(cell(header, lines.back(), column::generation).value_or(-1.0)) + 1;
  summary_.best = cell(header, lines.back(), column::best_so_far);
  summary_.typical = cell(header, lines.back(), column::typical);
  summary_.median = cell(header, lines.back(), column::median);
  double sum_s = 0.0;
  for (const auto line : lines) sum_s += cell(header, line, column::wall_s).value_or(0.0);
  generation_s_ = sum_s / static_cast<double>(lines.size());
}

}  // namespace amble::watch
