#include "amble/morphology/reading_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"

namespace amble::morphology {

void ReadingNotes::add(Reading reading, std::string text, bool is_doubt) {
  text = io::printable(text);  // names may have characters that break a line
  const auto same = [&](const Line& line) { return line.reading == reading && line.text == text; };
  if (std::ranges::none_of(lines_, same)) lines_.push_back({reading, std::move(text), is_doubt});
}

void ReadingNotes::add(const ReadingNotes& others) {
  for (const Line& line : others.lines_) add(line.reading, line.text, line.is_doubt);
}

std::string ReadingNotes::text() const {
  static constexpr std::array<std::string_view, 3> titles{"kept", "replaced", "left out"};
  std::string text;
  for (const Reading reading : {Reading::kept, Reading::replaced, Reading::left_out})
    for (const Line& line : lines_)
      if (line.reading == reading) text += fmt::format("  {:<9} {}\n", titles[to_index(reading)], line.text);
  return text;
}

}  // namespace amble::morphology
