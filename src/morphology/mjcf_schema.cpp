#include "amble/morphology/mjcf_schema.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <sstream>

#include "amble/core/index.hpp"
#include "amble/io/text.hpp"

namespace amble::morphology {
namespace {

/// As MuJoCo prints it: a line "NAME (how often) ATTRIBUTE …" for each element, and more lines of attributes.
std::string schema() {
  std::string text(1 << 16, '\0');
  const int size = mj_printSchema(nullptr, text.data(), static_cast<int>(text.size()), 0, 0);
  text.resize(to_index(std::clamp(size, 0, static_cast<int>(text.size()))));
  return text;
}

}  // namespace

std::vector<std::string> known_attributes(const std::string& element) {
  std::istringstream lines(schema());
  std::vector<std::string> attributes;
  bool wanted = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream rest(line);
    std::vector<std::string> words;
    for (std::string word; rest >> word;) words.push_back(word);
    std::size_t first = 0;
    if (words.size() >= 2 && words[1].starts_with('(')) {
      wanted = words[0] == element;
      first = 2;
    }
    if (wanted)
      attributes.insert(attributes.end(), words.begin() + static_cast<std::ptrdiff_t>(first), words.end());
  }
  return attributes;
}

std::string misspelt_attribute(const std::string& element, const std::string& attribute) {
  constexpr std::size_t most_edits = 2;
  const std::vector<std::string> known = known_attributes(element);
  if (std::ranges::count(known, attribute) > 0) return "";
  const std::string meant = io::nearest_word(attribute, known);
  return !meant.empty() && io::edit_distance(attribute, meant) <= most_edits ? meant : "";
}

}  // namespace amble::morphology
