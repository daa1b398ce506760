#include <amble/experiment/problem.hpp>
#include <cstdio>

int main(int, char** argv) {
  const auto robot = amble::experiment::load_robot_file(argv[1]);
  std::printf("%s: %zu joints, %.1f kg\n", robot.name.c_str(), robot.joints.size(), robot.total_mass_kg());
}
