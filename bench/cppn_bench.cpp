#include <array>
#include <vector>

#include "amble/cppn/network.hpp"
#include "amble/cppn/reference.hpp"
#include "amble/experiment/problem.hpp"
#include "bench/benches.hpp"
#include "bench/workload.hpp"

namespace amble::bench {
namespace {

constexpr int genomes_measured = 50, joints = 12, ticks = 100;

/// The queries of one SUPG controller: 12 joints × 100 ticks.
cppn::Points supg_points() {
  cppn::Points points(3, joints * ticks);
  for (int joint = 0; joint < joints; ++joint) {
    for (int tick = 0; tick < ticks; ++tick) {
      const int point = joint * ticks + tick;
      points.set(point, 0, 0.02f * static_cast<float>(joint / 3) - 0.03f);
      points.set(point, 1, static_cast<float>(joint % 3) - 1.0f);
      points.set(point, 2, static_cast<float>(tick) / ticks);
    }
  }
  return points;
}

}  // namespace

void measure_cppn(std::vector<Figure>& figures) {
  const auto genomes = evolved_genomes(genomes_measured, 3, 2);
  const auto points = supg_points();
  const cppn::Settings settings;
  std::vector<float> results(static_cast<std::size_t>(2 * points.capacity()));
  std::array<double, 3> inputs{};
  std::array<double, 2> outputs{};
  const double batched_s = seconds_per_call([&] {
    for (const auto& genome : genomes) cppn::Network(genome, settings).evaluate(points, results);
  });
  const double naive_s = seconds_per_call(
      [&] {
        for (const auto& genome : genomes) {
          const cppn::Reference network(genome, settings);
          for (int point = 0; point < points.count(); ++point) {
            for (int i = 0; i < 3; ++i)
              inputs[static_cast<std::size_t>(i)] = static_cast<double>(points.get(point, i));
            network.evaluate(inputs, outputs);
          }
        }
      },
      0.3, 3);
  const double queries = static_cast<double>(genomes_measured) * joints * ticks;
  figures.push_back(
      {"cppn_batched_vs_naive", naive_s / batched_s, "1", "evolved CPPNs, batched over point by point"});
  figures.push_back(
      {"cppn_queries_per_s", queries / batched_s, "1/s", "one core, compilation of the genome included"});
  figures.push_back({"cppn_naive_queries_per_s", queries / naive_s, "1/s", "double precision, libm"});
  figures.push_back({"cppn_ms_per_300_genomes", batched_s * 300.0 / genomes_measured * 1e3, "ms",
                     "300 x 12 x 100 queries"});
}

}  // namespace amble::bench
