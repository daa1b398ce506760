#include <fstream>

#include "tests/cli/bad_input.hpp"
#include "tests/models/small_models.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

class RobotInit : public BadInput {
 protected:
  /// A model's file.
  std::string write(const SmallModel& model) {
    const std::string path = scratch_ / (model.name + "." + model.extension);
    spill(path, model.text);
    return path;
  }
};

TEST_F(RobotInit, MakesARobotThatLoadsOfEachSmallModel) {
  for (const SmallModel& model : small_models()) {
    const std::string folder = scratch_ / model.name;
    const auto init = amble({"robot", "--init", write(model), "-o", folder});
    EXPECT_EQ(init.exit_code, 0) << model.name << init.err;
    EXPECT_EQ(init.err, "");
    EXPECT_THAT(init.out, HasSubstr("amble evolve " + folder + "/evolve.toml"));
    const auto shown = amble({"robot", folder + "/" + model.name + ".toml"});
    EXPECT_EQ(shown.exit_code, 0) << model.name << shown.err;
    EXPECT_THAT(slurp(folder + "/evolve.toml"), HasSubstr("include = [\""));
  }
}

/// Without the line that names the preset, whose path depends on the folder.
std::string without_include(const std::string& config) {
  const std::size_t start = config.find("include = ");
  return config.substr(0, start) + config.substr(config.find('\n', start));
}

/// Without the line that MJCF robots have since the engine mujoco-model.
std::string without_model(const std::string& toml) {
  const std::string comment =
      "# Runs and champions carry the MJCF itself, and can walk in its own physics: --engine mujoco-model.\n";
  const std::size_t start = toml.find(comment);
  if (start == std::string::npos) return toml;
  const std::string line = "keep_model = true\n";
  EXPECT_EQ(toml.compare(start + comment.size(), line.size(), line), 0);
  return toml.substr(0, start) + toml.substr(start + comment.size() + line.size());
}

TEST_F(RobotInit, WroteTheRobotsOfTheGallery) {
  for (const auto& [name, extension] : std::map<std::string, std::string>{
           {"hexapod", ".xml"}, {"biped", ".xml"}, {"octopod", ".xml"}, {"servo", ".urdf"}}) {
    const std::string committed = source + "/robots/" + name + "/", folder = scratch_ / name;
    std::filesystem::create_directories(folder);
    spill(folder + "/" + name + extension, slurp(committed + name + extension));
    const auto init = amble({"robot", "--init", folder + "/" + name + extension, "-o", folder});
    ASSERT_EQ(init.exit_code, 0) << init.err;
    EXPECT_THAT(init.out, testing::Not(HasSubstr("warnings:")));
    const std::string toml = slurp(folder + "/" + name + ".toml");
    EXPECT_EQ(toml.find("keep_model = true") != std::string::npos, extension == ".xml");
    EXPECT_EQ(without_model(toml), slurp(committed + name + ".toml"));
    EXPECT_EQ(without_include(slurp(folder + "/evolve.toml")),
              without_include(slurp(committed + "evolve.toml")));
    EXPECT_EQ(std::filesystem::exists(folder + "/steer.toml"), name != "biped");
    if (name == "biped") continue;
    EXPECT_EQ(without_include(slurp(folder + "/steer.toml")),
              without_include(slurp(committed + "steer.toml")));
  }
}

TEST_F(RobotInit, ChampionsOfTheGalleryWalk) {
  for (const char* name : {"hexapod", "biped", "octopod", "servo"}) {
    const auto trial = amble({"trial", source + "/robots/" + name + "/champion.json", "--engine", "batch"});
    EXPECT_THAT(trial.out, HasSubstr("outcome   completed")) << name << trial.err;
  }
}

TEST_F(RobotInit, RewardsStayingUpOnTwoLegsOnly) {
  for (const SmallModel& model : small_models()) {
    if (model.name != "effort" && model.name != "keyframe") continue;
    const std::string folder = scratch_ / model.name;
    ASSERT_EQ(amble({"robot", "--init", write(model), "-o", folder}).exit_code, 0);
    const bool staying_up = slurp(folder + "/evolve.toml").find("upright_time") != std::string::npos;
    EXPECT_EQ(staying_up, model.legs == 2);
    const auto evolve = amble({"evolve", folder + "/evolve.toml", "--set", "population.size=10", "--set",
                               "speciation.target_min=1", "--set", "speciation.target_max=2", "--set",
                               "trial.duration_s=1", "--generations", "1", "--out", folder + "/run"});
    EXPECT_EQ(evolve.exit_code, 0) << evolve.err;
  }
}

TEST_F(RobotInit, ReportsWhatWasKeptAndReplaced) {
  const auto init = amble({"robot", "--init", write(small_models()[7]), "-o", scratch_ / "out"});
  EXPECT_THAT(init.out, HasSubstr("\nimport notes:\n  kept      "));
  EXPECT_THAT(init.out, HasSubstr("replaced  root 'trunk' moved by rootx, rootz, rooty: it is free to move"));
}

TEST_F(RobotInit, GivesAHeavyTrunkMoreSweepsOfTheSolver) {
  std::string model = slurp(source + "/robots/hexapod/hexapod.xml");
  for (const auto& [from, to] : std::map<std::string, std::string>{
           {"mass=\"3.0\"", "mass=\"100\""}, {"forcerange=\"-9 9\"", "forcerange=\"-150 150\""}}) {
    ASSERT_NE(model.find(from), std::string::npos) << from;
    model.replace(model.find(from), from.size(), to);
  }
  spill(scratch_ / "heavy.xml", model);
  const auto init = amble({"robot", "--init", scratch_ / "heavy.xml", "-o", scratch_ / "heavy"});
  ASSERT_EQ(init.exit_code, 0) << init.err;
  const std::string toml = slurp(scratch_ / "heavy/heavy.toml");
  EXPECT_THAT(toml, testing::ContainsRegex("\nsweeps = [0-9]+  # 14 leave an error of 0\\.0"));

  const auto enough = amble({"robot", scratch_ / "heavy/heavy.toml"});
  EXPECT_THAT(enough.out, testing::Not(HasSubstr("Set contact.sweeps")));
  spill(scratch_ / "heavy/heavy.toml", toml.substr(0, toml.find("sweeps = ")));
  const auto few = amble({"robot", scratch_ / "heavy/heavy.toml"});
  EXPECT_THAT(few.out, HasSubstr("solver of the batch engine: 14 sweeps, error of a step 0.0"));
  EXPECT_THAT(few.out, HasSubstr("Set contact.sweeps = "));
}

/// A model of the gallery with `from` replaced by `to` wherever it is.
std::string changed(std::string model, const std::string& from, const std::string& to) {
  EXPECT_NE(model.find(from), std::string::npos) << from;
  for (std::size_t at = 0; (at = model.find(from, at)) != std::string::npos; at += to.size())
    model.replace(at, from.size(), to);
  return model;
}

TEST_F(RobotInit, WarnsOfInertiasTorquesAndMotorsThatAreHardlyMeant) {
  const std::string servo = slurp(source + "/robots/servo/servo.urdf");
  const std::string hexapod = slurp(source + "/robots/hexapod/hexapod.xml");
  const struct {
    std::string model, file, warning;
  } cases[] = {
      {changed(servo, "izz=\"0.00333\"", "izz=\"0.05\""), "inertia.urdf",
       "  body 'base': its moments of inertia"},
      {changed(servo, "izz=\"0.00333\"", "izz=\"33.3\""), "template.urdf",
       "  moments of inertia that would need a body larger than the robot, by those of the shapes with the "
       "body's mass; check inertia, mass and units: base"},
      {changed(servo, "effort=\"1.0\"", "effort=\"0.1\""), "weak.urdf",
       "  torques that do not hold the weight of 1.52 kg on half of the legs in the start pose: front_left_"},
      {changed(servo, "effort=\"1.0\"", "effort=\"1000\""), "effort.urdf",
       "  the model has no limit of torque that a motor could have, and it was guessed: front_left_"},
      {changed(servo, "effort=\"1.0\"", "effort=\"15\""), "kg_cm.urdf",
       "; are they in kg·cm, as on data sheets?"},
      {changed(servo, " velocity=\"", " was=\""), "speed.urdf",
       "  the model has no limit of speed that a motor could have, and it was guessed, 7.2 rad/s at 0.8 rad "
       "from "
       "a target: front_left_"},
      {changed(hexapod, " forcelimited=\"true\" forcerange=\"-9 9\"", ""), "unlimited.xml",
       "  the model has no limit of torque that a motor could have"},
  };
  for (const auto& [model, file, warning] : cases) {
    spill(scratch_ / file, model);
    const auto init = amble({"robot", "--init", scratch_ / file, "-o", scratch_ / (file + ".d")});
    EXPECT_EQ(init.exit_code, 0) << file << init.err;
    EXPECT_THAT(init.out, HasSubstr("\nwarnings:\n"));
    EXPECT_THAT(init.out, HasSubstr(warning)) << file;
  }
  // What concerns the robot itself is said of its file, too.
  EXPECT_THAT(amble({"robot", scratch_ / "weak.urdf.d/weak.toml"}).out,
              HasSubstr("warnings:\n  torques that"));
}

TEST_F(RobotInit, TakesAModularRobotWhoseStatorsAreFixedBodiesAndWhoseFeetAreBricks) {
  const auto init =
      amble({"robot", "--init", source + "/tests/models/ariel_spider.xml", "-o", scratch_ / "spider"});
  ASSERT_EQ(init.exit_code, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("robot ariel_spider: 9 bodies, 8 joints, 4 legs, 1.7 kg"));
  EXPECT_THAT(init.out, HasSubstr("held for a second in its start pose, it stands"));
  const std::string config = slurp(scratch_ / "spider/evolve.toml");
  EXPECT_THAT(config, HasSubstr("engine = \"batch\""));
  EXPECT_THAT(config, HasSubstr("period_s = 3  # three times the 1 s"));
  // Its motors can be told no more than a quarter turn, so it stands within that.
  EXPECT_THAT(slurp(scratch_ / "spider/ariel_spider.toml"), HasSubstr("pitch = [-1.5708, "));
}

TEST_F(RobotInit, GivesServosThatFollowLateACycleInWhichTheyGetThere) {
  std::string late = slurp(source + "/robots/hexapod/hexapod.xml");
  for (std::size_t at; (at = late.find("<velocity")) != std::string::npos;) late.replace(at, 9, "<position");
  late = changed(changed(late, "kv=\"5\"", "kp=\"5\""), "damping=\"0.2\"", "damping=\"2.5\"");
  spill(scratch_ / "late.xml", late);
  spill(scratch_ / "soon.xml", changed(late, "damping=\"2.5\"", "damping=\"0.2\""));
  for (const auto& [name, line] : std::map<std::string, std::string>{
           {"late", "period_s = 1.5  # three times the 0.5 s that the motors take to follow"},
           {"soon", "period_s = 0.48  # hips 0.2 m over the feet"}}) {
    ASSERT_EQ(amble({"robot", "--init", scratch_ / (name + ".xml"), "-o", scratch_ / name}).exit_code, 0);
    EXPECT_THAT(slurp(scratch_ / name / "evolve.toml"), HasSubstr(line));
  }
}

TEST_F(RobotInit, SaysOfNoWeakRobotThatItStandsInItsOwnModel) {
  const std::string hexapod = slurp(source + "/robots/hexapod/hexapod.xml");
  spill(scratch_ / "weak.xml", changed(hexapod, "forcerange=\"-9 9\"", "forcerange=\"-0.05 0.05\""));
  const auto init = amble({"robot", "--init", scratch_ / "weak.xml", "-o", scratch_ / "weak"});
  EXPECT_EQ(init.exit_code, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("held in its start pose it"));
  EXPECT_THAT(init.out, Not(HasSubstr("it stands")));
  spill(scratch_ / "strong.xml", hexapod);
  EXPECT_THAT(amble({"robot", "--init", scratch_ / "strong.xml", "-o", scratch_ / "strong"}).out,
              HasSubstr("it stands"));
  // And evolution begins with it.
  const auto run = amble({"evolve", scratch_ / "weak/evolve.toml", "--generations", "1", "--set",
                          "population.size=10", "--set", "trial.duration_s=1", "--out", scratch_ / "run"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("note: motors too weak to hold the weight on half of the legs: "));
}

TEST_F(RobotInit, NamesJointsOfAnMjcfWithoutARange) {
  spill(scratch_ / "endless.xml", model_text(four_legs({.hip = "", .knee = ""})));
  const auto init = amble({"robot", "--init", scratch_ / "endless.xml", "-o", scratch_ / "endless"});
  EXPECT_THAT(init.out, HasSubstr("joints without a range: they have no stops: FL_")) << init.err;
}

TEST_F(RobotInit, WarnsOfMotorsWithoutAGear) {
  spill(scratch_ / "motors.xml", model_text(four_legs(), "<freejoint/>", {}, R"(<actuator>
    <motor joint="FL_hip" ctrlrange="-1 1" ctrllimited="true"/>
    <motor joint="FL_knee" ctrlrange="-1 1" ctrllimited="true" gear="7"/>
  </actuator>)"));
  const auto init = amble({"robot", "--init", scratch_ / "motors.xml", "-o", scratch_ / "out"});
  EXPECT_EQ(init.exit_code, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("is `gear` missing? FL_hip\n"));
}

TEST_F(RobotInit, NamesActuatorsWithoutANameByWhatTheyActOn) {
  spill(scratch_ / "m.xml", model_text(four_legs(), "<freejoint/>", {},
                                       R"(<tendon><fixed name="string"><joint joint="RR_knee" coef="1"/>
    <joint joint="RL_knee" coef="1"/></fixed></tendon><actuator><position joint="FL_hip" kp="20"/><motor tendon="string"/><motor name="pull" tendon="string"/></actuator>)"));
  const auto init = amble({"robot", "--init", scratch_ / "m.xml", "-o", scratch_ / "out"});
  EXPECT_THAT(
      init.out,
      HasSubstr("actuators of no joint of the robot have control 0: 1 (of tendon string), 2 (pull)\n"));
}

TEST_F(RobotInit, PrintsCommandsOnALineOfTheirOwnWhateverTheFolderIsCalled) {
  const std::string folder = scratch_ / "two\nlines";
  const auto init = amble({"robot", "--init", write(small_models()[0]), "-o", folder});
  EXPECT_EQ(init.exit_code, 0) << init.err;
  EXPECT_THAT(init.out, HasSubstr("two\\nlines/evolve.toml' --out $'"));
}

TEST_F(RobotInit, ReplacesNothing) {
  const std::string model = write(small_models()[0]);
  ASSERT_EQ(amble({"robot", "--init", model, "-o", scratch_ / "out"}).exit_code, 0);
  const std::string robot = scratch_ / "out/keyframe.toml", config = scratch_ / "out/evolve.toml";
  expect_refusal({"robot", "--init", model, "-o", scratch_ / "out"}, ExitCode::bad_input,
                 robot + ", " + config + ", " + std::string(scratch_ / "out/steer.toml") +
                     " are there already, and are not replaced: delete them first, or name another folder "
                     "with -o");
  std::filesystem::remove(robot);
  std::filesystem::remove(scratch_ / "out/steer.toml");
  expect_refusal({"robot", "--init", model, "-o", scratch_ / "out"}, ExitCode::bad_input,
                 config + " is there already, and is not replaced: delete it first, or");
}

TEST_F(RobotInit, RefusesWhatIsNoModel) {
  expect_refusal({"robot", "--init", scratch_ / "gone.xml"}, ExitCode::io, "gone.xml");
  expect_refusal({"robot", "--init", source + "/robots/quadruped/paper.toml"}, ExitCode::bad_input,
                 ": a robot file, and not a model, MJCF (.xml) or URDF (.urdf)");
  expect_refusal({"robot"}, ExitCode::bad_input, "--init MODEL");
}

TEST_F(RobotInit, RefusesHostileModelsInOneLineAndLittleMemory) {
  const std::string path = scratch_ / "m.xml";
  for (const auto& [text, words] : std::map<std::string, std::string>{
           {"<mujoco><include file=\"m.xml\"/></mujoco>", "the file includes itself"},
           {"<mujoco><include file=\"/etc/hostname\"/></mujoco>", "only files in the model's folder"},
           {"<!DOCTYPE m [<!ENTITY a \"a\">]><mujoco/>", "document types with entities"}}) {
    spill(path, text);
    expect_refusal({"robot", "--init", path, "-o", scratch_ / "out"}, ExitCode::bad_input, words);
  }
  // A child's peak begins with the memory of the process it was forked from: this one never holds the file's
  // text.
  std::ofstream file(path);
  file << "<mujoco><worldbody>";
  for (int i = 0; i < 1'000'000; ++i) file << "<body><geom size=\"1\"/></body>\n";
  file.close();
  const auto refused = amble({"robot", "--init", path, "-o", scratch_ / "out"});
  EXPECT_EQ(refused.exit_code, static_cast<int>(ExitCode::bad_input));
  EXPECT_THAT(refused.err, HasSubstr("more than 1000 bodies"));
  EXPECT_LT(refused.peak_memory_bytes, 300e6);
}

}  // namespace
}  // namespace amble::tests
