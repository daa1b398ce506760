#pragma once

#include <fstream>
#include <iterator>
#include <string>

namespace amble::tests {

/// A champion of the gallery: the text of its file. It has four legs with three joints each, and has evolved
/// in the engine `batch`.
inline std::string champion_text() {
  std::ifstream file(std::string(AMBLE_SOURCE_DIR) + "/robots/servo/champion.json", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace amble::tests
