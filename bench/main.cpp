#include <fmt/format.h>
#include <hwy/targets.h>

#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

#include "amble/experiment/build_info.hpp"
#include "amble/io/file.hpp"
#include "bench/benches.hpp"

// Measures everything in one run and prints ratios first: amble_bench [--csv FILE]. Run it on a machine that
// does nothing else.
int main(int argc, char** argv) {
  using namespace amble;
  std::vector<bench::Figure> figures;
  bench::measure_controllers(figures);
  bench::measure_cppn(figures);
  bench::measure_neat(figures);
  bench::measure_novelty(figures);
  bench::measure_physics(figures);
  bench::measure_runs(figures);
  const auto build = experiment::build_info();
  const std::int64_t supported = hwy::SupportedTargets();
  const std::vector<bench::Circumstance> circumstances{
      {"cpu", experiment::cpu_name()},
      {"instruction_set", hwy::TargetName(supported & -supported)},  // the best is the lowest bit
      {"compiler", build.compiler},
      {"compiler_flags", build.flags},
      {"amble", build.version + " " + build.commit}};
  fmt::print("{}", bench::to_text(figures));
  for (const auto& [name, text] : circumstances) fmt::print("\n{:<16} {}", name, text);
  fmt::print("\n");
  if (argc == 3 && std::string_view(argv[1]) == "--csv")
    io::write_file(argv[2], bench::to_csv(figures, circumstances));
}
