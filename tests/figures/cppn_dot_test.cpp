#include "amble/figures/cppn_dot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/figures/cppn_samples.hpp"

namespace amble::figures {
namespace {

using testing::HasSubstr;

TEST(CppnDot, HasALineForEachNodeAndEachLink) {
  EXPECT_EQ(cppn_dot(tests::cppn()),
            "digraph cppn {\n"
            "  rankdir=LR;\n"
            "  node [fontname=\"sans-serif\", fontsize=11];\n"
            "  n0 [label=\"bias\", shape=plaintext];\n"
            "  n1 [label=\"leg\", shape=plaintext];\n"
            "  n2 [label=\"time\", shape=plaintext];\n"
            "  n3 [label=\"pattern\\nsine\", shape=ellipse];\n"
            "  n4 [label=\"offset\\nbipolar_sigmoid\", shape=ellipse];\n"
            "  n9 [label=\"gaussian\", shape=ellipse];\n"
            "  n12 [label=\"bipolar_sigmoid\", shape=ellipse];\n"
            "  { rank=source; n0; n1; n2; }\n"
            "  { rank=sink; n3; n4; }\n"
            "  n0 -> n9 [penwidth=2.53, color=\"#00796b\", style=solid, tooltip=\"1\"];\n"
            "  n2 -> n9 [penwidth=3.4, color=\"#c2410c\", style=solid, tooltip=\"-1.5\"];\n"
            "  n9 -> n12 [penwidth=1.67, color=\"#00796b\", style=solid, tooltip=\"0.5\"];\n"
            "  n12 -> n3 [penwidth=6, color=\"#00796b\", style=solid, tooltip=\"3\"];\n"
            "  n1 -> n4 [penwidth=2.1, color=\"#00796b\", style=dashed, tooltip=\"0.75\"];\n"
            "}\n");
}

TEST(CppnDot, LetsNoNameEndItsString) {
  auto graph = tests::cppn();
  graph.nodes[1].name = "a \"leg\" \\";
  EXPECT_THAT(cppn_dot(graph), HasSubstr("n1 [label=\"a \\\"leg\\\" \\\\\", shape=plaintext];\n"));
}

}  // namespace
}  // namespace amble::figures
