#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cli/bad_input.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;

class RepertoireCommand : public BadInput {
 protected:
  /// A small map; the same run each time.
  std::string run() {
    const std::string folder = scratch_ / "run";
    const auto evolved = amble({"evolve", source + "/configs/repertoire/quadruped.toml", "--set",
                                "search.map_elites.batch=64", "--set", "search.map_elites.initial=64",
                                "--set", "trial.duration_s=1", "--generations", "4", "--out", folder});
    EXPECT_EQ(evolved.exit_code, 0) << evolved.err;
    EXPECT_THAT(evolved.out, testing::EndsWith("amble repertoire " + folder + " -o map.html\n"));
    EXPECT_THAT(evolved.err, HasSubstr("64 genomes × 1 s in batch"));
    return folder;
  }
  nlohmann::json json(const std::string& path) { return nlohmann::json::parse(slurp(path)); }

  const std::string source = AMBLE_SOURCE_DIR;
};

TEST_F(RepertoireCommand, ShowsTheMapAndSaysHowToGoOn) {
  const auto folder = run();
  const auto shown = amble({"repertoire", folder});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("of 625 cells"));
  EXPECT_THAT(shown.out, HasSubstr("duty_factor FL (0 … 1)"));
  EXPECT_THAT(shown.out, HasSubstr("amble repertoire " + folder + " --cell"));
  const auto info = amble({"info", folder}).out;
  EXPECT_THAT(info, HasSubstr("`amble repertoire " + folder + "` shows the map"));
  EXPECT_THAT(info, testing::ContainsRegex("map +[0-9]+ of 625 cells, [0-9.]+ %; QD score [0-9.]+\n"));
  const auto corrected = amble({"repertoire", folder, "--retest", "20"}).out;
  const auto score = corrected.find("QD score"), end = corrected.find(' ', score + 9);
  EXPECT_THAT(info, testing::ContainsRegex(
                        "corrected +[0-9]+ of 625 cells, [0-9.]+ %; " + corrected.substr(score, end - score) +
                        "; [0-9.]+ % of the elites stay in their cell \\(20 new trials each\\)"));
}

TEST_F(RepertoireCommand, WritesAllElitesAndEachOfThemAsAChampion) {
  const auto folder = run();
  ASSERT_EQ(amble({"repertoire", folder, "-o", scratch_ / "map.json"}).exit_code, 0);
  const auto map = json(scratch_ / "map.json");
  EXPECT_EQ(map["format"], "amble-repertoire");
  EXPECT_EQ(map["cells"], 625);
  EXPECT_EQ(map["dimensions"][3]["leg"], "BR");
  ASSERT_GT(map["elites"].size(), 3u);
  EXPECT_NEAR(map["coverage"].get<double>(), static_cast<double>(map["elites"].size()) / 625.0, 1e-12);
  double sum = 0.0;
  int before = -1;
  for (const auto& elite : map["elites"]) {
    sum += elite["objective"].get<double>();
    EXPECT_GT(elite["cell"].get<int>(), before);
    before = elite["cell"];
    int cell = 0;
    for (const double duty : elite["descriptor"]) cell = 5 * cell + std::min(4, static_cast<int>(5.0 * duty));
    EXPECT_EQ(elite["cell"], cell);
  }
  EXPECT_NEAR(map["qd_score"].get<double>(), sum, 1e-9);

  const auto& elite = map["elites"][0];
  const auto taken =
      amble({"repertoire", folder, "--cell", elite["cell"].dump(), "-o", scratch_ / "elite.json"});
  ASSERT_EQ(taken.exit_code, 0) << taken.err;
  EXPECT_EQ(json(scratch_ / "elite.json")["genome"], elite["genome"]);
  EXPECT_THAT(amble({"trial", scratch_ / "elite.json"}).out, HasSubstr("outcome"));
}

TEST_F(RepertoireCommand, TriesElitesAgainWithTheSameResultForAnyNumberOfWorkers) {
  const auto folder = run();
  const auto one = amble({"repertoire", folder, "--retest", "5"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, testing::ContainsRegex("objective +[0-9.]+ % of what the map says"));
  EXPECT_THAT(one.out, HasSubstr("elites, each in 5 new trials"));
  EXPECT_EQ(amble({"repertoire", folder, "--retest", "5", "--jobs", "3"}).out, one.out);
}

TEST_F(RepertoireCommand, DrawsTheMap) {
  const auto folder = run();
  ASSERT_EQ(amble({"repertoire", folder, "-o", scratch_ / "map.svg"}).exit_code, 0);
  EXPECT_THAT(slurp(scratch_ / "map.svg"), testing::StartsWith("<svg"));
  EXPECT_THAT(slurp(scratch_ / "map.svg"), HasSubstr("in 20 new trials"));
  ASSERT_EQ(amble({"repertoire", folder, "--retest", "0", "-o", scratch_ / "map.svg"}).exit_code, 0);
  EXPECT_THAT(slurp(scratch_ / "map.svg"), testing::Not(HasSubstr("new trials")));
}

TEST_F(RepertoireCommand, WritesATableOfWhatEachEliteKeeps) {
  const auto folder = run();
  ASSERT_EQ(amble({"repertoire", folder, "--retest", "4", "-o", scratch_ / "map.csv"}).exit_code, 0);
  ASSERT_EQ(amble({"repertoire", folder, "-o", scratch_ / "map.json"}).exit_code, 0);
  std::istringstream table(slurp(scratch_ / "map.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_THAT(line, testing::StartsWith("cell,objective,evaluations,duty_factor FL,"));
  EXPECT_THAT(line, testing::EndsWith(",typical duty_factor BR,stays"));
  const auto elites = json(scratch_ / "map.json")["elites"];
  std::size_t count = 0, stays = 0;
  for (; std::getline(table, line); ++count) {
    ASSERT_LT(count, elites.size());
    EXPECT_THAT(line, testing::StartsWith(elites[count]["cell"].dump() + ","));
    EXPECT_EQ(std::ranges::count(line, ','), 13);
    stays += line.ends_with(",1");
  }
  EXPECT_EQ(count, elites.size());
  const auto share = 100.0 * static_cast<double>(stays) / static_cast<double>(count);
  EXPECT_THAT(amble({"repertoire", folder, "--retest", "4"}).out,
              HasSubstr(fmt::format("in place    {:.1f} %", share)));
}

TEST_F(RepertoireCommand, MakesAPageInWhichAsManyCellsWalkAsAreAskedFor) {
  const auto folder = run();
  ASSERT_EQ(amble({"repertoire", folder, "-o", scratch_ / "map.json"}).exit_code, 0);
  const auto elites = json(scratch_ / "map.json")["elites"];
  double best = 0.0;
  for (const auto& elite : elites) best = std::max(best, elite["objective"].get<double>());
  for (const std::size_t most : {1u, 5u, 1000u}) {
    const std::string page = scratch_ / ("map" + std::to_string(most) + ".html");
    const auto made =
        amble({"repertoire", folder, "--retest", "0", "-o", page, "--walkers", std::to_string(most)});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto data = page_data(slurp(page));
    std::set<int> cells;
    for (const auto& walker : data["walkers"]) cells.insert(walker["cell"].get<int>());
    EXPECT_EQ(cells.size(), std::min(most, elites.size()));
    EXPECT_EQ(data["walkers"].size(), cells.size()) << "none twice";
    for (const auto& elite : elites)
      if (elite["cell"] == data["walkers"][0]["cell"]) {
        EXPECT_EQ(elite["objective"], best);
      }
    EXPECT_THAT(data["map"]["svg"].get<std::string>(), HasSubstr("cell" + std::to_string(*cells.begin())));
    EXPECT_THAT(data["map"]["curves_svg"].get<std::string>(), HasSubstr("QD score"));
  }
}

TEST_F(RepertoireCommand, ShowsFirstTheEliteThatDoesBestInNewTrialsAmongThoseThatStay) {
  const auto folder = run();
  const std::string table = scratch_ / "map.csv", page = scratch_ / "map.html";
  ASSERT_EQ(amble({"repertoire", folder, "--retest", "4", "-o", table}).exit_code, 0);
  ASSERT_EQ(amble({"repertoire", folder, "--retest", "4", "--walkers", "5", "-o", page}).exit_code, 0);
  std::istringstream lines(slurp(table));
  std::string line;
  std::getline(lines, line);
  std::vector<std::string> names;
  std::istringstream head(line);
  for (std::string name; std::getline(head, name, ',');) names.push_back(name);
  const auto column = [&](const std::string& name) { return std::ranges::find(names, name) - names.begin(); };
  std::pair<bool, double> best{false, -1e9};
  int cell = -1;
  while (std::getline(lines, line)) {
    std::vector<std::string> values;
    std::istringstream row(line);
    for (std::string value; std::getline(row, value, ',');) values.push_back(value);
    const auto at = [&](const std::string& name) {
      return values.at(static_cast<std::size_t>(column(name)));
    };
    const std::pair<bool, double> these{at("stays") == "1", std::stod(at("typical objective"))};
    if (these > best) best = these, cell = std::stoi(at("cell"));
  }
  EXPECT_EQ(page_data(slurp(page))["walkers"][0]["cell"], cell);
}

TEST_F(RepertoireCommand, IsComparedCellByCellWithMapsOfTheSameCells) {
  const auto evolve = [this](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> command{"evolve",        source + "/configs/repertoire/quadruped.toml",
                                     "--generations", "3",
                                     "--set",         "search.map_elites.batch=64",
                                     "--set",         "search.map_elites.initial=64",
                                     "--set",         "trial.duration_s=1",
                                     "--out",         scratch_ / name};
    command.insert(command.end(), more.begin(), more.end());
    EXPECT_EQ(amble(command).exit_code, 0);
    EXPECT_EQ(amble({"repertoire", scratch_ / name, "-o", scratch_ / (name + ".json")}).exit_code, 0);
    return (scratch_ / name).string();
  };
  const std::vector<std::string> cells{"--set",
                                       "search.map_elites.descriptors=[{quantity=\"duty_factor\",bins=8},{"
                                       "quantity=\"forward\",least=-1,bins=8}]"};
  const auto a = evolve("a", cells), b = evolve("b", {cells[0], cells[1], "--seed", "2"});
  const auto other =
      evolve("other", {"--set", "search.map_elites.descriptors=[{quantity=\"height\",bins=5}]"});
  const auto compared =
      nlohmann::json::parse(amble({"compare", a, b, other, "--engines", "batch", "--format", "json"}).out);
  const auto objectives = [this](const std::string& run) {
    std::map<int, double> by_cell;
    const auto map = json(run + ".json");
    for (const auto& elite : map["elites"]) by_cell[elite["cell"]] = elite["objective"];
    return by_cell;
  };
  const auto first = objectives(a), second = objectives(b);
  int common = 0, better = 0, worse = 0;
  for (const auto& [cell, objective] : second) {
    if (!first.contains(cell)) continue;
    ++common;
    better += objective > first.at(cell);
    worse += objective < first.at(cell);
  }
  ASSERT_GT(common, 3);
  EXPECT_FALSE(compared[0]["map"].contains("from_first"));
  EXPECT_EQ(compared[0]["map"]["filled"], first.size());
  const auto& from = compared[1]["map"]["from_first"];
  EXPECT_EQ(from["common"], common);
  EXPECT_EQ(from["better"], better);
  EXPECT_EQ(from["worse"], worse);
  EXPECT_EQ(from["only_here"], static_cast<int>(second.size()) - common);
  EXPECT_EQ(from["only_there"], static_cast<int>(first.size()) - common);
  EXPECT_FALSE(compared[2]["map"].contains("from_first")) << "its cells are others";
  const auto text = amble({"compare", a, b, other, "--engines", "batch"}).out;
  EXPECT_THAT(text, HasSubstr("QD score"));
  EXPECT_THAT(text, HasSubstr("other cells"));
}

TEST_F(RepertoireCommand, WritesAWalkerThatSwitchesBetweenElitesAsItIsTold) {
  const std::string folder = scratch_ / "gaits", out = scratch_ / "switching.json";
  ASSERT_EQ(amble({"evolve", source + "/robots/hexapod/gaits.toml", "--set", "search.map_elites.batch=64",
                   "--set", "search.map_elites.initial=256", "--set", "trial.duration_s=2", "--set",
                   "search.map_elites.trials=1", "--generations", "3", "--out", folder})
                .exit_code,
            0);
  const auto made = amble({"repertoire", folder, "--switching", "4", "--retest", "2", "-o", out});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("amble view " + out));
  const auto champion = json(out);
  const auto& gaits = champion["controller"]["switching"]["gaits"];
  ASSERT_GE(gaits.size(), 2u);
  ASSERT_LE(gaits.size(), 4u);
  EXPECT_EQ(nlohmann::json::parse(gaits[0]["genome"].get<std::string>()), champion["genome"]);
  std::set<std::pair<double, double>> different;
  for (const auto& gait : gaits)
    different.emplace(gait["speed_m_s"].get<double>(), gait["turn_rad_s"].get<double>());
  EXPECT_EQ(different.size(), gaits.size());
  EXPECT_THAT(amble({"trial", out, "--command", "0.2,0; 0,0.3; 0,0", "--undisturbed"}).out,
              HasSubstr("followed to"));
  EXPECT_THAT(amble({"export", out, "--format", "c", "-o", scratch_ / "walker.c"}).err,
              HasSubstr("controller.switching cannot be exported"));
}

TEST_F(RepertoireCommand, RefusesWhatItCannotDoInOneLine) {
  const auto folder = run();
  expect_refusal({"repertoire", folder, "--switching", "4", "-o", scratch_ / "walker.json"},
                 ExitCode::bad_input, "the map has no dimension own_speed");
  expect_refusal({"repertoire", folder, "--switching", "4"}, ExitCode::bad_input, "expected -o FILE.json");
  expect_refusal({"repertoire", folder, "--heading-gain", "1"}, ExitCode::bad_input,
                 "--heading-gain requires --switching");
  const std::string out = scratch_ / "elite.json";
  expect_refusal({"repertoire", folder, "--cell", "625", "-o", out}, ExitCode::bad_input,
                 "the map has the cells 0 … 624");
  expect_refusal({"repertoire", folder, "--cell", "0"}, ExitCode::bad_input, "expected -o FILE.json");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"-o", scratch_ / "m.svg"}, {"--cell", "0", "-o", out}}) {
    std::vector<std::string> arguments{"repertoire", folder, "--walkers", "9"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refusal(arguments, ExitCode::bad_input, "--walkers 9: only with -o FILE.html");
  }
  expect_refusal({"repertoire", folder, "--cell", "0470", "-o", out}, ExitCode::bad_input,
                 "without a leading 0");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"repertoire", folder, "--cell", "0"},
        {"export", folder, "--format", "json"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"-o", folder + "/champions/00000.json"});
    expect_refusal(arguments, ExitCode::bad_input, "a run keeps its own champions there");
  }
  expect_refusal({"repertoire", folder, "-o", scratch_ / "map.png"}, ExitCode::bad_input,
                 "expected FILE.html, FILE.json, FILE.csv or FILE.svg");
  expect_refusal({"repertoire", scratch_ / "gone"}, ExitCode::io, "gone");
  spill(scratch_ / "map.svg", "mine");
  expect_refusal({"repertoire", folder, "-o", scratch_ / "map.svg"}, ExitCode::bad_input, "map.svg");
  const std::string other = scratch_ / "other";
  ASSERT_EQ(amble({"evolve", source + "/configs/authors/supg-objective.toml", "--set", "population.size=30",
                   "--set", "trial.duration_s=0.1", "--generations", "1", "--out", other})
                .exit_code,
            0);
  expect_refusal({"repertoire", other}, ExitCode::bad_input, "expected one with \"map-elites\"");
}

}  // namespace
}  // namespace amble::tests
