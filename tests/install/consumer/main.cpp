#include <amble/experiment/problem.hpp>
#include <amble/experiment/replay.hpp>
#include <amble/experiment/run_paths.hpp>
#include <atomic>
#include <cstdio>

// As docs/LIBRARY.md lets a champion walk.
static double walked_m(const char* path) {
  const auto champion = amble::experiment::load_champion(amble::experiment::champion_at(path));
  const std::atomic<bool> stop{false};
  const auto walk = amble::experiment::replay(champion.problem, champion.genome, {.seconds = 2.0}, stop);
  return walk->result.distance_m;
}

int main(int argc, char** argv) {
  if (argc > 2) std::printf("%.3f m\n", walked_m(argv[2]));
  const auto robot = amble::experiment::load_robot_file(argv[1]);
  std::printf("%s: %zu joints, %.1f kg\n", robot.name.c_str(), robot.joints.size(), robot.total_mass_kg());
}
