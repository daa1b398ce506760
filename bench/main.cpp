#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "amble/experiment/build_info.hpp"
#include "amble/io/file.hpp"
#include "bench/benches.hpp"

// Measures everything in one run and prints ratios first: amble_bench [--csv FILE]. Run it on a machine that
// does nothing else.
int main(int argc, char** argv) {
  using namespace amble;
  std::vector<bench::Figure> figures;
  bench::measure_cppn(figures);
  bench::measure_neat(figures);
  bench::measure_novelty(figures);
  bench::measure_physics(figures);
  bench::measure_runs(figures);
  const auto build = experiment::build_info();
  fmt::print("{}\n{}; amble {} {}; {}; {}\n", bench::to_text(figures), experiment::cpu_name(), build.version,
             build.commit, build.compiler, build.flags);
  if (argc == 3 && std::string_view(argv[1]) == "--csv") io::write_file(argv[2], bench::to_csv(figures));
}
