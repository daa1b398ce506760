#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/process.hpp"

namespace amble::tests {
namespace substrate_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

const std::string source = AMBLE_SOURCE_DIR;

TEST(SubstrateCommand, ListsNodesAndLinksOfTheArchitecturesOfThePaper) {
  const auto supg = amble({"substrate", source + "/configs/authors/supg-objective.toml"});
  EXPECT_EQ(supg.exit_code, 0) << supg.err;
  EXPECT_THAT(supg.out, HasSubstr("CPPN inputs   leg, joint_type, time\nCPPN outputs  pattern, offset\n"));
  EXPECT_THAT(supg.out, HasSubstr("\n12 nodes (leg, joint_type)\n"));
  EXPECT_THAT(supg.out, HasSubstr("  BR.hip_io  supg  (0.02, 1)  drives BR_hip_io\n"));
  EXPECT_THAT(supg.out, HasSubstr("\n0 links\n"));
  EXPECT_THAT(supg.out,
              HasSubstr("  offset of supg: -1 to 1 by output offset, queried with joint_type = 0\n"));

  const auto sine = amble({"substrate", source + "/configs/paper/sine-objective.toml"});
  EXPECT_THAT(sine.out, HasSubstr("    400  input -> hidden, by output weight\n"));
  EXPECT_THAT(sine.out, HasSubstr("    240  hidden -> output, by output weight\n"));

  const auto ctrnn = amble({"substrate", source + "/configs/authors/ctrnn-objective.toml"});
  EXPECT_THAT(ctrnn.out, HasSubstr("\n88 links\n"));
  EXPECT_THAT(ctrnn.out, HasSubstr("  bias of outer motor: 3\n"));
  EXPECT_THAT(ctrnn.out, HasSubstr("  BL.hip_io        ->  FL.touch         inter\n"));
}

TEST(SubstrateCommand, ShowsNodesMadeFromTheRobotAsAListToEdit) {
  const TemporaryFolder scratch;
  for (const std::string kind : {"supg", "sine", "ctrnn"}) {
    const std::string config = source + "/configs/paper/" + kind + "-objective.toml";
    const auto listed = amble({"substrate", config, "--toml"});
    EXPECT_EQ(listed.exit_code, 0) << listed.err;
    EXPECT_THAT(listed.out, HasSubstr("\n[controller.substrate]\n"));
    EXPECT_THAT(listed.out, HasSubstr("layout = \"listed\"\n"));
    const auto made = amble({"substrate", config, "--toml", "--set", "controller.substrate=auto"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(made.out, listed.out);
    // What is printed is a part of a config.
    std::ofstream(scratch / "own.toml") << "include = ['" << config << "']\n" << made.out;
    EXPECT_EQ(amble({"substrate", scratch / "own.toml"}).out, amble({"substrate", config}).out);
  }
}

TEST(SubstrateCommand, DrawsThem) {
  const TemporaryFolder scratch;
  for (const std::string kind : {"supg", "sine", "ctrnn"}) {
    const auto file = scratch / (kind + ".svg");
    const auto drawn =
        amble({"substrate", source + "/configs/authors/" + kind + "-objective.toml", "-o", file});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_THAT(slurp(file), StartsWith("<svg ")) << kind;
  }
}

TEST(SubstrateCommand, DrawsPortsInColoursOfTheirOwnOfAConfigAndOfAChampion) {
  const TemporaryFolder scratch;
  const auto of_config = amble({"substrate", source + "/robots/hexapod/steer.toml", "-o", scratch / "c.svg"});
  ASSERT_EQ(of_config.exit_code, 0) << of_config.err;
  const std::string champion = source + "/robots/hexapod/steered.json";
  const auto of_champion = amble({"substrate", champion, "-o", scratch / "champion.svg"});
  ASSERT_EQ(of_champion.exit_code, 0) << of_champion.err;
  EXPECT_EQ(of_champion.out, of_config.out) << "all links that there may be";
  for (const char* port : {">hidden<", ">rate<", ">amplitude<", ">shift<", ">coupling<"}) {
    EXPECT_THAT(slurp(scratch / "c.svg"), HasSubstr(port));
    EXPECT_THAT(slurp(scratch / "champion.svg"), HasSubstr(port));
  }
  EXPECT_THAT(slurp(scratch / "champion.svg"), HasSubstr("Substrate of 41 nodes and 834 links"));
  EXPECT_THAT(amble({"substrate", champion, "--set", "seed=2"}).err, HasSubstr("--set is for a config"));
}

/// A substrate of a user's own: each leg's motors hear its foot, its hip's angle and one common sine; each
/// has a neuron more, and the knees know their neighbours'.
std::string own_config() {
  std::string nodes = "  { name = 'clock', group = 'clock', at = [0, 0], sensor = 'sine' },\n";
  const std::pair<const char*, double> legs[] = {{"FL", -1}, {"FR", -0.25}, {"BL", 0.25}, {"BR", 1}};
  for (const auto& [name, x] : legs) {
    const std::string leg = name, at = std::to_string(x);
    nodes += "  { name = '" + leg + " foot', group = 'foot', at = [" + at + ", -1], sensor = 'touch." + leg +
             "' },\n";
    nodes += "  { name = '" + leg + " hip', group = 'hip', at = [" + at + ", -0.5], sensor = 'angle." + leg +
             "_hip_fb' },\n";
    nodes += "  { name = '" + leg + " inner', group = 'inner', at = [" + at + ", 0.25] },\n";
    const std::pair<const char*, const char*> joints[] = {
        {"knee", "0.5"}, {"hip_fb", "0.75"}, {"hip_io", "1"}};
    for (const auto& [joint, y] : joints)
      nodes += "  { name = '" + leg + " " + joint + "', group = 'motor', at = [" + at + ", " + y +
               "], joint = '" + leg + "_" + joint + "' },\n";
  }
  return "include = ['" + source +
         "/configs/parts/authors.toml']\nname = 'my own'\npopulation.size = 40\n"
         "generations = 2\ntrial.duration_s = 1\n[controller]\nkind = 'ctrnn'\n[controller.ctrnn]\n"
         "equation = 'potential'\nintegrator = 'rk4'\nstate = 'kept'\nsteps_per_tick = 2\n"
         "[controller.substrate]\ncoordinates = ['leg', 'height']\noutputs = ['w', 'b']\nnodes = [\n" +
         nodes +
         "]\nlinks = [\n  { from = 'clock', to = 'inner', weight = 'w' },\n"
         "  { from = 'foot', to = 'inner', weight = 'w', same = ['leg'] },\n"
         "  { from = 'hip', to = 'inner', weight = 'w', same = ['leg'] },\n"
         "  { from = 'inner', to = 'motor', weight = 'w', same = ['leg'], both_ways = true },\n"
         "  { from = 'FL knee', to = 'FR knee', weight = 'w', both_ways = true },\n]\nproperties = [\n"
         "  { of = 'inner', property = 'bias', output = 'b', low = -2, high = 2 },\n"
         "  { of = 'motor', property = 'bias', output = 'b' },\n"
         "  { of = 'inner', property = 'time_constant', value = 5 },\n"
         "  { of = 'motor', property = 'time_constant', value = 2.5 },\n]\n";
}

TEST(SubstrateCommand, AndAllOthersTakeASubstrateThatAUserMade) {
  const TemporaryFolder scratch;
  const auto config = scratch / "own.toml", run = scratch / "run";
  spill(config, own_config());
  const auto shown = amble({"substrate", config, "-o", scratch / "own.svg"});
  ASSERT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("CPPN inputs   source.leg, source.height, target.leg, target.height\n"));
  EXPECT_THAT(shown.out, HasSubstr("\n25 nodes (leg, height)\n"));
  // 4 from the clock, 4 from feet, 4 from hips, 2 × 12 between inner neurons and motors, 2 between knees.
  EXPECT_THAT(shown.out, HasSubstr("\n38 links\n"));

  const auto evolved = amble({"evolve", config, "--out", run});
  ASSERT_EQ(evolved.exit_code, 0) << evolved.err;
  const auto champion = fs::directory_iterator(fs::path(run) / "champions")->path().string();
  EXPECT_EQ(amble({"verify", run}).exit_code, 0);
  const auto recording = scratch / "walk.rec";
  const auto trial = amble({"trial", champion, "--record", recording});
  EXPECT_EQ(trial.exit_code, 0) << trial.err;
  EXPECT_THAT(amble({"info", recording}).out, HasSubstr(" neuron.FL inner neuron.FL knee "));
  EXPECT_THAT(amble({"info", champion}).out, HasSubstr("controller  ctrnn"));
  const auto page = amble({"page", run, "-o", scratch / "page.html"});
  EXPECT_EQ(page.exit_code, 0) << page.err;
  EXPECT_THAT(slurp(scratch / "page.html"), HasSubstr("of 38 possible links are expressed"));
}

}  // namespace substrate_test
}  // namespace amble::tests
