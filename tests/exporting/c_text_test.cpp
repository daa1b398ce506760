#include "amble/exporting/c_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "amble/exporting/c_neural_text.hpp"
#include "amble/io/file.hpp"
#include "tests/exporting/compiled.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::exporting {
namespace {

TEST(CText, MakesIdentifiers) {
  EXPECT_EQ(c_identifier("FL_knee"), "FL_knee");
  EXPECT_EQ(c_identifier("left knee-2"), "left_knee_2");
  EXPECT_EQ(c_identifier("2legs"), "amble_2legs");
  EXPECT_EQ(c_identifier("_x"), "amble__x");
  EXPECT_EQ(c_identifier(""), "amble_");
  EXPECT_EQ(c_identifier("a\xc3"), "a_") << "half a character";
}

TEST(CText, KeepsTheLettersOfNamesThatAreNotAscii) {
  EXPECT_EQ(c_identifier("ä_ö_ü_ß"), "ae_oe_ue_ss");
  EXPECT_EQ(c_identifier("a\u0308_e\u0301"), "ae_e") << "marks of their own";
  EXPECT_EQ(c_identifier("Éléphant Žižka å ő"), "Elephant_Zizka_aa_o");
  EXPECT_EQ(c_identifier("ſ×À"), "s_A") << "the ends of the table";
  EXPECT_EQ(c_identifier("左_knee"), "u5DE6_knee");
  EXPECT_NE(c_identifier("лев"), c_identifier("пра"));
  EXPECT_EQ(c_identifier("a–b"), "a_b") << "a dash is no letter";
  EXPECT_EQ(in_comment("ü_knee, 右: ²"), "ue_knee, u53F3: ?");
  EXPECT_EQ(c_string("ü"), "\"ue\"");
  // Enumerators are made of these.
  UniqueNames names;
  EXPECT_EQ(names.of(upper_case("ä")), "AE");
  EXPECT_EQ(names.of(upper_case("Ä")), "AE_2");
}

TEST(CText, TellsNamesApart) {
  UniqueNames names;
  EXPECT_EQ(names.of("a b"), "a_b");
  EXPECT_EQ(names.of("a-b"), "a_b_2");
  EXPECT_EQ(names.of("a_b_2"), "a_b_2_2");
}

TEST(CText, LetsNothingEndAComment) {
  EXPECT_EQ(in_comment("a*/b/*c"), "a* /b/ *c");
  EXPECT_EQ(in_comment("*//**/"), "* // ** /");
  EXPECT_EQ(in_comment("?\?/"), "? ?/");
  EXPECT_EQ(in_comment("a\nb\xc3"), "a?b?");
}

TEST(CText, WritesFloatsThatReadBackToTheSameBits) {
  for (const float value :
       {0.0f, -0.0f, 1.0f, 0.1f, 1e-45f, 1.17549435e-38f, 3.4028235e38f, 16777216.0f, -1e10f}) {
    const std::string text = c_float(value);
    ASSERT_TRUE(text.ends_with("f") && text.find_first_of(".e") != std::string::npos) << text;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(std::strtof(text.c_str(), nullptr)),
              std::bit_cast<std::uint32_t>(value))
        << text;
  }
  EXPECT_EQ(c_double(-0.8), "-0.8");
  EXPECT_EQ(c_double(3.0), "3.0");
}

TEST(CText, QuotesStrings) {
  EXPECT_EQ(c_string("FL_knee"), R"("FL_knee")");
  EXPECT_EQ(c_string("a\"b\\c\n"), R"("a\"b\\c?")");
}

TEST(CText, FillsInPrefixes) {
  EXPECT_EQ(with_prefix("$p_init($P_LEGS) $", "walker"), "walker_init(WALKER_LEGS) $");
}

TEST(CText, BreaksArraysIntoLines) {
  CText text("p");
  text.array("int a[60]", std::vector<std::string>(60, "12345"));
  text.array("int none[1]", std::vector<std::string>());
  const std::string all = text.take();
  EXPECT_TRUE(all.ends_with("int none[1] = {\n  0\n};\n")) << all;
  for (std::size_t from = 0, to = 0; (to = all.find('\n', from)) != std::string::npos; from = to + 1)
    EXPECT_LE(to - from, 100u);
}

constexpr std::string_view fused_main = R"(
#include <math.h>
#include <stdio.h>

static uint64_t next(void) {
  static uint64_t x = 88172645463325252u;
  x ^= x << 13, x ^= x >> 7, x ^= x << 17;
  return x;
}

/* A finite float: any, or of some exponents near those of others, so that digits meet and cancel. */
static float draw(int kind) {
  float_bits f;
  const uint32_t bits = (uint32_t)(next() >> 32);
  f.bits = bits;
  if (kind == 1) f.bits = (bits & 0x80ffffffu) | 0x3f000000u;
  if (kind == 2) f.bits = bits & 0x80ffffffu;
  if (kind == 3) f.bits = (bits & 0xfff80000u);
  if ((f.bits & 0x7f800000u) == 0x7f800000u) f.bits ^= 0x40000000u;
  return f.number;
}

int main(void) {
  long i, wrong = 0;
  for (i = 0; i < 4000000; ++i) {
    const float a = draw((int)(next() & 3)), b = draw((int)(next() & 3));
    float c = draw((int)(next() & 3));
    float_bits got, want;
    /* Sums that cancel nearly or quite. */
    if ((next() & 7) == 0) c = -(a * b);
    if ((c != c) || c - c != 0.0f) continue;
    got.number = fused(a, b, c);
    want.number = fmaf(a, b, c);
    if (got.bits != want.bits && wrong++ < 5) printf("%a %a %a: %a, not %a\n", a, b, c, got.number, want.number);
  }
  printf("%ld wrong\n", wrong);
  return 0;
}
)";

TEST(CNeuralText, FusedMultiplyAddIsThatOfTheProcessor) {
  const test::TemporaryFolder scratch;
  io::write_file(scratch / "fused.c", "#include <stdint.h>\n" + std::string(c_rounding) +
                                          std::string(c_float_bits) + std::string(c_fused) +
                                          std::string(fused_main));
  const std::string program = (scratch / "fused").string();
  const auto built = tests::run_shell("gcc -std=c99 -O2 -o '" + program + "' '" + program + ".c' -lm");
  ASSERT_EQ(built.out, "");
  EXPECT_EQ(tests::run_shell("'" + program + "'").out, "0 wrong\n");
}

TEST(CText, TakesTheSmallestTypeThatHoldsANumber) {
  EXPECT_EQ(unsigned_type(0), "uint8_t");
  EXPECT_EQ(unsigned_type(255), "uint8_t");
  EXPECT_EQ(unsigned_type(256), "uint16_t");
  EXPECT_EQ(unsigned_type(65535), "uint16_t");
  EXPECT_EQ(unsigned_type(65536), "uint32_t");
}

}  // namespace
}  // namespace amble::exporting
