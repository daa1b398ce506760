#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace amble::tests {

/// A C++ file.
struct SourceFile {
  std::filesystem::path path;
  std::string folder;  ///< first part below the root
  std::vector<std::string> lines;
};

/// All .hpp and .cpp files below a folder of the project, sorted by path.
std::vector<SourceFile> source_files(const std::string& root = "src");

}  // namespace amble::tests
