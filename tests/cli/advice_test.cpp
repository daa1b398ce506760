#include <filesystem>
#include <fstream>

#include "tests/cli/bad_input.hpp"
#include "tests/models/small_models.hpp"

namespace amble::tests {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What is said where something else was meant, with what to do.
class Advice : public BadInput {
 protected:
  /// The program alone, in a folder without presets.
  std::string bare() {
    fs::create_directories(scratch_ / "bare");
    const std::string program = scratch_ / "bare/amble";
    fs::copy_file(AMBLE_PROGRAM, program, fs::copy_options::overwrite_existing);
    return program;
  }
  Finished run_bare(const std::string& arguments) {
    Finished finished;
    const std::string line = "cd '" + std::string(scratch_ / "bare") + "' && '" + bare() + "' " + arguments +
                             " > out.txt 2> err.txt";
    finished.exit_code = WEXITSTATUS(std::system(line.c_str()));
    finished.out = slurp(scratch_ / "bare/out.txt");
    finished.err = slurp(scratch_ / "bare/err.txt");
    return finished;
  }
};

TEST_F(Advice, AProgramWithoutItsPresetsSaysSoWhereItNeedsThem) {
  bare();
  spill(scratch_ / "bare/r.urdf", urdf_with_effort());
  const auto init = run_bare("robot --init r.urdf");
  EXPECT_EQ(init.exit_code, 0) << init.err;
  EXPECT_THAT(init.out,
              AllOf(HasSubstr("\nwarnings:\n"), HasSubstr("presets of amble were not found: r/evolve.toml"),
                    HasSubstr("folder configs/")));
  const auto evolve = run_bare("evolve r/evolve.toml --out run");
  EXPECT_EQ(evolve.exit_code, static_cast<int>(ExitCode::io));
  EXPECT_THAT(evolve.err,
              AllOf(HasSubstr("No such file or directory"), HasSubstr("amble's folder configs/")));
  const auto lab = run_bare("lab -o lab.html");
  EXPECT_EQ(lab.exit_code, static_cast<int>(ExitCode::io));
  EXPECT_THAT(lab.err, AllOf(HasSubstr("were not found"), HasSubstr("run amble where it was built")));
  // Beside its presets there is nothing to say.
  spill(scratch_ / "r.urdf", urdf_with_effort());
  const auto beside = amble({"robot", "--init", scratch_ / "r.urdf", "-o", scratch_ / "r"});
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_THAT(beside.out, Not(HasSubstr("presets")));
}

TEST_F(Advice, AnIncludeThatIsNoPresetIsNotLookedForThere) {
  spill(scratch_ / "c.toml", "include = [\"other.toml\"]\n");
  const auto evolve = amble({"evolve", scratch_ / "c.toml", "--out", out_});
  EXPECT_THAT(evolve.err, AllOf(HasSubstr("other.toml: No such file"), Not(HasSubstr("presets"))));
}

TEST_F(Advice, OutMayBeShortWhereverItIs) {
  const auto run = amble({"evolve", config, "--set", "population.size=40", "--set", "trial.duration_s=0.5",
                          "--generations", "1", "-o", run_});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(fs::exists(run_ + "/generations.csv"));
  expect_refusal({"study", config, "-o", out_}, ExitCode::bad_input,
                 "to evolve walkers by it, run: amble evolve ");
  expect_refusal({"info", run_, "-o"}, ExitCode::bad_input, "unknown option '-o' (amble info --help)");
}

TEST_F(Advice, AConfigForAnotherRobotIsGivenASubstrateOfItsJoints) {
  const std::string quick = source + "/configs/quick/quadruped.toml",
                    robot = "robot=" + source + "/robots/hexapod/hexapod.toml";
  expect_refusal({"evolve", quick, "--set", robot, "--out", out_}, ExitCode::bad_input,
                 "--set controller.substrate=auto");
}

TEST_F(Advice, SettingsDifferBetweenTwoConfigsAtLeast) {
  for (const std::vector<std::string>& files : {std::vector<std::string>{}, {config}}) {
    std::vector<std::string> arguments{"settings", "--differing"};
    arguments.insert(arguments.end(), files.begin(), files.end());
    expect_refusal(arguments, ExitCode::bad_input,
                   "--differing: settings that differ between configs; expected two");
  }
}

TEST_F(Advice, AModelGivenForARobotIsSentToInit) {
  expect_refusal({"robot", source + "/robots/servo/servo.urdf"}, ExitCode::bad_input,
                 "run: amble robot --init " + source + "/robots/servo/servo.urdf");
}

TEST_F(Advice, ARecordingIsNoChampionAndTheCommandsForItAreNamed) {
  make_run();
  const std::string recording = scratch_ / "walk.rec";
  ASSERT_EQ(amble({"trial", run_, "--record", recording}).exit_code, 0);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"export", recording, "--format", "json"}, {"trial", recording}})
    expect_refusal(arguments, ExitCode::bad_file,
                   "walk.rec: is a recording, which `amble view`, `gait` and `info` take: expected a "
                   "champion");
}

TEST_F(Advice, AnExportMakesItsFolder) {
  make_run();
  for (const char* format : {"c", "json", "mjcf"}) {
    const std::string file = scratch_ / (std::string("new_") + format + "/deep/x.c");
    EXPECT_EQ(amble({"export", run_, "--format", format, "-o", file}).exit_code, 0) << format;
    EXPECT_TRUE(fs::exists(file)) << format;
  }
  // Not before all else is right.
  expect_refusal({"export", run_, "--format", "c", "-o", scratch_ / "none/x.cc"}, ExitCode::bad_input,
                 "expected -o FILE.c");
  expect_refusal({"export", run_, "--format", "c", "-o", run_ + "/config.toml/x.c"}, ExitCode::io,
                 "/config.toml/x.c: Not a directory");
}

TEST_F(Advice, AFolderOfAnotherKindIsNamedWithTheCommandForIt) {
  make_run();
  expect_refusal({"report", run_, "-o", out_}, ExitCode::bad_input,
                 "not a study's folder but a run's; for its page, run: amble view " + run_ + " --static -o");
  const std::string study = scratch_ / "study";
  fs::create_directories(study);
  spill(study + "/study.toml", "name = \"s\"\n");
  const std::string page = "; for its page, run: amble report " + study;
  expect_refusal({"info", study}, ExitCode::bad_input, "study: not a run folder but a study's" + page);
  fs::create_directories(study + "/runs");
  const std::string words = ", whose runs are in " + study + "/runs" + page;
  for (const char* command : {"info", "resume", "trial", "verify"})
    expect_refusal({command, study}, ExitCode::bad_input, words);
  for (const char* command : {"view", "page"})
    expect_refusal({command, study, "-o", out_}, ExitCode::bad_input, words);
  expect_refusal({"export", study, "--format", "json"}, ExitCode::bad_input, words);
}

TEST_F(Advice, AConfigOfARobotThatObeysSaysHowItIsSteeredByHand) {
  spill(scratch_ / "r.xml", model_text(four_legs()));
  ASSERT_EQ(amble({"robot", "--init", scratch_ / "r.xml", "-o", scratch_ / "r"}).exit_code, 0);
  EXPECT_THAT(slurp(scratch_ / "r/steer.toml"),
              HasSubstr("did better after a minute:\n#   --set controller.kind=supg --set "
                        "controller.differential.turn_gain="));
}

}  // namespace
}  // namespace amble::tests
