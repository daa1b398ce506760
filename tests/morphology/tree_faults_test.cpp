#include "amble/morphology/tree_faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "amble/morphology/model_file.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

class TreeFaults : public testing::Test {
 protected:
  std::string refusal(const std::string& text, const std::string& name) {
    return files_.error_of([&] { compile_model(files_.write(name, text)); });
  }
  Files files_;
};

/// A joint from one link to another.
std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return R"(<joint name=")" + name + R"(" type="fixed"><parent link=")" + parent + R"("/><child link=")" +
         child + "\"/></joint>\n";
}

std::string urdf(const std::vector<std::string>& links, const std::string& joints) {
  std::string text = "<robot name=\"r\">\n";
  for (const std::string& link : links) text += "<link name=\"" + link + "\"/>\n";
  return text + joints + "</robot>";
}

TEST_F(TreeFaults, ANameThatIsThereTwiceIsToldWithBothPlaces) {
  EXPECT_EQ(refusal(urdf({"a", "b", "a"}, joint("j", "a", "b")), "r.urdf"),
            "r.urdf:4: a second link is called 'a', as that of r.urdf:2 is: each needs a name of its own");
  EXPECT_EQ(refusal(urdf({"a", "b", "c"}, joint("j", "a", "b") + joint("j", "a", "c")), "r.urdf"),
            "r.urdf:6: a second joint is called 'j', as that of r.urdf:5 is: each needs a name of its own");
  EXPECT_EQ(refusal(with(one_leg_xml, "A_knee", "A_hip"), "m.xml").substr(0, 33),
            "m.xml:12: a second joint is calle");
  EXPECT_EQ(refusal(with(one_leg_xml, R"(body name="shin")", R"(body name="thigh")"), "m.xml"),
            "m.xml:11: a second body is called 'thigh', as that of m.xml:8 is: each needs a name of its own");
  EXPECT_EQ(
      refusal(with(one_leg_xml, R"(geom name="shin")", R"(geom name="thigh")"), "m.xml"),
      "m.xml:13: a second geom is called 'thigh', as that of m.xml:10 is: each needs a name of its own");
  EXPECT_EQ(refusal(with(one_leg_xml, R"(body name="shin")", R"(body name="A_hip")"), "m.xml"), "accepted")
      << "parts of different kinds";
}

TEST_F(TreeFaults, LinksThatAreNoTreeAreNamed) {
  const std::string chain = joint("j1", "a", "b") + joint("j2", "b", "c");
  EXPECT_EQ(
      refusal(urdf({"a", "b", "c"}, chain + joint("j3", "c", "a")), "r.urdf"),
      "r.urdf:7: links hang on each other in a loop: 'a' on 'c' on 'b' on 'a', by the joints 'j3', 'j2', "
      "'j1': a robot's links are a tree, with one link that no joint has as its child");
  EXPECT_THAT(
      refusal(urdf({"a", "b", "c"}, joint("j1", "a", "b") + joint("j2", "b", "b")), "r.urdf"),
      testing::HasSubstr("link 'b' is the child of two joints, 'j2' and 'j1' of r.urdf:5: closed loops"));
  EXPECT_THAT(refusal(urdf({"a", "b"}, joint("j1", "a", "b") + joint("j2", "b", "b2")), "r.urdf"),
              testing::HasSubstr("r.urdf:5: joint 'j2' names the link 'b2', which is not there"));
  EXPECT_THAT(
      refusal(urdf({"a", "b"}, R"(<joint name="j" type="fixed"><parent link="a"/></joint>)"), "r.urdf"),
      testing::HasSubstr("r.urdf:4: joint 'j' has no <child link=\"…\"/>"));
  EXPECT_THAT(refusal(urdf({"top", "a", "b"}, joint("j0", "b", "a") + joint("j1", "a", "b")), "r.urdf"),
              testing::HasSubstr("'a' on 'b' on 'a'"));
}

}  // namespace
}  // namespace amble::morphology
