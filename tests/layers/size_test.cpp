#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/layers/source_tree.hpp"

namespace amble::tests {
namespace {

// A file has about 400 lines at most; more where a whole is one thing.
constexpr std::size_t most_lines_per_file = 600, most_lines_per_function = 60;

/// The sources of the program and of the Python module.
std::vector<SourceFile> all_files() {
  auto files = source_files(), module = source_files("python");
  files.insert(files.end(), module.begin(), module.end());
  return files;
}

TEST(Size, FilesStayUnder600Lines) {
  for (const auto& file : all_files()) EXPECT_LE(file.lines.size(), most_lines_per_file) << file.path;
}

/// Whether a line opens a block that is not a function's: namespace, type, initialiser.
bool opens_other_block(const std::string& line) {
  for (const char* word : {"namespace", "class ", "struct ", "enum ", "extern \"C\""})
    if (line.starts_with(word)) return true;
  return line.find("= {") != std::string::npos || line.find("{{") != std::string::npos;
}

/// Lengths of the functions that are defined at the left margin, by clang-format's habit of closing them
/// there with "}".
TEST(Size, FunctionsStayUnder60Lines) {
  for (const auto& file : all_files()) {
    std::optional<std::size_t> start;
    for (std::size_t i = 0; i < file.lines.size(); ++i) {
      const auto& line = file.lines[i];
      const bool at_margin =
          !line.empty() && line[0] != ' ' && line[0] != '}' && line[0] != '#' && line[0] != '/';
      if (!start && at_margin && !opens_other_block(line) && !line.ends_with(";")) start = i;
      if (start && at_margin && line.ends_with(";")) start.reset();
      if (start && line.starts_with("}")) {
        EXPECT_LE(i - *start + 1, most_lines_per_function) << file.path << ":" << *start + 1;
        start.reset();
      }
    }
  }
}

}  // namespace
}  // namespace amble::tests
