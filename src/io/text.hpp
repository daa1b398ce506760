#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace amble::io {

/// `text` with control characters written as \xNN, so that a message that quotes it stays one line.
std::string printable(std::string_view text);

/// The parts of a text between separators: one more than there are separators, so of an empty text one empty
/// part. They point into `text`.
std::vector<std::string_view> split(std::string_view text, char separator);

/// `text` without the blanks at its ends; it points into `text`.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

/// "a, b, c, d and 8 more": all of a list of up to six, else the first four, so that a warning stays
/// readable.
std::string first_few(std::span<const std::string> names);

/// Fewest single-character edits that turn one word into the other (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The most edits by which a word may differ from the one that was meant: a third of its characters.
inline std::size_t most_misspelt(std::string_view word) {
  return word.size() / 3;
}

/// The known word that the user may have meant, the first of the nearest; empty if none is near. A word that
/// begins as a longer one does, with three characters or more, means that.
std::string nearest_word(std::string_view word, std::span<const std::string> known);

/// " (did you mean 'evolve'?)", or nothing.
std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace amble::io
