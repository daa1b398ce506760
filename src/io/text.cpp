#include "amble/io/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <numeric>
#include <vector>

namespace amble::io {

std::string printable(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string first_few(std::span<const std::string> names) {
  constexpr std::size_t all = 6, few = 4;
  if (names.size() <= all) return fmt::format("{}", fmt::join(names, ", "));
  return fmt::format("{} and {} more", fmt::join(names.first(few), ", "), names.size() - few);
}

namespace {

/// How many characters two words share at their beginning and at their end.
std::size_t common_ends(std::string_view a, std::string_view b) {
  const auto length = [](const auto& range, auto begin) {
    return static_cast<std::size_t>(range.in1 - begin);
  };
  return length(std::ranges::mismatch(a, b), a.begin()) +
         length(std::ranges::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend()), a.rbegin());
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

std::string nearest_word(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t least_beginning = 3;
  std::string best;
  // One edit is nothing unusual in a short word.
  std::size_t fewest = 1 + std::max<std::size_t>(most_misspelt(word), 1);
  for (const std::string& candidate : known) {
    const bool begun = word.size() >= least_beginning && candidate.starts_with(word);
    const std::size_t edits = begun ? 1 : edit_distance(word, candidate);
    const bool nearer = edits < fewest || (edits == fewest && !best.empty() &&
                                           common_ends(word, candidate) > common_ends(word, best));
    if (nearer && edits < candidate.size()) {
      fewest = edits;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  const std::string meant = nearest_word(word, known);
  return meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant);
}

}  // namespace amble::io
