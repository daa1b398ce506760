#include <benchmark/benchmark.h>

#include "amble/cppn/network.hpp"
#include "amble/experiment/problem.hpp"
#include "bench/workload.hpp"

// Benchmarks of single parts, for work on one of them. amble_bench measures the published figures.
namespace amble::bench {
namespace {

void compile_network(benchmark::State& state) {
  const auto genomes = evolved_genomes(50, 3, 2);
  std::size_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(cppn::Network(genomes[i++ % genomes.size()], cppn::Settings{}));
}
BENCHMARK(compile_network);

void query_network(benchmark::State& state) {
  const auto genomes = evolved_genomes(50, 3, 2);
  std::vector<cppn::Network> networks;
  for (const auto& genome : genomes) networks.emplace_back(genome, cppn::Settings{});
  const cppn::Points points(3, static_cast<int>(state.range(0)));
  std::vector<float> results(static_cast<std::size_t>(2 * points.capacity()));
  std::size_t i = 0;
  for (auto _ : state) networks[i++ % networks.size()].evaluate(points, results);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(query_network)->Arg(16)->Arg(1200);

void decode_genome(benchmark::State& state) {
  const auto config = authors_config();
  const auto problem = experiment::Problem::make(config, experiment::load_robot_file(config.robot));
  const auto genomes = evolved_genomes(50, problem.cppn_inputs(), problem.cppn_outputs());
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(problem.decode(genomes[i++ % genomes.size()]));
}
BENCHMARK(decode_genome);

void place_robot(benchmark::State& state) {
  const auto config = authors_config();
  const auto engine = physics::make_engine("ode", experiment::load_robot_file(config.robot), {});
  for (auto _ : state) engine->place(0);
}
BENCHMARK(place_robot);

}  // namespace
}  // namespace amble::bench

BENCHMARK_MAIN();
