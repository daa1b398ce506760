#include "amble/morphology/reading_notes.hpp"

#include <gtest/gtest.h>

namespace amble::morphology {
namespace {

TEST(ReadingNotes, HaveEachLineOncePerKindOfHandling) {
  ReadingNotes notes, others;
  for (int twice = 0; twice < 2; ++twice)
    for (const Reading reading : {Reading::left_out, Reading::replaced, Reading::kept})
      for (const char* text : {"a", "b"}) notes.add(reading, text);
  const std::string expected =
      "  kept      a\n  kept      b\n  replaced  a\n  replaced  b\n  left out  a\n  left out  b\n";
  EXPECT_EQ(notes.lines().size(), 6u);
  EXPECT_EQ(notes.text(), expected);
  others.add(Reading::kept, "b");
  others.add(notes);
  EXPECT_EQ(others.lines().size(), 6u);
  EXPECT_EQ(ReadingNotes().text(), "");
}

}  // namespace
}  // namespace amble::morphology
