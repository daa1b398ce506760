#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/layers/source_tree.hpp"

namespace amble::tests {
namespace {

using Allowed = std::map<std::string, std::set<std::string>>;

std::set<std::string> words(const std::string& text) {
  static const std::regex word("[a-z_/]+");
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), word), end; it != end; ++it) found.insert(it->str());
  return found;
}

struct Row {
  std::string folder;
  std::set<std::string> includes;
};

/// The table "folder | in → out | may include" of docs/ARCHITECTURE.md, from top to bottom.
std::vector<Row> table() {
  std::ifstream file(std::string(AMBLE_SOURCE_DIR) + "/docs/ARCHITECTURE.md");
  static const std::regex row(R"(\| `([a-z_/]+)` \|.*\| ([^|]*) \|)");
  std::vector<Row> rows;
  std::set<std::string> above;
  std::smatch match;
  for (std::string line; std::getline(file, line);) {
    if (!std::regex_match(line, match, row)) continue;
    rows.push_back({match[1], match[2].str().starts_with("all") ? above : words(match[2])});
    above.insert(match[1]);
  }
  return rows;
}

Allowed allowed_includes() {
  Allowed allowed;
  for (const Row& row : table()) {
    allowed[row.folder] = row.includes;
    allowed[row.folder].insert(row.folder);
  }
  return allowed;
}

/// The row of a file: "physics/batch/step.hpp" belongs to `physics/batch`, "physics/engine.hpp" to `physics`.
std::string row_of(const std::filesystem::path& below_root, const Allowed& rows) {
  auto part = below_root.begin();
  const std::string first = part->string();
  const std::string second = ++part == below_root.end() ? "" : first + "/" + part->string();
  return rows.contains(second) ? second : first;
}

std::string row_of(const SourceFile& file, const Allowed& rows) {
  return row_of(file.path.lexically_relative(std::string(AMBLE_SOURCE_DIR) + "/src"), rows);
}

TEST(Layers, EveryFolderIsListedInTheArchitectureTable) {
  const auto allowed = allowed_includes();
  ASSERT_GE(allowed.size(), 10u) << "the table was not found";
  for (const auto& file : source_files()) EXPECT_TRUE(allowed.contains(row_of(file, allowed))) << file.path;
}

TEST(Layers, AnEnginesFolderHasARowOfItsOwn) {
  const auto allowed = allowed_includes();
  for (const auto& file : source_files()) {
    if (file.folder != "physics" || file.path.parent_path().filename() == "physics") continue;
    EXPECT_NE(row_of(file, allowed), "physics") << file.path;
  }
}

TEST(Layers, NoFolderIncludesWhatItsRowDoesNotName) {
  static const std::regex include(R"(\s*#\s*include\s*["<]amble/([^">]+)[">].*)");
  const auto allowed = allowed_includes();
  for (const auto& file : source_files()) {
    std::smatch match;
    for (const auto& line : file.lines) {
      if (!std::regex_match(line, match, include)) continue;
      EXPECT_TRUE(allowed.at(row_of(file, allowed)).contains(row_of(match[1].str(), allowed)))
          << file.path << ": " << line;
    }
  }
}

TEST(Layers, ARowNamesOnlyRowsAboveIt) {
  std::set<std::string> above;
  for (const Row& row : table()) {
    for (const auto& folder : row.includes)
      EXPECT_TRUE(above.contains(folder)) << row.folder << ": " << folder;
    above.insert(row.folder);
  }
}

/// By header ("folder/name.hpp"): the headers of the program that it includes.
std::map<std::string, std::vector<std::string>> header_includes() {
  static const std::regex include(R"(\s*#\s*include\s*["<]amble/(.*)[">].*)");
  const std::filesystem::path root = std::filesystem::path(AMBLE_SOURCE_DIR) / "src";
  std::map<std::string, std::vector<std::string>> includes;
  std::smatch match;
  for (const auto& file : source_files())
    if (file.path.extension() == ".hpp")
      for (const auto& line : file.lines)
        if (std::regex_match(line, match, include))
          includes[file.path.lexically_relative(root).string()].push_back(match[1]);
  return includes;
}

TEST(Layers, NoHeaderIncludesItselfThroughOthers) {
  const auto includes = header_includes();
  ASSERT_GE(includes.size(), 50u);
  for (const auto& [start, direct] : includes) {
    std::set<std::string> reached;
    std::vector<std::string> left = direct;
    while (!left.empty()) {
      const std::string header = left.back();
      left.pop_back();
      if (!reached.insert(header).second) continue;
      if (const auto found = includes.find(header); found != includes.end())
        left.insert(left.end(), found->second.begin(), found->second.end());
    }
    EXPECT_FALSE(reached.contains(start)) << start;
  }
}

TEST(Layers, NothingInSrcIncludesThePythonModule) {
  ASSERT_FALSE(source_files("python").empty());
  for (const auto& file : source_files())
    for (const auto& line : file.lines)
      EXPECT_FALSE(line.starts_with("#include") && line.find("python/") != std::string::npos) << file.path;
}

struct Library {
  const char* header;
  std::vector<std::string> homes;  ///< path prefixes below src/
};

class OneDoor : public testing::TestWithParam<Library> {};

TEST_P(OneDoor, LeadsToTheLibrary) {
  const std::string header = GetParam().header, source = std::string(AMBLE_SOURCE_DIR) + "/src/";
  for (const auto& file : source_files()) {
    for (const auto& line : file.lines) {
      if (!line.starts_with("#include") || line.find(header) == std::string::npos) continue;
      const bool at_home = std::ranges::any_of(GetParam().homes, [&](const std::string& home) {
        return file.path.string().starts_with(source + home);
      });
      EXPECT_TRUE(at_home) << file.path << ": " << line;
    }
  }
}

std::string letters_of(const testing::TestParamInfo<Library>& library) {
  std::string letters;
  for (const char c : std::string(library.param.header))
    if (std::isalnum(static_cast<unsigned char>(c))) letters += c;
  return letters;
}

INSTANTIATE_TEST_SUITE_P(
    Layers, OneDoor,
    testing::Values(
        Library{"<ode/", {"physics/ode/"}}, Library{"<CLI/", {"cli/"}}, Library{"<httplib", {"serving/"}},
        Library{"<mujoco/", {"morphology/", "physics/mujoco/", "physics/mujoco_model/"}},
        Library{"<toml++/", {"io/"}}, Library{"<xxhash", {"core/"}}, Library{"<Random123/", {"core/"}},
        Library{"<hwy/",
                {"browser/fused_check.cpp", "controllers/", "core/simd-inl.hpp", "cppn/", "physics/batch/"}},
        Library{"<zlib", {"record/", "robot/deflate.cpp"}}, Library{"<cblas", {"search/"}},
        Library{"<boost/", {"statistics/"}}, Library{"<Eigen/", {"adaptation/"}}, Library{"<pybind11/", {}}),
    letters_of);

}  // namespace
}  // namespace amble::tests
