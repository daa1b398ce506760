#include "tests/cli/bad_input.hpp"
#include "tests/models/small_models.hpp"

namespace amble::tests {
namespace {

using testing::HasSubstr;

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

TEST_F(RobotInit, TellsWhatBecameOfTheModel) {
  const auto init = amble({"robot", "--init", write(small_models()[7]), "-o", scratch_ / "out"});
  EXPECT_THAT(init.out, HasSubstr("replaced  root 'trunk' moved by rootx, rootz, rooty: it is free to move"));
}

TEST_F(RobotInit, ReplacesNothing) {
  const std::string model = write(small_models()[0]);
  ASSERT_EQ(amble({"robot", "--init", model, "-o", scratch_ / "out"}).exit_code, 0);
  expect_complaint({"robot", "--init", model, "-o", scratch_ / "out"}, ExitCode::bad_input,
                   "keyframe.toml is there already, and is not replaced");
}

TEST_F(RobotInit, RefusesWhatIsNoModel) {
  expect_complaint({"robot", "--init", scratch_ / "gone.xml"}, ExitCode::io, "gone.xml");
  expect_complaint({"robot", "--init", source + "/robots/quadruped/paper.toml"}, ExitCode::bad_input,
                   "is a robot file: expected a model");
  expect_complaint({"robot"}, ExitCode::bad_input, "--init MODEL");
}

TEST_F(RobotInit, RefusesHostileModelsInOneLineAndLittleMemory) {
  const std::string path = scratch_ / "m.xml";
  std::string bodies = "<mujoco><worldbody>";
  for (int i = 0; i < 1'000'000; ++i) bodies += "<body><geom size=\"1\"/></body>\n";
  for (const auto& [text, words] : std::map<std::string, std::string>{
           {bodies, "more than 1000 bodies"},
           {"<mujoco><include file=\"m.xml\"/></mujoco>", "the file includes itself"},
           {"<mujoco><include file=\"../m.xml\"/></mujoco>", "only files in the model's folder"},
           {"<!DOCTYPE m [<!ENTITY a \"a\">]><mujoco/>", "document types and entities"}}) {
    spill(path, text);
    expect_complaint({"robot", "--init", path, "-o", scratch_ / "out"}, ExitCode::bad_input, words);
  }
  spill(path, bodies);
  EXPECT_LT(amble({"robot", "--init", path, "-o", scratch_ / "out"}).peak_memory_bytes, 300e6);
}

}  // namespace
}  // namespace amble::tests
