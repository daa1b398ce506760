#include "amble/cli/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

ProgressLine::ProgressLine(int first_generation, const experiment::Config& config)
    : terminal_(isatty(STDERR_FILENO) != 0), first_generation_(first_generation), start_s_(now_s()) {
  if (first_generation >= config.generations) return;
  const int episodes = config.noise.any() ? config.noise.episodes : 1;
  show({fmt::format("generation {}/{}", first_generation + 1, config.generations),
        fmt::format("{} genomes × {}{:g} s in {}", experiment::candidates_per_generation(config),
                    episodes > 1 ? fmt::format("{} × ", episodes) : "", config.trial.duration_s,
                    config.engine)});
}

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
  show({fmt::format("generation {}/{}", done, config.generations),
        fmt::format("typically {}", text(row.typical.median)), fmt::format("(scored {:.2f})", progress.best),
        fmt::format("{} {}", last ? "took" : "left", clock_text(last ? now - start_s_ : left_s)),
        fmt::format("median {}", text(row.median)),
        row.diverged > 0 ? fmt::format("{} diverged", row.diverged) : "",
        fmt::format("{} evals/s", rate_text(static_cast<double>(row.evaluations) / row.wall_s)),
        species ? fmt::format("{:.0f} species", *species) : ""});
}

PartsLine::PartsLine(std::string what)
    : what_(std::move(what)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_s_(now_s()),
      last_print_s_(start_s_) {}

PartsLine::~PartsLine() {
  if (open_) print_message("\n");
}

void PartsLine::show(std::size_t done, std::size_t of) {
  const double now = now_s();
  const double interval_s = open_ ? terminal_interval_s : plain_interval_s;
  if (now - last_print_s_ < interval_s && !(open_ && done == of)) return;
  last_print_s_ = now;
  const double left_s = (now - start_s_) / static_cast<double>(done) * static_cast<double>(of - done);
  const std::string line = fmt::format("{} of {} {}, left {}", done, of, what_, clock_text(left_s));
  print_message(terminal_ ? "\r\033[K" + shortened(line, terminal_columns() - 1) : line + "\n");
  open_ = terminal_;
}

void ProgressLine::show(const std::vector<std::string>& parts) {
  const int columns = terminal_ ? terminal_columns() - 1 : 0;  // in the last one, some terminals begin a line
  std::string line;
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    const std::string longer = line.empty() ? part : fmt::format("{}  {}", line, part);
    if (!line.empty() && shortened(longer, columns) != longer) break;
    line = longer;
  }
  line = shortened(line, columns);
  print_message(terminal_ ? "\r\033[K" + line : line + "\n");
  open_ = terminal_;
}

}  // namespace amble::cli
