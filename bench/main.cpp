#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/experiment/build_info.hpp"
#include "amble/io/file.hpp"
#include "bench/benches.hpp"

namespace {

struct Part {
  std::string_view name;
  void (*measure)(std::vector<amble::bench::Figure>&);
  bool by_name_alone = false;  ///< too long to be measured with the others
};
constexpr Part parts[] = {
    {"controllers", amble::bench::measure_controllers},
    {"cppn", amble::bench::measure_cppn},
    {"map_elites", amble::bench::measure_map_elites},
    {"neat", amble::bench::measure_neat},
    {"novelty", amble::bench::measure_novelty},
    {"physics", amble::bench::measure_physics},
    {"robots", amble::bench::measure_robots},
    {"runs", amble::bench::measure_runs},
    {"whole_run", amble::bench::measure_whole_run, true},
};

struct Options {
  std::string_view csv, only, config;
};

/// Nothing if the arguments make no sense.
std::optional<Options> options_of(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view name = argv[i];
    std::string_view* const value = name == "--csv"      ? &options.csv
                                    : name == "--only"   ? &options.only
                                    : name == "--config" ? &options.config
                                                         : nullptr;
    if (i + 1 == argc || value == nullptr) return {};
    *value = argv[i + 1];
  }
  const bool known = std::ranges::any_of(parts, [&](const Part& part) { return part.name == options.only; });
  return options.only.empty() || (known && options.config.empty()) ? std::optional(options) : std::nullopt;
}

/// A robot of one's own, one part, or all.
std::vector<amble::bench::Figure> measure(const Options& options) {
  std::vector<amble::bench::Figure> figures;
  if (!options.config.empty()) {
    amble::bench::measure_config(std::string(options.config), figures);
    return figures;
  }
  for (const Part& part : parts)
    if (options.only.empty() ? !part.by_name_alone : options.only == part.name) part.measure(figures);
  return figures;
}

}  // namespace

// Measures everything in one run, one part of it, or the robot of a config, and prints ratios first. Run it
// on a machine that does nothing else.
int main(int argc, char** argv) try {
  using namespace amble;
  const auto options = options_of(argc, argv);
  if (!options) {
    std::vector<std::string_view> names;
    for (const Part& part : parts) names.push_back(part.name);
    fmt::print(stderr, "usage: amble_bench [--csv FILE] [--only {} | --config CONFIG.toml]\n",
               fmt::join(names, "|"));
    return 2;
  }
  const std::vector<bench::Figure> figures = measure(*options);
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
  if (!options->csv.empty()) io::write_file(std::string(options->csv), bench::to_csv(figures, circumstances));
} catch (const amble::UserError& error) {
  fmt::print(stderr, "amble_bench: {}\n", error.what());
  return 2;
}
