#include "amble/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "amble/cli/messages.hpp"
#include "amble/core/clock.hpp"

namespace amble::cli {
namespace {

constexpr double terminal_interval_s = 0.1, plain_interval_s = 5.0;

/// "0.47", "53" or "1513".
std::string rate_text(double per_s) {
  return fmt::format("{:.{}f}", per_s, per_s < 9.95 ? 2 : 0);
}

}  // namespace

std::string clock_text(double seconds) {
  const auto whole = std::llround(std::max(0.0, seconds));
  const auto hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, rest);
  return fmt::format("{}:{:02}", minutes, rest);
}

ProgressLine::ProgressLine(int first_generation)
    : terminal_(isatty(STDERR_FILENO) != 0), first_generation_(first_generation), start_s_(now_s()) {}

ProgressLine::~ProgressLine() {
  if (open_) print_message("\n");
}

void ProgressLine::on_generation(const experiment::GenerationRow& row, const experiment::Progress& progress,
                                 const experiment::Config& config) {
  const int done = row.generation + 1;
  const double now = now_s();
  const bool last = done == config.generations;
  if (!last && now - last_print_s_ < (terminal_ ? terminal_interval_s : plain_interval_s)) return;
  last_print_s_ = now;

  const double s_per_generation = (now - start_s_) / (done - first_generation_);
  const double left_s = s_per_generation * (config.generations - done);
  const auto text = [&config](double score) {
    return score::with_unit(fmt::format("{:.2f}", score), config.score);
  };
  const auto species = row.metric("species");
  const auto line = fmt::format("generation {}/{}  best {}  median {}{}{}  {} evaluations/s  {} {}", done,
                                config.generations, text(progress.best), text(row.median),
                                species ? fmt::format("  {:.0f} species", *species) : "",
                                row.diverged > 0 ? fmt::format("  {} diverged", row.diverged) : "",
                                rate_text(static_cast<double>(row.evaluations) / row.wall_s),
                                last ? "took" : "left", clock_text(last ? now - start_s_ : left_s));
  print_message(terminal_ ? "\r\033[K" + line : line + "\n");
  open_ = terminal_;
}

}  // namespace amble::cli
