#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "amble/experiment/run.hpp"
#include "amble/statistics/descriptive.hpp"
#include "bench/benches.hpp"
#include "bench/workload.hpp"

namespace amble::bench {
namespace {

class Totals : public experiment::RunListener {
 public:
  void on_generation(const experiment::GenerationRow& row, const experiment::Progress&,
                     const experiment::Config&) override {
    evaluations += static_cast<double>(row.evaluations);
    steps += static_cast<double>(row.steps);
    wall_s += row.wall_s;
    outside_s += row.outside_s();
  }
  double evaluations = 0.0, steps = 0.0, wall_s = 0.0, outside_s = 0.0;
};

Totals run(const std::string& engine, int generations, int jobs) {
  const auto folder = std::filesystem::temp_directory_path() / ("amble-bench-" + std::to_string(getpid()));
  const std::atomic<bool> never{false};
  Totals totals;
  experiment::Run::start(
      folder, authors_config({"engine=" + engine, "generations=" + std::to_string(generations)}), jobs)
      .execute(totals, never);
  std::filesystem::remove_all(folder);
  return totals;
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// More generations, because a generation is over so soon.
void measure_batch_runs(double ode_per_s, std::vector<Figure>& figures) {
  constexpr int generations = 40;
  const int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto one = run("batch", generations, 1), all = run("batch", generations, workers);
  const double one_per_s = one.evaluations / one.wall_s, all_per_s = all.evaluations / all.wall_s;
  const auto end_to_end = "end to end, " + std::to_string(workers) + " workers";
  figures.push_back(
      {"batch_vs_ode_end_to_end", one_per_s / ode_per_s, "1", "evaluations per second, one worker"});
  figures.push_back(
      {"outside_physics_share_batch", all.outside_s / all.wall_s, "1", "of wall time, all workers"});
  without_avx512([&] {
    const auto narrow = run("batch", generations, 1);
    figures.push_back({"batch_vs_ode_end_to_end_avx2", narrow.evaluations / narrow.wall_s / ode_per_s, "1",
                       "the same without AVX-512"});
  });
  figures.push_back({"evaluations_per_s_batch", one_per_s, "1/s", "end to end, one worker"});
  figures.push_back({"evaluations_per_s_batch_all_workers", all_per_s, "1/s", end_to_end});
  figures.push_back({"steps_per_s_batch_all_workers", all.steps / all.wall_s, "1/s", end_to_end});
}

}  // namespace

void measure_whole_run(std::vector<Figure>& figures) {
  constexpr int generations = 800;
  const int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const auto what =
      "300 genomes, 800 generations of configs/authors, " + std::to_string(workers) + " workers";
  figures.push_back({"whole_run_s", run("batch", generations, workers).wall_s, "s", what});
  without_avx512([&] {
    figures.push_back(
        {"whole_run_s_avx2", run("batch", generations, workers).wall_s, "s", what + ", without AVX-512"});
  });
}

void measure_runs(std::vector<Figure>& figures) {
  // By turns, and medians: another program that wakes up meanwhile takes from one round only. Shares and
  // steps are of the last round.
  constexpr int generations = 4, rounds = 3;
  std::vector<double> ones_per_s, twos_per_s, ratios;
  Totals two;
  for (int round = 0; round < rounds; ++round) {
    const auto one = run("ode", generations, 1);
    two = run("ode", generations, 2);
    ones_per_s.push_back(one.evaluations / one.wall_s);
    twos_per_s.push_back(two.evaluations / two.wall_s);
    ratios.push_back(twos_per_s.back() / ones_per_s.back());
  }
  const double one_per_s = statistics::median(ones_per_s);
  figures.push_back(
      {"two_workers_vs_one", statistics::median(ratios), "1", "evaluations per second, whole run"});
  figures.push_back(
      {"outside_physics_share", two.outside_s / two.wall_s, "1", "of wall time, 300 genomes, two workers"});
  figures.push_back({"evaluations_per_s_ode", one_per_s, "1/s", "end to end, one worker"});
  figures.push_back(
      {"evaluations_per_s_ode_two_workers", statistics::median(twos_per_s), "1/s", "end to end"});
  figures.push_back({"steps_per_s_ode_two_workers", two.steps / two.wall_s, "1/s", "end to end"});
  measure_batch_runs(one_per_s, figures);
  figures.push_back(
      {"peak_memory_mb", peak_memory_mb(), "MB", "of the whole benchmark, runs of 300 genomes included"});
}

}  // namespace amble::bench
