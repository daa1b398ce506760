#include <gtest/gtest.h>

#include <ctime>
#include <string>

#include "amble/morphology/model_file.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

class HostileModel : public testing::Test {
 protected:
  /// The line that refuses it, within ten seconds of the processor (sanitizers take three).
  std::string refusal(const std::string& text, const std::string& name = "m.xml") {
    const auto path = files_.write(name, text);
    const std::clock_t start = std::clock();
    std::string line = files_.error_of([&] { compile_model(path); });
    EXPECT_LT(std::clock() - start, 10 * CLOCKS_PER_SEC);
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    return line;
  }
  Files files_;
};

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST_F(HostileModel, WithAMillionBodies) {
  const std::string body = "<body><joint/><geom size=\"1\"/></body>\n";
  EXPECT_EQ(refusal("<mujoco><worldbody>\n" + repeated(body, 1'000'000) + "</worldbody></mujoco>"),
            "m.xml:1002: too large a model: more than 1000 bodies");
  EXPECT_EQ(refusal("<mujoco><worldbody>\n" + repeated("<body>", 1'000'000)),
            "m.xml:2: too large a model: elements within each other 257 deep");
  EXPECT_EQ(refusal("<mujoco><worldbody>\n" + repeated("<site/>", 1'000'000)),
            "m.xml:2: too large a model: more than 200000 elements");
}

TEST_F(HostileModel, WithBodiesThatTheCompilerWouldMake) {
  EXPECT_EQ(
      refusal(R"(<mujoco><worldbody><composite type="grid" count="9999 9999 1"/></worldbody></mujoco>)"),
      "m.xml:1: <composite>: elements that make bodies when the model is compiled are not read; let "
      "MuJoCo write the model out (compile model.xml out.xml)");
}

TEST_F(HostileModel, ThatIncludesItself) {
  EXPECT_EQ(refusal("<mujoco>\n<include file=\"m.xml\"/></mujoco>"),
            "m.xml:2: <include file=\"m.xml\">: the file includes itself");
  files_.write("other.xml", "<mujoco><include file=\"m.xml\"/></mujoco>");
  EXPECT_EQ(refusal("<mujoco><include file=\"other.xml\"/></mujoco>"),
            "other.xml:1: <include file=\"m.xml\">: the file includes itself");
}

TEST_F(HostileModel, ThatIncludesTooMuch) {
  files_.write("part.xml", "<mujoco/>");
  EXPECT_EQ(refusal("<mujoco>" + repeated("<include file=\"part.xml\"/>", 33) + "</mujoco>"),
            "m.xml:1: more than 32 includes");
}

TEST_F(HostileModel, ThatLooksOutsideItsFolder) {
  const std::string only =
      "only files in the model's folder, in its neighbours and in its repository are read";
  for (const char* name : {"../../etc/hostname", "/etc/passwd", "parts/../../../etc/hostname"})
    EXPECT_EQ(refusal(std::string("<mujoco><include file=\"") + name + "\"/></mujoco>"),
              std::string("m.xml:1: <include file=\"") + name + "\">: " + only);
  std::filesystem::create_symlink("/etc/hostname", files_.path("link.xml"));
  EXPECT_EQ(refusal("<mujoco><include file=\"link.xml\"/></mujoco>"),
            "m.xml:1: <include file=\"link.xml\">: " + only);
  EXPECT_EQ(refusal("<mujoco><include file=\"gone.xml\"/></mujoco>"),
            "m.xml:1: <include file=\"gone.xml\">: there is no such file");
}

TEST_F(HostileModel, WithEntities) {
  EXPECT_EQ(
      refusal("<?xml version=\"1.0\"?>\n<!DOCTYPE m [<!ENTITY a \"aaaa\">]>\n<mujoco>&a;</mujoco>"),
      "m.xml:2: document types with entities (<!DOCTYPE … [<!ENTITY …>]>) are refused: write what they stand "
      "for in their place");
}

TEST_F(HostileModel, ThatIsTooLarge) {
  EXPECT_NE(refusal(std::string(50'000'001, ' ')).find("m.xml: "), std::string::npos);
}

TEST_F(HostileModel, AsUrdf) {
  EXPECT_EQ(
      refusal("<robot name=\"r\">\n" + repeated("<link name=\"a\"/>\n", 1'000'000) + "</robot>", "r.urdf"),
      "r.urdf:1002: too large a model: more than 1000 bodies");
}

TEST_F(HostileModel, MayHaveThirtyTwoIncludes) {
  files_.write("part.xml", "<mujoco/>");
  EXPECT_EQ(refusal("<mujoco>" + repeated("<include file=\"part.xml\"/>", 32) + "</mujoco>").find("includes"),
            std::string::npos);
  EXPECT_EQ(refusal("<mujoco>\n<include/></mujoco>"), "m.xml:2: <include> names no file");
}

TEST_F(HostileModel, WithNumbersThatAreNone) {
  EXPECT_EQ(refusal("<mujoco><worldbody>\n<body name=\"nan\"><joint range=\"nan 1\"/><geom "
                    "size=\"1\"/></body></worldbody></mujoco>"),
            "m.xml:2: <joint> has range = 'nan 1': expected numbers");
  EXPECT_EQ(
      refusal(
          "<robot name=\"r\">\n<link name=\"nan\"><inertial><mass value=\"NaN\"/></inertial></link></robot>",
          "m.urdf"),
      "m.urdf:2: <mass> has value = 'NaN': expected numbers");
}

TEST_F(HostileModel, WithAJointOfATypeThatNobodyKnows) {
  EXPECT_EQ(refusal("<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" "
                    "type=\"hinge\"><parent link=\"a\"/>"
                    "<child link=\"b\"/><dynamics damping=\"1\"/></joint></robot>",
                    "m.urdf"),
            "m.urdf:2: joint 'j' has the type 'hinge': expected one of revolute, continuous, prismatic, "
            "fixed, floating, planar");
}

TEST_F(HostileModel, WithBodiesThatWeighWithoutEnd) {
  const auto urdf = [&](const std::string& mass) {
    return refusal("<robot name=\"r\"><link name=\"a\">\n<inertial><mass value=\"" + mass +
                       "\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" "
                       "iyz=\"0\"/></inertial></link></robot>",
                   "r.urdf");
  };
  for (const char* mass : {"inf", "-Infinity", "1e999"})
    EXPECT_EQ(urdf(mass),
              "r.urdf:2: <mass> has value = '" + std::string(mass) + "': expected finite numbers");
  EXPECT_EQ(
      refusal("<mujoco><worldbody>\n<body><geom size=\"1\" pos=\"0 inf 0\"/></body></worldbody></mujoco>"),
      "m.xml:2: <geom> has pos = '0 inf 0': expected finite numbers");
  EXPECT_EQ(refusal("<mujoco><worldbody><body><joint range=\"-inf inf\"/><geom "
                    "size=\"1\"/></body></worldbody></mujoco>")
                .find("finite numbers"),
            std::string::npos)
      << "a limit may be none";
}

}  // namespace
}  // namespace amble::morphology
