#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace amble::tests {

/// A champion of the gallery: the text of its file. It has four legs with three joints each, and has evolved
/// in the engine `batch`.
inline std::string champion_text(const std::string& file_name = "servo/champion.json") {
  std::ifstream file(std::string(AMBLE_SOURCE_DIR) + "/robots/" + file_name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// One that senses commands, with six legs.
inline std::string obeying_champion_text() {
  return champion_text("hexapod/steered.json");
}

}  // namespace amble::tests
