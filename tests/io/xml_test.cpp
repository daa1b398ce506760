#include "amble/io/xml.hpp"

#include <gtest/gtest.h>

namespace amble::io {
namespace {

TEST(EscapeXml, LeavesNoMarkup) {
  EXPECT_EQ(escape_xml("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
}

TEST(EscapeXml, ReplacesControlCharactersAndKeepsLines) {
  EXPECT_EQ(escape_xml("a\x01z\n\t"), "a\uFFFDz\n\t");
}

}  // namespace
}  // namespace amble::io
