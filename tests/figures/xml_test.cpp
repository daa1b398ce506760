#include "tests/figures/xml.hpp"

#include <gtest/gtest.h>

namespace amble::tests {
namespace {

TEST(XmlChecker, ReadsElementsAttributesAndText) {
  const auto elements = parse_xml("<a class=\"x y\"><b n=\"1.5\"/>\n<c>1 &lt; 2</c></a>");
  ASSERT_EQ(elements.size(), 3u);
  EXPECT_EQ(elements[1].number("n"), 1.5);
  EXPECT_EQ(elements[2].text, "1 < 2");
  EXPECT_EQ(with_class(elements, "y").size(), 1u);
}

TEST(XmlChecker, RefusesWhatIsNotWellFormed) {
  for (const char* text : {"<a>", "<a></b>", "<a><b></a></b>", "<a x=1/>", "<a x=\"1\" x=\"2\"/>", "<a>&</a>",
                           "<a>&nbsp;</a>", "<a/><b/>", "<a>1 < 2</a>", "text", "<a x=\"<\"/>"})
    EXPECT_THROW(parse_xml(text), std::runtime_error) << text;
}

}  // namespace
}  // namespace amble::tests
