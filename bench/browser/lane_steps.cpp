// How long a robot-step takes, of one robot and of sixteen: for WebAssembly a function of modules to measure
// by (tools/measure-browser), else a program.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/core/clock.hpp"
#include "amble/experiment/problem/champion.hpp"
#include "amble/trial/trial.hpp"

namespace {

/// The same controller so many times.
class Copies : public amble::trial::TaskQueue {
 public:
  Copies(std::shared_ptr<const amble::controllers::Parameters> parameters, int count)
      : parameters_(std::move(parameters)), left_(count) {}

  std::optional<amble::trial::Task> next() override {
    if (left_-- <= 0) return std::nullopt;
    return amble::trial::Task{.index = 0, .parameters = parameters_};
  }
  void done(std::size_t, amble::record::Trajectory) override {}

 private:
  std::shared_ptr<const amble::controllers::Parameters> parameters_;
  int left_;
};

/// µs per robot-step.
double measure(const amble::experiment::Champion& champion, int robots, int steps) {
  const auto engine = champion.problem.make_engine();
  const auto controllers = champion.problem.architecture->make_batch(engine->lanes());
  Copies copies(champion.problem.decode(champion.genome), robots);
  amble::trial::Protocol protocol = champion.problem.protocol({});
  protocol.steps = steps + 1;
  protocol.fall.below_m = -1e9;
  amble::trial::Runner runner(*engine, *controllers, protocol);
  runner.begin(copies);
  const double before_s = amble::now_s();
  for (int step = 0; step < steps; ++step) runner.tick(copies);
  return (amble::now_s() - before_s) / (1.0 * robots * steps) * 1e6;
}

/// The quickest of some.
double quickest(const amble::experiment::Champion& champion, int robots, int steps) {
  double least = measure(champion, robots, steps);
  for (int i = 1; i < 5; ++i) least = std::min(least, measure(champion, robots, steps));
  return least;
}

}  // namespace

#ifdef __wasm__

/// The quickest of several measurements with the champion whose text, of so many bytes, is there.
extern "C" double amble_measure(const char* text, std::size_t size, int robots, int steps) {
  return quickest(amble::experiment::parse_champion_for("batch", std::string(text, size), "champion"), robots,
                  steps);
}

#else

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    std::ifstream file(argv[i], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const auto champion = amble::experiment::parse_champion_for("batch", text, argv[i]);
    std::printf("%s: 1 robot %.2f, 16 robots %.2f us per robot-step\n", argv[i], quickest(champion, 1, 1000),
                quickest(champion, 16, 1000));
  }
}

#endif
