#include "tests/cli/bad_input.hpp"

#include <sys/mount.h>
#include <unistd.h>

namespace amble::tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string walker = source + "/robots/hexapod/steered.json";

TEST_F(BadInput, AnUnknownCommand) {
  expect_refusal({"dance"}, ExitCode::bad_input, "unknown command 'dance'; amble help lists all");
  expect_refusal({"evole", config}, ExitCode::bad_input, "unknown command 'evole' (did you mean 'evolve'?)");
  expect_refusal({"help", "repotr"}, ExitCode::bad_input,
                 "unknown command 'repotr' (did you mean 'report'?)");
}

TEST_F(BadInput, AnUnknownOption) {
  expect_refusal({"evolve", config, "--sed", "3", "--out", out_}, ExitCode::bad_input,
                 "unknown option '--sed' (did you mean '--seed'?) (amble evolve --help)");
  expect_refusal({"trial", config, "--second=3"}, ExitCode::bad_input,
                 "unknown option '--second' (did you mean '--seconds'?) (amble trial --help)");
  expect_refusal({"info", config, config}, ExitCode::bad_input, "unexpected argument '");
}

TEST_F(BadInput, AFileOfAnotherKindIsNamedWithTheCommandForIt) {
  const std::string source = AMBLE_SOURCE_DIR;
  expect_refusal({"evolve", source + "/studies/smoke.toml", "--out", out_}, ExitCode::bad_input,
                 "smoke.toml: a study, and not the config of a run");
  expect_refusal({"evolve", source + "/studies/smoke.toml", "--out", out_}, ExitCode::bad_input,
                 "; to run it, run: amble study " + source + "/studies/smoke.toml --out FOLDER");
  expect_refusal({"evolve", source + "/robots/hexapod/hexapod.toml", "--out", out_}, ExitCode::bad_input,
                 "hexapod.toml: a robot file, and not the config of a run (one that has robot = ");
  expect_refusal({"study", config, "--out", out_}, ExitCode::bad_input,
                 "the config of a run, and not a study; to evolve walkers by it, run: amble evolve ");
}

TEST_F(BadInput, AnEmptyValueIsNamedWithWhatIsExpected) {
  const std::string robot = AMBLE_SOURCE_DIR "/robots/hexapod/hexapod.toml";
  const std::vector<std::string> commands[] = {{"robot", robot, "--draw", ""},
                                               {"robot", robot, "--mjcf", ""},
                                               {"robot", "--init", "model.xml", "-o", ""},
                                               {"substrate", config, "-o", ""},
                                               {"view", walker, "--level", "", "-o", out_},
                                               {"view", walker, "--static", "-o", out_, "--figures", ""},
                                               {"view", "runs", "--live", "--address", ""},
                                               {"trial", walker, "--noise", ""},
                                               {"trial", walker, "--record", ""},
                                               {"trial", walker, "--damage", ""},
                                               {"trial", ""},
                                               {"trial", walker, "--seconds", ""},
                                               {"robot", ""},
                                               {"report", ""},
                                               {"evolve", ""},
                                               {"study", ""},
                                               {"lab", ""},
                                               {"gait", ""}};
  for (const auto& command : commands)
    expect_refusal(command, ExitCode::bad_input, " \"\": the value is empty; expected ");
  EXPECT_FALSE(fs::exists("path.svg")) << "figures of no folder are drawn into the current one";
}

TEST_F(BadInput, AFileIsToldByWhatItHoldsAndNotByItsName) {
  const std::string champion = scratch_ / "walker.txt", recording = scratch_ / "walk.json",
                    study = scratch_ / "walks";
  spill(champion, slurp(walker));
  ASSERT_EQ(amble({"trial", champion, "--seconds", "1", "--record", recording}).exit_code, 0);
  for (const std::string command : {"info", "gait", "draw", "substrate"})
    EXPECT_EQ(amble({command, champion}).exit_code, 0) << command;
  for (const std::string command : {"info", "gait"})
    EXPECT_EQ(amble({command, recording}).exit_code, 0) << command;
  EXPECT_EQ(amble({"view", recording, champion, "--seconds", "1", "-o", out_}).exit_code, 2);
  expect_refusal({"trial", recording}, ExitCode::bad_file, "walk.json: is a recording");
  spill(study, slurp(AMBLE_SOURCE_DIR "/studies/smoke.toml"));
  expect_refusal({"info", study}, ExitCode::bad_input, "walks: a study, and no walker");
  expect_refusal({"robot", study}, ExitCode::bad_input, "walks: a study, and not a robot file");
  expect_refusal({"robot", config}, ExitCode::bad_input, ": the config of a run, and not a robot file");
  expect_refusal({"robot", walker}, ExitCode::bad_input, ": a champion, and not a robot file");
  expect_refusal({"robot", scratch_ / "nowhere"}, ExitCode::io, "nowhere: No such file or directory");
  expect_refusal({"robot", "--init", config}, ExitCode::bad_input, ": the config of a run, and not a model");
  expect_refusal({"evolve", champion, "--out", out_}, ExitCode::bad_input,
                 "walker.txt: a champion, and not the config of a run");
  expect_refusal({"study", walker, "--out", out_}, ExitCode::bad_input, ": a champion, and not a study");
}

TEST_F(BadInput, TheSameSettingTwice) {
  expect_refusal({"evolve", config, "--seed", "5", "--set", "seed=6", "--out", out_}, ExitCode::bad_input,
                 "--seed: --set seed=6 says the same setting");
  expect_refusal({"evolve", config, "--generations", "5", "--set", "generations = 6", "--out", out_},
                 ExitCode::bad_input, "--generations: --set generations = 6 says the same setting");
}

TEST_F(BadInput, AnInputThatDoesNotExistIsNamedBeforeAnOptionThatIsMissing) {
  const auto none = scratch_ / "none.toml";
  for (const char* command : {"evolve", "study", "view", "page", "export", "report"})
    expect_refusal({command, none}, ExitCode::io, "none.toml: No such file or directory");
  expect_refusal({"evolve", config}, ExitCode::bad_input, "--out is required (amble evolve --help)");
  expect_refusal({"evolve"}, ExitCode::bad_input, "CONFIG is required (amble evolve --help)");
}

TEST_F(BadInput, MissingConfig) {
  expect_refusal({"evolve", scratch_ / "none.toml", "--out", out_}, ExitCode::io,
                 "none.toml: No such file or directory");
}

TEST_F(BadInput, UnknownKey) {
  expect_refusal({"evolve", config_with("population.sise = 10"), "--out", out_}, ExitCode::bad_input,
                 "c.toml:2: unknown key 'population.sise' (did you mean 'population.size'?)");
}

TEST_F(BadInput, WrongType) {
  expect_refusal({"evolve", config_with("population.size = \"many\""), "--out", out_}, ExitCode::bad_input,
                 "c.toml:2: 'population.size' = \"many\": expected a whole number from 2 to 1000000");
}

TEST_F(BadInput, ValueOutOfRange) {
  expect_refusal({"evolve", config_with("reproduction.elitism = 1.5"), "--out", out_}, ExitCode::bad_input,
                 "c.toml:2: 'reproduction.elitism' = 1.5: expected a number from 0 to 1");
}

TEST_F(BadInput, UnknownChoice) {
  expect_refusal({"evolve", config, "--set", "search.kind=luck", "--out", out_}, ExitCode::bad_input,
                 "--set search.kind=luck: expected ");
}

TEST_F(BadInput, NegativeNumberOfNeighbours) {
  expect_refusal({"evolve", config_with("search.novelty.neighbours = -3"), "--out", out_},
                 ExitCode::bad_input,
                 "c.toml:2: 'search.novelty.neighbours' = -3: expected a whole number from 1 to 1000000");
}

TEST_F(BadInput, ArchiveLargerThanMemory) {
  expect_refusal(
      {"evolve", novelty_config, "--set", "search.novelty.archive_limit=1000000000", "--out", out_},
      ExitCode::bad_input,
      "search.novelty.archive_limit = 1000000000: that many behaviours of 1500 numbers need 7216.0 GB; "
      "expected at most ");
}

TEST_F(BadInput, PathStrideLongerThanATrial) {
  expect_refusal({"evolve", novelty_config, "--set", "search.novelty.path_stride=1501", "--out", out_},
                 ExitCode::bad_input,
                 "search.novelty.path_stride = 1501: expected at most the steps of a trial");
}

TEST_F(BadInput, ArchiveThatIsTruncatedAlteredOrMissing) {
  make_run(novelty_config);
  const auto archive = fs::path(run_) / "archive.bin";
  const auto bytes = slurp(archive);
  const std::vector<std::string> resume{"resume", run_, "--generations", "3"};
  spill(archive, bytes.substr(0, bytes.size() - 7));
  expect_refusal(resume, ExitCode::bad_file, "archive.bin: truncated");
  auto altered = bytes;
  altered[altered.size() / 2] = static_cast<char>(altered[altered.size() / 2] ^ 4);
  spill(archive, altered);
  expect_refusal(resume, ExitCode::bad_file, "archive.bin: altered: the checksum of member");
  spill(archive, "");
  expect_refusal(resume, ExitCode::bad_file, "archive.bin: truncated");
  fs::remove(archive);
  expect_refusal(resume, ExitCode::bad_file, "archive.bin: missing");
  spill(archive, bytes);
  EXPECT_EQ(amble(resume).exit_code, 0);
}

TEST_F(BadInput, UnknownEngine) {
  expect_refusal({"evolve", config, "--set", "engine=newton", "--out", out_}, ExitCode::bad_input, "newton");
}

TEST_F(BadInput, UnknownReferee) {
  expect_refusal({"evolve", config, "--set", "referees=[\"newton\"]", "--out", out_}, ExitCode::bad_input,
                 "'referees' names \"newton\": expected ode, batch, mujoco");
}

TEST_F(BadInput, SubstrateThatDoesNotHoldTogether) {
  expect_refusal({"evolve", config, "--set", "controller.substrate.outputs=[\"pattern\"]", "--out", out_},
                 ExitCode::bad_input,
                 "controller.substrate.properties[1].output = \"offset\": the CPPN has no such output");
  const std::string links = "controller.substrate.links=[{from=\"FL.knee\", to=\"tail\"}]";
  const std::string ctrnn = source + "/configs/authors/ctrnn-objective.toml";
  expect_refusal({"substrate", ctrnn, "--set", links, "-o", out_ + ".svg"}, ExitCode::bad_input,
                 "controller.substrate.links[0].to = \"tail\": there is no node and no group of that name");
  expect_refusal({"substrate", config_with("[controller.substrate]\nnodes = [\n  { nam = \"a\" },\n]")},
                 ExitCode::bad_input,
                 "c.toml:4: unknown key 'controller.substrate.nodes[0].nam' (did you mean "
                 "'controller.substrate.nodes[0].name'?)");
  expect_refusal(
      {"evolve", config, "--set", "controller.substrate.layout=auto", "--out", out_}, ExitCode::bad_input,
      "controller.substrate.coordinates is given, but controller.substrate.layout = \"auto\" makes "
      "it from the robot");
  expect_refusal({"evolve", config, "--set", "controller.substrate=automatic", "--out", out_},
                 ExitCode::bad_input,
                 "--set controller.substrate=automatic: expected one of \"listed\", \"auto\"");
  // A substrate for another robot, and a figure for another time constant than it has.
  expect_refusal({"evolve", ctrnn, "--set", "controller.ctrnn.step=2", "--out", out_}, ExitCode::bad_input,
                 "controller.ctrnn.step = 2: expected at most the shortest time constant, 1");
}

TEST_F(BadInput, SyntaxErrorWithLineAndColumn) {
  spill(scratch_ / "c.toml", "seed = 1\npopulation = { size = \n");
  expect_refusal({"evolve", scratch_ / "c.toml", "--out", out_}, ExitCode::bad_input, "c.toml:2:");
}

TEST_F(BadInput, SettingsThatDoNotFitTogether) {
  expect_refusal({"evolve", config, "--set", "speciation.target_max=500", "--out", out_}, ExitCode::bad_input,
                 "speciation.target_max");
}

TEST_F(BadInput, MissingRobot) {
  expect_refusal({"evolve", config, "--set", "robot=none.toml", "--out", out_}, ExitCode::io,
                 "--set robot=none.toml: 'robot': none.toml: No such file or directory");
}

TEST_F(BadInput, JobsZero) {
  expect_refusal({"evolve", config, "--jobs", "0", "--out", out_}, ExitCode::bad_input,
                 "--jobs: 0: expected a whole number from 1 to 1024");
}

TEST_F(BadInput, SeedOrGenerationsThatAreNone) {
  for (const auto* seed : {"-1", "1.5", "one", "99999999999999999999"})
    expect_refusal({"evolve", config, "--seed", seed, "--out", out_}, ExitCode::bad_input,
                   std::string("--seed: ") + seed + ": expected a whole number from 0 to 9007199254740992");
  for (const auto* octal : {"010", "007", "0x10"})
    expect_refusal({"evolve", config, "--seed", octal, "--out", out_}, ExitCode::bad_input,
                   std::string("--seed: ") + octal + ": expected a whole number without a leading 0");
  expect_refusal({"evolve", config, "--generations", "0", "--out", out_}, ExitCode::bad_input,
                 "--generations: 0: expected a whole number from 1 to 1000000000");
}

TEST_F(BadInput, OutFolderThatHoldsARun) {
  make_run();
  expect_refusal({"evolve", config, "--out", run_}, ExitCode::bad_input, "holds a run already");
}

TEST_F(BadInput, OutFolderThatIsNotEmptyAndNoRun) {
  fs::create_directories(out_);
  spill(fs::path(out_) / "thesis.txt", "years of work");
  expect_refusal({"evolve", config, "--out", out_}, ExitCode::bad_input, "not empty and not a run");
}

TEST_F(BadInput, ChampionTruncatedOrAltered) {
  make_run();
  const auto champion = fs::directory_iterator(fs::path(run_) / "champions")->path();
  const auto text = slurp(champion);
  spill(champion, text.substr(0, text.size() / 2));
  expect_refusal({"trial", champion.string()}, ExitCode::bad_file, champion.string());
  auto altered = text;
  const auto weight = altered.find("\"weight\": ") + 10;
  altered.replace(weight, altered.find_first_of(",}\n", weight) - weight, "0.125");
  spill(champion, altered);
  expect_refusal({"trial", champion.string()}, ExitCode::bad_file, "checksum");
}

TEST_F(BadInput, OutputsThatWouldReplaceFilesOfAnotherKind) {
  make_run();
  const auto champion = fs::directory_iterator(fs::path(run_) / "champions")->path().string();
  expect_refusal({"trial", champion, "--record", champion}, ExitCode::bad_input, "is not a recording");
  expect_refusal({"page", run_, "-o", run_ + "/checkpoint.bin"}, ExitCode::bad_input, "is not a page");
  expect_refusal({"view", run_, "--static", "-o", run_ + "/checkpoint.bin"}, ExitCode::bad_input,
                 "is not a page");
  expect_refusal({"gait", run_, "--json", champion}, ExitCode::bad_input, "is not a gait");
  expect_refusal({"substrate", config, "-o", champion}, ExitCode::bad_input, "is not a drawing");
  expect_refusal({"robot", run_ + "/robot.json", "--mjcf", run_ + "/config.toml"}, ExitCode::bad_input,
                 "is not an MJCF model");
  for (const std::string name : {"99999.json", "../champions/99999.json"})
    expect_refusal({"gait", champion, "--json", run_ + "/champions/" + name}, ExitCode::bad_input,
                   "a run keeps its own champions there");
  fs::create_directories(scratch_ / "figures");
  spill(scratch_ / "figures/path.svg", "a letter to a friend");
  expect_refusal({"page", run_, "-o", scratch_ / "page.html", "--figures", scratch_ / "figures"},
                 ExitCode::bad_input, "is not a figure");
}

TEST_F(BadInput, RunFoldersWithoutTheirRobotOrManifest) {
  make_run();
  const auto robot = slurp(run_ + "/robot.json"), manifest = slurp(run_ + "/manifest.json");
  spill(run_ + "/robot.json", robot.substr(0, robot.size() / 2));
  expect_refusal({"resume", run_}, ExitCode::bad_file, "robot.json");
  fs::remove(run_ + "/robot.json");
  expect_refusal({"resume", run_}, ExitCode::bad_input, "robot.json is missing");
  spill(run_ + "/robot.json", robot);
  fs::remove(run_ + "/manifest.json");
  expect_refusal({"resume", run_}, ExitCode::io, "manifest.json");
}

TEST_F(BadInput, ARunMadeShorterThanItIs) {
  make_run();
  expect_refusal({"resume", run_, "--generations", "1"}, ExitCode::bad_input,
                 "2 generations are done already");
}

TEST_F(BadInput, CheckpointTruncatedAlteredOrOfAnotherVersion) {
  make_run();
  const auto checkpoint = fs::path(run_) / "checkpoint.bin";
  const auto bytes = slurp(checkpoint);
  const std::vector<std::string> resume{"resume", run_, "--generations", "3"};
  spill(checkpoint, bytes.substr(0, bytes.size() - 7));
  expect_refusal(resume, ExitCode::bad_file, "checkpoint.bin: truncated");
  auto altered = bytes;
  altered[altered.size() / 2] = static_cast<char>(altered[altered.size() / 2] ^ 4);
  spill(checkpoint, altered);
  expect_refusal(resume, ExitCode::bad_file, "checksum");
  auto newer = bytes;
  newer[8] = 99;
  spill(checkpoint, newer);
  expect_refusal(resume, ExitCode::bad_file, "version 99");
  fs::remove(checkpoint);
  expect_refusal(resume, ExitCode::io, "checkpoint.bin");
}

TEST_F(BadInput, RunWhoseConfigWasEdited) {
  make_run();
  const auto path = fs::path(run_) / "config.toml";
  auto text = slurp(path);
  const auto at = text.find("add_node_share = 0.01");
  ASSERT_NE(at, std::string::npos);
  spill(path, text.replace(at, 21, "add_node_share = 0.02"));
  expect_refusal({"resume", run_, "--generations", "3"}, ExitCode::bad_file,
                 "written under another config.toml");
}

TEST_F(BadInput, FolderThatIsNoRun) {
  expect_refusal({"resume", scratch_ / "none"}, ExitCode::io, "no such folder");
  expect_refusal({"verify", scratch_.path().string()}, ExitCode::bad_input, "not a run folder");
  expect_refusal({"info", scratch_.path().string()}, ExitCode::bad_input, "not a run folder");
  expect_refusal({"page", scratch_.path().string(), "-o", out_}, ExitCode::bad_input, "not a run folder");
  expect_refusal({"view", scratch_.path().string(), "--static", "-o", out_}, ExitCode::bad_input,
                 "not a run folder");
  expect_refusal({"view", scratch_.path().string(), "--static", "--history", "-o", out_}, ExitCode::bad_input,
                 "--history: not with --static");
  expect_refusal({"view", scratch_.path().string(), "--figures", out_, "-o", out_}, ExitCode::bad_input,
                 "--figures: only with --static");
}

TEST_F(BadInput, TrialOfNoWholeNumberOfSteps) {
  make_run();
  const auto champion = fs::directory_iterator(fs::path(run_) / "champions")->path().string();
  expect_refusal({"trial", champion, "--seconds", "1.0001"}, ExitCode::bad_input,
                 "whole number of timesteps");
  expect_refusal({"trial", champion, "--seconds", "-1"}, ExitCode::bad_input, "--seconds");
  // One trial has no level, and its episode its own noise.
  expect_refusal({"trial", champion, "--episode", "0", "--undisturbed"}, ExitCode::bad_input,
                 "--undisturbed");
  expect_refusal({"trial", champion, "--unseen", "0", "--level", "milli"}, ExitCode::bad_input, "--level");
  expect_refusal({"trial", champion, "--steering", "turn_gain = 1"}, ExitCode::bad_input,
                 "expected --command as well");
  expect_refusal({"trial", champion, "--command", "nowhere.toml"}, ExitCode::bad_input,
                 "there is no file nowhere.toml");
  const std::string robot = AMBLE_SOURCE_DIR "/robots/hexapod/hexapod.toml";
  for (const char* const command : {"trial", "gait"})
    expect_refusal({command, robot}, ExitCode::bad_input, "hexapod.toml: a robot file, and no walker");
  expect_refusal({"view", robot, "-o", scratch_ / "page.html"}, ExitCode::bad_input, "and no walker");
  for (const std::string command : {"trial", "gait", "compare"})
    expect_refusal({command, champion, "--seconds", "nan"}, ExitCode::bad_input, "nan");
  expect_refusal({"view", champion, "--seconds", "nan", "-o", out_}, ExitCode::bad_input, "nan");
  const std::string recording = scratch_ / "walk.rec";
  ASSERT_EQ(amble({"trial", champion, "--record", recording}).exit_code, 0);
  expect_refusal({"gait", recording, "--seconds", "nan"}, ExitCode::bad_input, "nan");
  expect_refusal({"view", recording, "--seconds", "3", "-o", out_}, ExitCode::bad_input,
                 "--seconds: " + recording + " has been made already");
  expect_refusal({"gait", recording, "--engine", "ode"}, ExitCode::bad_input,
                 "--engine: " + recording + " has been made already");
  expect_refusal({"view", scratch_ / "nowhere", "--level", "micro", "-o", out_}, ExitCode::io,
                 "nowhere: No such file or directory");
  expect_refusal({"gait", scratch_ / "nowhere", "--engine", "ode"}, ExitCode::io,
                 "nowhere: No such file or directory");
}

TEST_F(BadInput, GaitOfWhatHasNone) {
  expect_refusal({"gait", scratch_.path().string()}, ExitCode::bad_input, "not a run folder");
  expect_refusal({"gait", scratch_ / "none.rec"}, ExitCode::io, "none.rec");
  spill(scratch_ / "walk.rec", "not a recording");
  expect_refusal({"gait", scratch_ / "walk.rec"}, ExitCode::bad_file, "walk.rec");
  expect_refusal({"gait", scratch_ / "walk.rec", "--debounce", "9"}, ExitCode::bad_input,
                 "debounce = 9 s: expected 0 to 1 s");
}

TEST_F(BadInput, RecordingThatIsNone) {
  spill(scratch_ / "walk.rec", "not a recording");
  expect_refusal({"info", scratch_ / "walk.rec"}, ExitCode::bad_file,
                 "walk.rec: expected a run folder, a champion");
}

TEST_F(BadInput, ViewOfWhatCannotBeShown) {
  const std::string page = scratch_ / "page.html", recording = scratch_ / "walk.rec";
  expect_refusal({"view", scratch_.path().string(), "-o", page}, ExitCode::bad_input, "not a run folder");
  expect_refusal({"view", scratch_ / "none.json", "-o", page}, ExitCode::io, "none.json");
  spill(recording, "not a recording");
  expect_refusal({"view", recording, "-o", page}, ExitCode::bad_file, "walk.rec: ");
  make_run();
  const auto champion = fs::directory_iterator(fs::path(run_) / "champions")->path().string();
  fs::remove(recording);
  ASSERT_EQ(amble({"trial", champion, "--record", recording}).exit_code, 0);
  const auto bytes = slurp(recording);
  spill(recording, bytes.substr(0, bytes.size() / 2));
  expect_refusal({"view", recording, "-o", page}, ExitCode::bad_file, recording + ": truncated");
  spill(page, "a letter to a friend");
  expect_refusal({"view", champion, "-o", page}, ExitCode::bad_input, "page.html");
}

TEST_F(BadInput, DrawingOfWhatIsNoChampion) {
  expect_refusal({"draw", scratch_.path().string()}, ExitCode::bad_input, "not a run folder");
  expect_refusal({"draw", scratch_ / "none.json"}, ExitCode::io, "none.json");
  spill(scratch_ / "c.json", "{}");
  expect_refusal({"draw", scratch_ / "c.json"}, ExitCode::bad_file, "c.json");
  expect_refusal({"draw", scratch_ / "c.json", "-o", scratch_ / "c.png"}, ExitCode::bad_input,
                 "c.png: expected a name that ends in .svg or .dot");
  spill(scratch_ / "c.svg", "a letter to a friend");
  expect_refusal({"draw", scratch_ / "c.json", "-o", scratch_ / "c.svg"}, ExitCode::bad_input, "c.svg");
  expect_refusal({"draw", scratch_ / "c.json", "--patterns", scratch_ / "c.svg"}, ExitCode::bad_input,
                 "c.svg");
}

TEST_F(BadInput, FullDiskLeavesARunThatGoesOnLater) {
  const auto disk = scratch_ / "disk";
  fs::create_directories(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=400k") != 0) GTEST_SKIP() << "needs the right to mount";
  const auto run = (disk / "run").string();
  const auto full = amble({"evolve", config, "--set", "population.size=40", "--set", "trial.duration_s=0.2",
                           "--generations", "2000", "--out", run});
  EXPECT_EQ(full.exit_code, static_cast<int>(ExitCode::io)) << full.err;
  EXPECT_THAT(full.err, HasSubstr("No space left on device"));
  const auto moved = scratch_ / "moved";
  fs::copy(run, moved, fs::copy_options::recursive);
  umount(disk.c_str());
  const auto csv = slurp(fs::path(moved) / "generations.csv");
  const auto rows = std::count(csv.begin(), csv.end(), '\n') - 1;
  const auto resumed = amble({"resume", moved, "--generations", std::to_string(rows + 2)});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
}

}  // namespace
}  // namespace amble::tests
