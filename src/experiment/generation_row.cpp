#include "amble/experiment/generation_row.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "amble/core/check.hpp"
#include "amble/statistics/descriptive.hpp"

namespace amble::experiment {

std::string csv_header() {
  std::string header =
      "generation,best_m,best_so_far_m,mean_m,median_m,species,threshold,mean_hidden,mean_links,"
      "best_hidden,best_links,fell,diverged,archive,novelty_threshold,best_novelty,evaluations,steps,"
      "wall_s,outside_s";
  for (const Stage& stage : stages) header.append(",").append(stage.column);
  return header + "\n";
}

std::string csv_line(const GenerationRow& row) {
  const auto novelty = row.novelty ? fmt::format("{},{},{}", row.novelty->archive_members,
                                                 row.novelty->threshold, row.novelty->best_novelty)
                                   : std::string(",,");
  auto line = fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.6f},{:.6f}", row.generation,
                          row.best_m, row.best_so_far_m, row.mean_m, row.median_m, row.population.species,
                          row.population.compatibility_threshold, row.population.mean_hidden,
                          row.population.mean_links, row.best_hidden, row.best_links, row.fell, row.diverged,
                          novelty, row.evaluations, row.steps, row.wall_s, row.outside_s());
  for (const Stage& stage : stages) line += fmt::format(",{:.6f}", row.times.*stage.seconds);
  return line + "\n";
}

void summarise_trials(std::span<const double> distances_m, std::span<const record::Trajectory> trajectories,
                      GenerationRow& row) {
  AMBLE_CHECK(!distances_m.empty(), "a generation has members");
  row.best_m = std::ranges::max(distances_m);
  row.median_m = statistics::median(distances_m);
  double sum = 0.0;
  for (const double distance_m : distances_m) sum += distance_m;
  row.mean_m = sum / static_cast<double>(distances_m.size());
  for (const auto& trajectory : trajectories) {
    row.fell += trajectory.outcome == record::Outcome::fell;
    row.diverged += trajectory.outcome == record::Outcome::diverged;
  }
}

}  // namespace amble::experiment
