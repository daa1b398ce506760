#include "tests/layers/source_tree.hpp"

#include <algorithm>
#include <fstream>

namespace amble::tests {

std::vector<SourceFile> source_files(const std::string& folder) {
  const std::filesystem::path root = std::filesystem::path(AMBLE_SOURCE_DIR) / folder;
  std::vector<SourceFile> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const auto extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp") continue;
    SourceFile file{entry.path(), entry.path().lexically_relative(root).begin()->string(), {}};
    std::ifstream stream(entry.path());
    for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
    files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

}  // namespace amble::tests
