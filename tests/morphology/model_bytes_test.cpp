#include "amble/morphology/model_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "amble/morphology/model_file.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using namespace std::string_literals;

std::string utf16(const std::string& text, bool low_first, bool mark) {
  std::string bytes = mark ? (low_first ? "\xFF\xFE"s : "\xFE\xFF"s) : ""s;
  for (const char c : text) bytes += low_first ? std::string{c, '\0'} : std::string{'\0', c};
  return bytes;
}

TEST(AsUtf8, KnowsUtf16OfBothOrdersWithAndWithoutAMark) {
  for (const bool low_first : {true, false})
    for (const bool mark : {true, false})
      EXPECT_EQ(as_utf8(utf16("<a b='c'/>", low_first, mark)), "<a b='c'/>");
  EXPECT_EQ(as_utf8("\xFF\xFE<\0\xE4\0=\xD8\x00\xDE>\0"s), "<ä😀>");
  EXPECT_EQ(as_utf8("\xFF\xFE<\0\x00\xDE>\0"s), "<\xEF\xBF\xBD>") << "half a pair";
}

TEST(AsUtf8, KnowsUtf32OfBothOrdersWithAndWithoutAMark) {
  const std::string low = "<\0\0\0\xE4\0\0\0\x00\xF6\x01\0>\0\0\0"s,
                    high = "\0\0\0<\0\0\0\xE4\0\x01\xF6\x00\0\0\0>"s;
  EXPECT_EQ(as_utf8(low), "<ä😀>");
  EXPECT_EQ(as_utf8(high), "<ä😀>");
  EXPECT_EQ(as_utf8("\xFF\xFE\0\0"s + low), "<ä😀>");
  EXPECT_EQ(as_utf8("\0\0\xFE\xFF"s + high), "<ä😀>");
}

TEST(AsUtf8, DropsItsMarkAndTakesWhatIsNoUtf8ForLatin1) {
  EXPECT_EQ(as_utf8("\xEF\xBB\xBF<a/>"), "<a/>");
  EXPECT_EQ(as_utf8("<ä/>"), "<ä/>");
  EXPECT_EQ(as_utf8("<\xE4/>"), "<ä/>");
  EXPECT_EQ(as_utf8(""), "");
}

/// What each small model says of itself, read in each of these ways.
TEST(ModelText, IsTheSameRobotHoweverItIsWritten) {
  const Files files;
  for (const tests::SmallModel& small : tests::small_models()) {
    const std::string name = "m." + small.extension;
    const ModelFile plain = compile_model(files.write(name, small.text));
    const std::string contents[] = {utf16(small.text, true, true),
                                    utf16(small.text, false, true),
                                    utf16(small.text, true, false),
                                    "\xEF\xBB\xBF" + small.text,
                                    small.text + "\0\0"s,
                                    small.text + "\n\x1A",
                                    "\n" + small.text};
    for (const std::string& text : contents) {
      if (text[0] == '\n' && small.text.starts_with("<?xml")) continue;
      const ModelFile file = compile_model(files.write(name, text));
      EXPECT_EQ(file.notes.text(), plain.notes.text()) << small.name;
      EXPECT_EQ(file.motors.size(), plain.motors.size());
    }
    EXPECT_THAT(compile_model(files.write(name, small.text + "end of the file\n")).notes.text(),
                testing::HasSubstr("left out  text behind the last element of " + name));
  }
}

TEST(ModelText, ThatIsNoModelIsToldWithWhatToDo) {
  const Files files;
  const auto error_of = [&](const std::string& text) {
    return files.error_of([&] { compile_model(files.write("m.xml", text)); });
  };
  EXPECT_EQ(error_of("\n<!DOCTYPE html>\n<html></html>"),
            "m.xml: a web page, not a model: fetch the file itself (\"raw\")");
  EXPECT_EQ(error_of("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"),
            "m.xml: a pointer of Git LFS in place of the file: run git lfs pull");
  for (const char* name : {"m.sdf", "m.xml", "m.urdf", "my world.sdf"}) {
    const std::string line = files.error_of([&] {
      compile_model(files.write(name, R"(<?xml version="1.0"?><sdf version="1.7"><model name="q"/></sdf>)"));
    });
    EXPECT_THAT(line, testing::HasSubstr(
                          "an SDF file, Gazebo's; amble reads MJCF and URDF; convert it first: sdf2mjcf "));
  }
}

TEST(ModelText, ThatIsCompressedIsToldWithWhatUnpacksIt) {
  const Files files;
  const auto error_of = [&](const std::string& name, const std::string& bytes) {
    return files.error_of([&] { compile_model(files.write(name, bytes)); });
  };
  EXPECT_EQ(error_of("m.xml.gz", "\x1F\x8B\x08\0"s),
            "m.xml.gz: it is compressed (gzip): unpack it first: gunzip m.xml.gz");
  EXPECT_EQ(error_of("r.urdf", "\x1F\x8B\x08\0"s),
            "r.urdf: it is compressed (gzip): unpack it first: gunzip < r.urdf > r_unpacked.urdf");
  EXPECT_EQ(error_of("r.urdf.bz2", "BZh91AY"),
            "r.urdf.bz2: it is compressed (bzip2): unpack it first: bunzip2 r.urdf.bz2");
  EXPECT_EQ(error_of("r.xz", "\xFD"s + "7zXZ\0"s), "r.xz: it is compressed (xz): unpack it first: unxz r.xz");
  EXPECT_EQ(error_of("my robot.zst", "\x28\xB5\x2F\xFD"),
            "my robot.zst: it is compressed (zstd): unpack it first: unzstd 'my robot.zst'");
  EXPECT_EQ(error_of("r.urdf", "PK\x03\x04"),
            "r.urdf: it is compressed (zip): unpack it first: unzip r.urdf");
}

TEST(ModelText, IsNeverTheFileThatAPrintedCommandWrites) {
  const Files files;
  const std::string sdf = R"(<sdf version="1.7"/>)";
  const auto hint = [&](const std::string& name, const std::string& text) {
    const std::string line = files.error_of([&] { compile_model(files.write(name, text)); });
    return line.substr(line.find("first: ") + 7);
  };
  EXPECT_THAT(hint("m.sdf", sdf), testing::StartsWith("sdf2mjcf m.sdf m.xml (of"));
  EXPECT_THAT(hint("m.xml", sdf), testing::StartsWith("sdf2mjcf m.xml m_mjcf.xml (of"));
  EXPECT_THAT(hint("m.sdf", sdf), testing::StartsWith("sdf2mjcf m.sdf m_2.xml (of")) << "m.xml is there now";
  const std::string macros = R"(<robot name="r"><link name="${a}"/></robot>)";
  EXPECT_EQ(hint("r.urdf.xacro", macros), "xacro r.urdf.xacro > r.urdf");
  EXPECT_EQ(hint("r.urdf", macros), "xacro r.urdf > r_expanded.urdf");
  EXPECT_EQ(hint("r.xacro", macros), "xacro r.xacro > r_2.urdf");
}

TEST(ModelText, IsOfTheFormatThatItsFirstElementSays) {
  const Files files;
  EXPECT_TRUE(compile_model(files.write("r.xml", tests::urdf_with_effort())).root_is_welded);
  EXPECT_FALSE(compile_model(files.write("m.urdf", one_leg_xml)).root_is_welded);
}

TEST(ModelText, OfAUrdfWithAnIncludeOfWhateverKindIsRefused) {
  const Files files;
  for (const char* include : {R"(<include filename="legs.urdf"/>)", R"(<xi:include href="legs.urdf"/>)"})
    EXPECT_THAT(files.error_of([&] {
      compile_model(
          files.write("r.urdf", with(tests::urdf_with_effort(), "<link ", include + std::string("<link "))));
    }),
                testing::HasSubstr("an include, which URDF does not have"))
        << include;
}

}  // namespace
}  // namespace amble::morphology
