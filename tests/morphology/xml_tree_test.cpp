#include "amble/morphology/xml_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "amble/core/error.hpp"
#include "amble/core/random.hpp"

namespace amble::morphology {
namespace {

/// The line of the refusal, or "accepted".
std::string refusal(const std::string& text) {
  try {
    parse_xml(text, "f");
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

XmlElement random_element(Stream& stream, int depth) {
  XmlElement element{.name = "e" + std::to_string(stream.below(9))};
  for (std::uint32_t a = stream.below(4); a-- > 0;)
    element.attributes.emplace_back("a" + std::to_string(a), stream.chance(0.5) ? "it's > 1" : "\"2\" / =");
  for (std::uint32_t c = depth > 0 ? stream.below(4) : 0; c-- > 0;)
    element.children.push_back(random_element(stream, depth - 1));
  return element;
}

bool same(const XmlElement& a, const XmlElement& b) {
  return a.name == b.name && a.attributes == b.attributes &&
         std::ranges::equal(a.children, b.children, [](const auto& x, const auto& y) { return same(x, y); });
}

/// `text` with what stands between tags put before every element.
std::string with_between(const std::string& text, const std::string& between) {
  std::string result;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool starts_element = text[at] == '\n' && at + 1 < text.size() && text[at + 1] == '<';
    result += starts_element ? "\n" + between : std::string(1, text[at]);
  }
  return result;
}

TEST(XmlTree, IsReadBackAsItIsWrittenWhateverIsBetweenItsTags) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    Stream stream(1, Purpose::test, i);
    XmlElement tree = random_element(stream, 4);
    const XmlText written = write_xml(tree);
    ASSERT_TRUE(same(parse_xml(written.text, "f"), tree)) << written.text;
    for (const char* between :
         {"<!-- <a> -> -- > -->", "<![CDATA[ > <b> ]> ]] > </b> ]]>", "<? <c> ?>", "words > "})
      ASSERT_TRUE(same(parse_xml(with_between(written.text, between), "f"), tree)) << written.text << between;
    for (std::size_t line = 0; line < written.lines.size(); ++line) ASSERT_NE(written.lines[line], nullptr);
  }
}

TEST(XmlTree, KnowsTheLineOfEveryElement) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    Stream stream(2, Purpose::test, i);
    XmlElement tree = random_element(stream, 4);
    const std::string text = write_xml(tree).text;
    XmlElement read = parse_xml(text, "f");
    const XmlText again = write_xml(read);
    for (std::size_t line = 0; line < again.lines.size(); ++line)
      ASSERT_EQ(again.lines[line]->line, static_cast<int>(line) + 1) << text;
  }
}

TEST(XmlTree, OfWhichAnyEndIsCutOffIsRefused) {
  const std::string text = "<?xml?><!-- c --><a b=\"1\" c='2'>words<![CDATA[x]]><d/><e f=\"\"> <g/></e></a>";
  ASSERT_EQ(refusal(text), "accepted");
  for (std::size_t size = 0; size < text.size(); ++size)
    EXPECT_NE(refusal(text.substr(0, size)), "accepted") << text.substr(0, size);
}

TEST(XmlTree, HoldsNothingOutsideOfOneRoot) {
  for (const char* text : {"words<a/>", "<a/>words", "<a></a>words", "<a><b></b></a> words", "<a/><b/>",
                           "<a></a><b></b>", "<a></a></a>", ""})
    EXPECT_NE(refusal(text), "accepted") << text;
  for (const char* text : {" <a/> ", "<a></a>\n", "<!-- 1 --><a><b></b></a><!-- 2 -->\n"})
    EXPECT_EQ(refusal(text), "accepted") << text;
}

TEST(XmlTree, HasANameForEveryElementAndAttribute) {
  for (const char* text : {"</>", "< a/>", "<></>", "<a =\"1\"/>", "<a><=/></a>", "<a b=1/>", "<a b/>",
                           "<a b=\"<\"/>", "<a b=\"1\" b=\"2\"/>", "<a></b>", "<a></ab>"})
    EXPECT_NE(refusal(text), "accepted") << text;
}

TEST(XmlTree, HoldsAsMuchAsItsLimitsAndNoMore) {
  const auto refused = [](const std::string& text, const XmlLimits& limits) -> std::string {
    try {
      parse_xml(text, "f", limits);
    } catch (const UserError& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string tree = "<a><b><c/></b><body/><link/></a>";
  EXPECT_EQ(refused(tree, {.elements = 5, .depth = 3, .bodies = 2}), "accepted");
  EXPECT_EQ(refused(tree, {.elements = 4, .depth = 3, .bodies = 2}),
            "f:1: too large a model: more than 4 elements");
  EXPECT_EQ(refused(tree, {.elements = 5, .depth = 2, .bodies = 2}),
            "f:1: too large a model: elements within each other 3 deep");
  EXPECT_EQ(refused(tree, {.elements = 5, .depth = 3, .bodies = 1}),
            "f:1: too large a model: more than 1 bodies");
  const XmlLimits standard;
  EXPECT_EQ(standard.elements, 200'000u);
  EXPECT_EQ(standard.depth, 256u);
  EXPECT_EQ(standard.bodies, 1000u);
}

TEST(XmlTree, HasValuesAsTheyAreMeantAndWritesThemSoThatTheyAreReadBack) {
  const std::string text =
      R"(<a b="fl&amp;hip" c='"x"' d="&lt;&#10;&#x41;&quot;&apos;" e="two
lines" f="&unknown; &" g="&#0;&#xD800;&#99999999999;" h="&#65" i="&#65&#66;"/>)";
  XmlElement tree = parse_xml(text, "f");
  EXPECT_EQ(tree.attribute("b"), "fl&hip");
  EXPECT_EQ(tree.attribute("c"), "\"x\"");
  EXPECT_EQ(tree.attribute("d"), "<\nA\"'");
  EXPECT_EQ(tree.attribute("e"), "two lines");
  EXPECT_EQ(tree.attribute("f"), "&unknown; &");
  EXPECT_EQ(tree.attribute("g"), "\uFFFD\uFFFD&#99999999999;");
  EXPECT_EQ(tree.attribute("h"), "&#65") << "without an end it is no entity";
  EXPECT_EQ(tree.attribute("i"), "&#65B");
  const XmlText written = write_xml(tree);
  EXPECT_EQ(written.text.find('\n'), written.text.size() - 1) << "an element is a line";
  EXPECT_TRUE(same(parse_xml(written.text, "f"), tree)) << written.text;
}

TEST(XmlTree, PassesOverADocumentTypeUnlessItDefinesSomething) {
  for (const char* type : {"<!DOCTYPE robot>", "<?xml version='1.0'?>\n<!DOCTYPE robot SYSTEM \"a>b.dtd\">\n",
                           "<!-- --><!DOCTYPE robot PUBLIC '-//x' 'y'>"})
    EXPECT_EQ(refusal(type + std::string("<robot/>")), "accepted") << type;
  EXPECT_EQ(
      refusal("\n<!DOCTYPE robot [<!ENTITY m \"2\">]><robot a='&m;'/>"),
      "f:2: document types with entities (<!DOCTYPE … [<!ENTITY …>]>) are refused: write what they stand "
      "for in their place");
  for (const char* text : {"<!DOCTYPE robot", "<robot/><!DOCTYPE robot>", "<robot><!DOCTYPE robot></robot>",
                           "<!ENTITY a \"a\"><robot/>"})
    EXPECT_NE(refusal(text), "accepted") << text;
}

}  // namespace
}  // namespace amble::morphology
