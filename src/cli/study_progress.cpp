#include "amble/cli/study_progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "amble/cli/messages.hpp"
#include "amble/cli/progress.hpp"
#include "amble/core/clock.hpp"
#include "amble/core/index.hpp"
#include "amble/io/printable.hpp"
#include "amble/score/score.hpp"

namespace amble::cli {
namespace {

constexpr std::array<std::string_view, 4> kinds{"start", "generation", "finish", "failure"};
constexpr std::string_view mark = "amble-study ";
constexpr double line_interval_s = 0.2, redraw_interval_s = 0.1, summary_interval_s = 30.0;

/// Takes the next word off a line.
std::string_view take_word(std::string_view& line) {
  const std::size_t space = std::min(line.find(' '), line.size());
  const auto word = line.substr(0, space);
  line.remove_prefix(std::min(space + 1, line.size()));
  return word;
}

template <typename Number>
bool take_number(std::string_view& line, Number& value) {
  const auto word = take_word(line);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

std::string StudyEvent::line() const {
  return fmt::format("{}{} {} {} {} {}\n", mark, kinds[to_index(kind)], run, generations, best_m,
                     io::printable(reason));
}

bool StudyEvent::parse(std::string_view line, StudyEvent& event) {
  if (!line.starts_with(mark)) return false;
  line.remove_prefix(mark.size());
  const auto found = std::ranges::find(kinds, take_word(line));
  if (found == kinds.end()) return false;
  event.kind = static_cast<Kind>(found - kinds.begin());
  if (!take_number(line, event.run) || !take_number(line, event.generations) ||
      !take_number(line, event.best_m))
    return false;
  event.reason = line;
  return true;
}

StudyProgress::StudyProgress(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                             const study::Shard& shard, int processes)
    : plan_(plan),
      processes_(processes),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_s_(now_s()),
      left_(plan.runs.size()),
      pace_(plan.conditions.size()) {
  for (const std::size_t run : plan.shard(shard)) {
    ++total_;
    if (states[run] == study::RunStatus::done)
      ++done_;
    else if (states[run] != study::RunStatus::untested)
      left_[run] = plan.condition(plan.runs[run]).config.generations;
  }
}

StudyProgress::~StudyProgress() {
  if (open_) print_message("\n");
}

void StudyProgress::note_pace(std::size_t run, int generations) {
  const int total = plan_.condition(plan_.runs[run]).config.generations;
  const int left = std::max(0, total - generations);
  const double now = now_s();
  if (const auto heard = at_s_.find(run); heard != at_s_.end()) {
    Pace& pace = pace_[plan_.runs[run].condition];
    pace.generations += left_[run] - left;
    pace.seconds += now - heard->second;
  }
  at_s_[run] = now;
  left_[run] = left;
}

// Each condition at the pace seen so far, those not yet seen at the mean of the others.
double StudyProgress::left_s() const {
  Pace all;
  for (const Pace& pace : pace_) {
    all.generations += pace.generations;
    all.seconds += pace.seconds;
  }
  // How long tests take is not known.
  if (all.generations <= 0.0 || std::ranges::all_of(left_, [](int left) { return left == 0; })) return -1.0;
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

std::string StudyProgress::summary() const {
  std::string running;
  for (const auto& [run, heard_s] : at_s_)
    running += fmt::format("{}{} {}/{}", running.empty() ? "" : ", ", plan_.name(plan_.runs[run]),
                           plan_.condition(plan_.runs[run]).config.generations - left_[run],
                           plan_.condition(plan_.runs[run]).config.generations);
  const double left = left_s();
  return fmt::format("{} of {} runs{}{}{}{}", done_, total_,
                     failed_.empty() ? "" : fmt::format(", {} failed", failed_.size()),
                     left < 0.0 ? "" : "  left " + clock_text(left), running.empty() ? "" : "  ", running);
}

void StudyProgress::on(const StudyEvent& event) {
  const auto& run = plan_.runs[event.run];
  switch (event.kind) {
    case StudyEvent::Kind::start:
      left_[event.run] = plan_.condition(run).config.generations - event.generations;
      at_s_[event.run] = now_s();
      break;
    case StudyEvent::Kind::generation:
      note_pace(event.run, event.generations);
      break;
    case StudyEvent::Kind::finish:
      at_s_.erase(event.run);
      left_[event.run] = 0;
      failed_.erase(event.run);
      if (!finished_.insert(event.run).second) return;
      ++done_;
      print(fmt::format(
                "{}: {}; {} of {} runs done", plan_.name(run),
                score::with_unit(fmt::format("{:.2f}", event.best_m), plan_.condition(run).config.score),
                done_, total_),
            true);
      break;
    case StudyEvent::Kind::failure:
      at_s_.erase(event.run);
      left_[event.run] = 0;
      // Each process tries what the others could not do.
      if (finished_.contains(event.run) || !failed_.insert(event.run).second) return;
      print(fmt::format("{}: failed: {}", plan_.name(run), event.reason), true);
      break;
  }
  const double now = now_s();
  if (now - last_print_s_ < (terminal_ ? redraw_interval_s : summary_interval_s)) return;
  last_print_s_ = now;
  print(summary(), false);
}

void StudyProgress::print(const std::string& line, bool stays) {
  if (!terminal_) return print_message(line + "\n");
  print_message("\r\033[K" + (stays ? line + "\n" : shortened(line, terminal_columns() - 1)));
  open_ = !stays;
}

std::size_t StudyReporter::index_of(const study::PlannedRun& run) const {
  const auto same = [&run](const study::PlannedRun& other) {
    return other.condition == run.condition && other.seed == run.seed;
  };
  return to_index(std::ranges::find_if(plan_.runs, same) - plan_.runs.begin());
}

void StudyReporter::send(const StudyEvent& event) {
  if (progress_ != nullptr) return progress_->on(event);
  const double now = now_s();
  if (event.kind == StudyEvent::Kind::generation && now - last_line_s_ < line_interval_s) return;
  last_line_s_ = now;
  fmt::print("{}", event.line());
  std::fflush(stdout);
}

void StudyReporter::on_start(const study::PlannedRun& run, int generations_done) {
  send(
      {.kind = StudyEvent::Kind::start, .run = index_of(run), .generations = generations_done, .reason = {}});
}

void StudyReporter::on_generation(const study::PlannedRun& run, int generations_done) {
  send({.kind = StudyEvent::Kind::generation,
        .run = index_of(run),
        .generations = generations_done,
        .reason = {}});
}

void StudyReporter::on_finish(const study::PlannedRun& run, const ledger::Record& record) {
  send({.kind = StudyEvent::Kind::finish,
        .run = index_of(run),
        .generations = record.generations,
        .best_m = record.best_m,
        .reason = {}});
}

void StudyReporter::on_failure(const study::PlannedRun& run, const std::string& reason) {
  send({.kind = StudyEvent::Kind::failure, .run = index_of(run), .reason = reason});
}

}  // namespace amble::cli
