#include "tests/cli/bad_input.hpp"

namespace amble::tests {
namespace {

namespace fs = std::filesystem;

class BadRobot : public BadInput {
 protected:
  BadRobot() { fs::copy(source + "/robots/quadruped", scratch_ / "robot"); }
  void replace(const std::string& file, const std::string& what, const std::string& with) {
    auto text = slurp(scratch_ / "robot" / file);
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos);
    spill(scratch_ / "robot" / file, text.replace(at, what.size(), with));
  }
  std::string robot_ = scratch_ / "robot/authors.toml";
};

TEST_F(BadRobot, ThatMujocoRefuses) {
  replace("authors.xml", "<worldbody>", "<worldbody><body><joint/></body>");
  expect_refusal({"robot", robot_}, ExitCode::bad_input, "authors.xml");
}

TEST_F(BadRobot, ThatIsNoXml) {
  replace("authors.xml", "</worldbody>", "");
  expect_refusal({"robot", robot_}, ExitCode::bad_input, "authors.xml");
}

TEST_F(BadRobot, WithAJointThatTheSideFileDoesNotName) {
  replace("authors.xml", "name=\"FL_knee\"", "name=\"FL_elbow\"");
  expect_refusal({"robot", robot_}, ExitCode::bad_input, "FL_");
}

TEST_F(BadRobot, ThatHasFallenBeforeItStarts) {
  replace("authors.toml", "fall_height_m = 0.467", "fall_height_m = 5");
  expect_refusal({"robot", robot_}, ExitCode::bad_input, "'fall_height_m' = 5: expected less than 0.8");
}

TEST_F(BadRobot, WithAModelThatIsNotThere) {
  fs::remove(scratch_ / "robot/authors.xml");
  expect_refusal({"robot", robot_}, ExitCode::io, "authors.xml");
}

}  // namespace
}  // namespace amble::tests
