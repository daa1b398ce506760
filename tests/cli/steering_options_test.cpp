#include "tests/cli/bad_input.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;

const std::string straight = source + "/robots/hexapod/champion.json",
                  obeying = source + "/robots/hexapod/steered.json",
                  silent = source + "/configs/quick/supg.toml";

/// What is told, how it is steered, and what is written.
class SteeringOptions : public BadInput {
 protected:
  void expect_refused_trial(const std::string& champion, std::vector<std::string> options,
                            const std::string& words) {
    options.insert(options.begin(), {"trial", champion, "--undisturbed", "--seconds", "1"});
    expect_refusal(options, ExitCode::bad_input, words);
  }
  void expect_refused_gains(const std::string& gains, const std::string& words) {
    expect_refused_trial(straight, {"--command", "0.2,0", "--steering", gains}, words);
  }
};

TEST_F(SteeringOptions, AConfigWithoutCommandsTellsNothingAndIsNamed) {
  const std::string words =
      "supg.toml: command.kind is none; expected fixed or random, or commands in one line";
  expect_refused_trial(obeying, {"--command", silent}, words);
  expect_refused_trial(obeying, {"--command", silent, "--draw", scratch_ / "z.svg"}, words);
  expect_refused_trial(straight, {"--command", silent, "--steering", "turn_gain = 1"}, words);
  expect_refused_trial(obeying, {"--command", config_with("command.kind = \"none\"")},
                       "c.toml:2: command.kind is none");
}

TEST_F(SteeringOptions, WhatIsWrongWithACommandIsSaid) {
  const std::pair<const char*, const char*> wrong[] = {
      {"1e3,0", "--command \"1e3,0\": speed = 1000: expected a number from -100 to 100 (m/s)"},
      {"1e400,0", "speed = inf: expected a number from -100 to 100"},
      {"0.2,0; nan,0", "--command \"nan,0\": speed = nan: expected a number from -100 to 100"},
      {"0,-101", "turn = -101: expected a number from -100 to 100 (rad/s to the left)"},
      {"0.2,0,-1", "seconds = -1: expected a number from 0 to 1000000"},
      {"0.2,0;", "--command \"0.2,0;\": expected SPEED,TURN or SPEED,TURN,SECONDS"},
      {" ", "--command \" \": expected SPEED,TURN"},
      {"0.2,x", "--command \"0.2,x\": expected SPEED,TURN"},
      {"0.2,0,10; 0.1,0",
       "--command \"0.2,0,10; 0.1,0\": 10 s of them leave nothing of a trial of 1 s for those without "
       "seconds"}};
  for (const auto& [commands, words] : wrong) expect_refused_trial(obeying, {"--command", commands}, words);
}

TEST_F(SteeringOptions, GainsAreNamedAsTheyWereWritten) {
  expect_refused_gains("foo = 1", "--steering: unknown key 'foo'; expected turn_gain, ");
  expect_refused_gains("turn_gan = 1", "--steering: unknown key 'turn_gan' (did you mean 'turn_gain'?)");
  expect_refused_gains("turn_gain = -1", "--steering: 'turn_gain' = -1: expected a number from 0 to 1000");
  expect_refused_gains("turn_gain = nan", "--steering: 'turn_gain' = nan: expected a number");
  expect_refused_gains("turn_gain = 1, turn_gain = 2", "--steering: turn_gain is given twice");
  expect_refused_gains("heading_gain = 1", "--steering: heading_gain = 1: without a turn_gain nothing turns");
  expect_refused_gains("turn_gain = 1, heading_lead_rad = 1",
                       "--steering: heading_lead_rad = 1: nothing reads a heading error; expected a "
                       "heading_gain as well");
  expect_refused_gains("turn_gain = 1, joint_types = [\"toe\", \"a\"]",
                       "--steering: joint_types[0] = \"toe\": the robot has no joint type toe");
}

TEST_F(SteeringOptions, WhatIsNoGainsIsQuotedWithAnExample) {
  for (const std::string gains : {" ", "turn_gain =", "turn_gain = 1,", "turn_gain = 1 full_speed_m_s = 2",
                                  "turn_gain = [1", "my_robot/steer.toml", "[x]", "= 1"})
    expect_refused_gains(gains, "--steering: \"" + gains +
                                    "\": expected gains, KEY = VALUE with a comma between two "
                                    "(docs/STEERING.md), e.g. \"turn_gain = 1.5, full_speed_m_s = 0.4\"");
  expect_refused_gains("turn_gain = 1; change_s", "--steering: \"change_s\": expected gains");
}

TEST_F(SteeringOptions, CommasAndSemicolonsSeparateGains) {
  const auto with = [](const std::string& gains) {
    const auto told = amble(
        {"trial", straight, "--undisturbed", "--seconds", "2", "--command", "0.2,0.3", "--steering", gains});
    EXPECT_EQ(told.exit_code, 0) << told.err;
    return told.out;
  };
  const std::string one = with("turn_gain = 2, full_speed_m_s = 0.3");
  EXPECT_EQ(with("turn_gain = 2; full_speed_m_s = 0.3"), one);
  EXPECT_NE(with("turn_gain = 2"), one);
}

TEST_F(SteeringOptions, HelpNamesWhatTheyTake) {
  EXPECT_THAT(amble({"trial", "--help"}).out, HasSubstr("--command COMMANDS|FILE "));
  for (const char* command : {"trial", "export"})
    EXPECT_THAT(amble({command, "--help"}).out, HasSubstr("--steering GAINS "));
}

TEST_F(SteeringOptions, AnOptionThatAFormatKnowsNothingOfIsRefused) {
  for (const std::string format : {"json", "mjcf"})
    expect_refusal({"export", straight, "--format", format, "--fixed"}, ExitCode::bad_input,
                   "--fixed: only with --format c");
  expect_refusal({"export", straight, "--format", "mjcf", "--steering", "turn_gain = 1"}, ExitCode::bad_input,
                 "--steering: only with --format c or json");
}

TEST_F(SteeringOptions, TwoOutputsAreTwoFiles) {
  make_run();
  const std::string file = scratch_ / "a.svg";
  std::filesystem::create_directory(scratch_ / "b");
  const std::string same = scratch_ / "b/../a.svg";
  expect_refused_trial(obeying, {"--command", "0.2,0", "--record", file, "--draw", same},
                       "--record and --draw both write ");
  expect_refusal({"draw", straight, "--out", file, "--patterns", same}, ExitCode::bad_input,
                 "--out and --patterns both write ");
  expect_refusal({"view", run_, "--static", "-o", scratch_ / "b/fitness.svg", "--figures", scratch_ / "b"},
                 ExitCode::bad_input, "--out and --figures both write ");
}

TEST_F(SteeringOptions, ADrawingEndsInSvg) {
  const std::string png = scratch_ / "a.png", words = "a.png: expected a name that ends in .svg";
  expect_refused_trial(obeying, {"--command", "0.2,0", "--draw", png}, words);
  expect_refusal({"draw", straight, "--patterns", png}, ExitCode::bad_input, words);
  expect_refusal({"substrate", silent, "-o", png}, ExitCode::bad_input, words);
}

TEST_F(SteeringOptions, NoNumberIsRefusedBeforeAnythingIsTried) {
  for (const char* gain : {"nan", "inf", "-1", "101"})
    expect_refusal({"repertoire", scratch_ / "none", "--switching", "6", "--heading-gain", gain},
                   ExitCode::bad_input,
                   "--heading-gain: " + std::string(gain) + ": expected a number from 0 to 100");
}

TEST_F(SteeringOptions, ARunFolderIsAChampionAndNoConfig) {
  make_run();
  const auto shown = amble({"substrate", run_});
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("12 nodes"));
  for (const std::vector<std::string>& command : {std::vector<std::string>{"evolve", run_, "--out", out_},
                                                  {"settings", run_},
                                                  {"trial", run_, "--ground", run_}})
    expect_refusal(command, ExitCode::bad_input, "run: a run folder, and not a config; expected its ");
}

}  // namespace
}  // namespace amble::tests
