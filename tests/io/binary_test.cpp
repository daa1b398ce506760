#include "amble/io/binary.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/io/expect_error.hpp"

namespace amble::io {
namespace {

using test::error_of;

enum class Colour : std::uint8_t { red, green };
enum class Signed : std::int8_t { zero, one };

TEST(Binary, ReadsBackWhatWasWritten) {
  BinaryWriter writer;
  writer.put(std::int8_t{-3});
  writer.put(std::numeric_limits<std::uint64_t>::max());
  writer.put(-0.0);
  writer.put(true);
  writer.put(Colour::green);
  writer.put_text(std::string("a\0b", 3));
  writer.put_span(std::span<const float>(std::vector<float>{1.5f, -2.0f}));
  writer.put_text("");
  writer.put_span(std::span<const double>());

  BinaryReader reader(writer.bytes(), "x");
  EXPECT_EQ(reader.get<std::int8_t>(), -3);
  EXPECT_EQ(reader.get<std::uint64_t>(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_TRUE(std::signbit(reader.get<double>()));
  EXPECT_TRUE(reader.get<bool>());
  EXPECT_EQ(reader.get_enum<Colour>(2), Colour::green);
  EXPECT_EQ(reader.get_text(), std::string("a\0b", 3));
  EXPECT_EQ(reader.get_vector<float>(), (std::vector<float>{1.5f, -2.0f}));
  EXPECT_EQ(reader.get_text(), "");
  EXPECT_EQ(reader.get_vector<double>(), std::vector<double>());
  reader.finish();
}

TEST(Binary, IsLittleEndianWithoutPadding) {
  BinaryWriter writer;
  writer.put(std::uint8_t{1});
  writer.put(std::uint32_t{0x04030201});
  writer.put_text("z");
  EXPECT_EQ(writer.bytes(), std::string("\1\1\2\3\4\1\0\0\0\0\0\0\0z", 14));
}

TEST(BinaryReader, NamesTheByteAtWhichDataEnds) {
  const std::string bytes(6, '\1');
  BinaryReader reader(bytes, "runs/1/checkpoint");
  reader.get<std::uint32_t>();
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { reader.get<std::uint32_t>(); }),
            "runs/1/checkpoint: truncated at byte 4");
}

TEST(BinaryReader, RefusesWhatIsLeftOver) {
  BinaryWriter writer;
  writer.put(1.0);
  writer.put(std::uint8_t{2});
  BinaryReader reader(writer.bytes(), "x");
  reader.get<double>();
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { reader.finish(); }), "x: more bytes than expected at byte 8");
  reader.get<std::uint8_t>();
  reader.finish();
}

TEST(BinaryReader, RefusesCountsThatTheBytesCannotHold) {
  for (const std::uint64_t count :
       {std::uint64_t{3}, std::uint64_t{1} << 61, std::numeric_limits<std::uint64_t>::max()}) {
    BinaryWriter writer;
    writer.put(count);
    writer.put(1.0);
    writer.put(2.0);
    BinaryReader reader(writer.bytes(), "x");
    EXPECT_EQ(error_of(ExitCode::bad_file, [&] { reader.get_vector<double>(); }), "x: truncated at byte 8")
        << count;
  }
}

TEST(BinaryReader, RefusesUnknownEnumValuesFlagsAndTrailingBytes) {
  const std::string bytes("\2\xff\2\0", 4);
  BinaryReader colours(bytes, "x");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { colours.get_enum<Colour>(2); }),
            "x: unknown enum value at byte 1");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { colours.get_enum<Signed>(2); }),
            "x: unknown enum value at byte 2");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { colours.get<bool>(); }), "x: not a flag at byte 3");
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { colours.finish(); }), "x: more bytes than expected at byte 3");
}

TEST(Seal, OpensAgain) {
  const std::string sealed = seal("AMBLETST", 7, "payload");
  EXPECT_EQ(sealed.size(), seal_header_size + 7);
  EXPECT_EQ(unseal("AMBLETST", 7, sealed, "x"), "payload");
  EXPECT_EQ(unseal("AMBLETST", 7, seal("AMBLETST", 7, ""), "x"), "");
}

TEST(Seal, DetectsEveryTruncation) {
  const std::string sealed = seal("AMBLETST", 7, "payload");
  for (std::size_t size = 0; size < sealed.size(); ++size) {
    const std::string message = error_of(ExitCode::bad_file, [&] {
      unseal("AMBLETST", 7, std::string_view(sealed).substr(0, size), "run/c");
    });
    const std::string expected =
        size < seal_header_size
            ? fmt::format("run/c: truncated: {} bytes are less than the header's 28", size)
            : fmt::format("run/c: truncated: {} of 35 bytes", size);
    EXPECT_EQ(message, expected);
  }
}

TEST(Seal, DetectsEveryFlippedBit) {
  const std::string sealed = seal("AMBLETST", 7, "payload");
  for (std::size_t at = 0; at < sealed.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string altered = sealed;
      altered[at] = static_cast<char>(altered[at] ^ (1 << bit));
      const std::string message = error_of(ExitCode::bad_file, [&] { unseal("AMBLETST", 7, altered, "c"); });
      if (at < 8) {
        EXPECT_EQ(message, "c: not a file of this kind: it does not begin with AMBLETST");
      } else if (at < 12) {
        const unsigned version = 7u ^ (1u << (8 * (at - 8) + static_cast<unsigned>(bit)));
        EXPECT_EQ(message,
                  fmt::format("c: version {} of the file format; this program reads version 7", version));
      } else if (at < 20) {
        const bool longer = (7u >> bit & 1u) == 0 || at > 12;
        EXPECT_TRUE(message.starts_with(longer ? "c: truncated: 35 of " : "c: altered: 35 bytes instead of "))
            << message;
      } else {
        EXPECT_EQ(message, "c: altered: its checksum does not fit");
      }
    }
  }
}

TEST(Seal, TellsBytesBehindTheEnd) {
  const std::string longer = seal("AMBLETST", 7, "payload") + "!";
  EXPECT_EQ(error_of(ExitCode::bad_file, [&] { unseal("AMBLETST", 7, longer, "c"); }),
            "c: altered: 36 bytes instead of 35");
}

TEST(BinaryReader, TakesListsThatFillTheBytesExactly) {
  for (const std::uint64_t count : {2u, 3u}) {
    BinaryWriter writer;
    writer.put(count);
    writer.put(std::uint64_t{7});
    writer.put(std::uint64_t{8});
    BinaryReader reader(writer.bytes(), "x");
    if (count == 2) {
      EXPECT_EQ(reader.get_vector<std::uint64_t>(), (std::vector<std::uint64_t>{7, 8}));
      reader.finish();
    } else {
      EXPECT_THROW(reader.get_vector<std::uint64_t>(), UserError);
    }
  }
}

}  // namespace
}  // namespace amble::io
