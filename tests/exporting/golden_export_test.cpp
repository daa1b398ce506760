#include <gtest/gtest.h>

#include <algorithm>

#include "amble/exporting/c_source.hpp"
#include "amble/exporting/json_source.hpp"
#include "tests/exporting/champions.hpp"
#include "tests/figures/golden.hpp"

namespace amble::exporting {
namespace {

TEST(GoldenExport, OfSupgsAndNetworksMatches) {
  const Provenance provenance{"amble 1", "golden", 7, 3, 2, "batch", "1.5 m", "settings", "genome"};
  std::map<std::string, std::string> texts;
  for (const tests::Sample& sample : tests::twenty_samples()) {
    const std::vector<std::string> some{"quadruped_supg", "hexapod_sine", "biped_ctrnn", "recurrent_sine",
                                        "ctrnn_exponential"};
    if (std::ranges::find(some, sample.name) == some.end()) continue;
    const experiment::Champion champion = tests::evolve(sample);
    const std::atomic<bool> stop{false};
    const ControllerTables tables = controller_tables(champion.problem, champion.genome);
    const Trace trace = record_trace(champion.problem, champion.genome, 20, stop);
    texts[sample.name + ".json"] = json_source(champion, tables, provenance, trace);
    const auto& robot = champion.problem.robot;
    for (const Arithmetic arithmetic : {Arithmetic::float32, Arithmetic::fixed}) {
      const bool fixed = arithmetic == Arithmetic::fixed;
      if (fixed && sample.name != "quadruped_supg") continue;
      const CSource source =
          c_source(tables, robot, provenance, trace, {"walker", arithmetic, "The first tick is the first."});
      texts[sample.name + (fixed ? "_fixed.h" : ".h")] = source.header;
      texts[sample.name + (fixed ? "_fixed.c" : ".c")] = source.source;
    }
  }
  tests::expect_golden(texts, {{"biped_ctrnn.c", "dcbef02081057340"},
                               {"biped_ctrnn.h", "a4faae8e64c84ebd"},
                               {"biped_ctrnn.json", "dd2052c52f787621"},
                               {"ctrnn_exponential.c", "fbdf1b3378e17eb1"},
                               {"ctrnn_exponential.h", "8b7d970f42a96ced"},
                               {"ctrnn_exponential.json", "4cb84b9d0c09e149"},
                               {"hexapod_sine.c", "725abc0fd7e89557"},
                               {"hexapod_sine.h", "37b0417fcee18453"},
                               {"hexapod_sine.json", "c87f97eb3a0a1dd0"},
                               {"quadruped_supg.c", "63b37d96b7edb355"},
                               {"quadruped_supg.h", "5a49bf4543c1dff2"},
                               {"quadruped_supg.json", "5ce2fa1aff2833a7"},
                               {"quadruped_supg_fixed.c", "cda13949d879a975"},
                               {"quadruped_supg_fixed.h", "23c0753744297eac"},
                               {"recurrent_sine.c", "8df93889b3cffc91"},
                               {"recurrent_sine.h", "7214eebbf7b6ee5d"},
                               {"recurrent_sine.json", "2e766fa118748489"}});
}

}  // namespace
}  // namespace amble::exporting
