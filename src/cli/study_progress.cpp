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
#include "amble/io/text.hpp"
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

/// The generations that each run has left, as far as is known before it begins.
std::vector<int> generations_left(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                                  const study::Shard& shard) {
  std::vector<int> left(plan.runs.size());
  for (const std::size_t run : plan.shard(shard))
    if (states[run] == study::RunStatus::missing || states[run] == study::RunStatus::begun)
      left[run] = plan.condition(plan.runs[run]).config.generations;
  return left;
}

}  // namespace

std::string StudyEvent::line() const {
  return fmt::format("{}{} {} {} {} {}\n", mark, kinds[to_index(kind)], run, generations, best_objective,
                     io::printable(reason));
}

bool StudyEvent::parse(std::string_view line, StudyEvent& event) {
  if (!line.starts_with(mark)) return false;
  line.remove_prefix(mark.size());
  const auto found = std::ranges::find(kinds, take_word(line));
  if (found == kinds.end()) return false;
  event.kind = static_cast<Kind>(found - kinds.begin());
  if (!take_number(line, event.run) || !take_number(line, event.generations) ||
      !take_number(line, event.best_objective))
    return false;
  event.reason = line;
  return true;
}

StudyProgress::StudyProgress(const study::Plan& plan, const std::vector<study::RunStatus>& states,
                             const study::Shard& shard, int processes)
    : plan_(plan),
      terminal_(isatty(STDERR_FILENO) != 0),
      time_left_(plan, generations_left(plan, states, shard), processes) {
  for (const std::size_t run : plan.shard(shard)) {
    ++total_;
    done_ += states[run] == study::RunStatus::done;
  }
}

StudyProgress::~StudyProgress() {
  if (open_) print_message("\n");
}

std::string StudyProgress::summary() const {
  std::string running;
  for (const auto& [run, generations] : time_left_.running())
    running += fmt::format("{}{} {}/{}", running.empty() ? "" : ", ", plan_.name(plan_.runs[run]),
                           generations, plan_.condition(plan_.runs[run]).config.generations);
  const auto left_s = time_left_.seconds();
  return fmt::format("{} of {} runs{}{}{}{}", done_, total_,
                     failed_.empty() ? "" : fmt::format(", {} failed", failed_.size()),
                     left_s ? "  left " + clock_text(*left_s) : "", running.empty() ? "" : "  ", running);
}

void StudyProgress::on(const StudyEvent& event) {
  const auto& run = plan_.runs[event.run];
  switch (event.kind) {
    case StudyEvent::Kind::start:
      time_left_.begin(event.run, event.generations, now_s());
      break;
    case StudyEvent::Kind::generation:
      time_left_.advance(event.run, event.generations, now_s());
      break;
    case StudyEvent::Kind::finish:
      time_left_.end(event.run);
      failed_.erase(event.run);
      if (!finished_.insert(event.run).second) return;
      ++done_;
      print(fmt::format("{}: {}; {} of {} runs done", plan_.name(run),
                        score::with_unit(fmt::format("{:.2f}", event.best_objective),
                                         plan_.condition(run).config.score),
                        done_, total_),
            true);
      break;
    case StudyEvent::Kind::failure:
      time_left_.end(event.run);
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
        .best_objective = record.best_objective,
        .reason = {}});
}

void StudyReporter::on_failure(const study::PlannedRun& run, const std::string& reason) {
  send({.kind = StudyEvent::Kind::failure, .run = index_of(run), .reason = reason});
}

}  // namespace amble::cli
