#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace amble::tests {

/// A C++ file of src/.
struct SourceFile {
  std::filesystem::path path;
  std::string folder;  ///< first part below src/
  std::vector<std::string> lines;
};

/// All .hpp and .cpp files of src/, sorted by path.
std::vector<SourceFile> source_files();

}  // namespace amble::tests
