#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/layers/source_tree.hpp"

namespace amble::tests {
namespace {

/// The lines of a file of the project.
std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream file(std::string(AMBLE_SOURCE_DIR) + "/" + path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> public_headers() {
  return lines_of("cmake/public_headers.txt");
}

/// The headers of src by their path below it, with what they include: "<vector>", "core/error.hpp".
std::map<std::string, std::vector<std::string>> all_headers() {
  static const std::regex include(R"re(#include (?:"amble/([^"]+)"|(<[^>]+>)).*)re");
  std::map<std::string, std::vector<std::string>> headers;
  const auto root = std::filesystem::path(AMBLE_SOURCE_DIR) / "src";
  for (const SourceFile& file : source_files()) {
    if (file.path.extension() != ".hpp") continue;
    auto& includes = headers[file.path.lexically_relative(root).generic_string()];
    std::smatch match;
    for (const std::string& line : file.lines)
      if (std::regex_match(line, match, include)) includes.push_back(match[1].str() + match[2].str());
  }
  return headers;
}

/// A header and all that it includes, directly or by others.
void reach(const std::string& header, const std::map<std::string, std::vector<std::string>>& all,
           std::set<std::string>& reached) {
  if (!reached.insert(header).second) return;
  if (const auto found = all.find(header); found != all.end())
    for (const std::string& include : found->second) reach(include, all, reached);
}

TEST(PublicHeaders, AreThereAndListedOnce) {
  const auto listed = public_headers();
  const auto all = all_headers();
  EXPECT_GE(listed.size(), 30u);
  EXPECT_LE(listed.size(), 60u) << "a small surface; what is not needed from outside is not promised";
  EXPECT_EQ(std::set(listed.begin(), listed.end()).size(), listed.size());
  for (const std::string& header : listed) EXPECT_TRUE(all.contains(header)) << header;
}

TEST(PublicHeaders, BringNoLibraryOfJsonOrTomlAndNoEngineOfOthers) {
  const auto all = all_headers();
  for (const std::string& header : public_headers()) {
    std::set<std::string> reached;
    reach(header, all, reached);
    for (const std::string& include : reached)
      for (const char* library :
           {"<nlohmann", "<toml", "<mujoco", "<ode/", "<CLI", "<Eigen", "<boost", "<hwy"})
        EXPECT_FALSE(include.starts_with(library)) << header << " reaches " << include;
  }
}

TEST(PublicHeaders, BringFewOthers) {
  const auto all = all_headers();
  std::set<std::string> installed;
  for (const std::string& header : public_headers()) reach(header, all, installed);
  std::erase_if(installed, [](const std::string& name) { return name.starts_with("<"); });
  EXPECT_LE(installed.size(), public_headers().size() + 20);
}

TEST(PublicHeaders, AreThoseOfTheDocs) {
  static const std::regex row(R"(\| `([a-z_/]+)` \| ((`[a-z_]+`,? ?)+) \|.*)"), name("`([a-z_]+)`");
  std::set<std::string> in_docs;
  std::smatch match;
  for (const std::string& line : lines_of("docs/LIBRARY.md")) {
    if (!std::regex_match(line, match, row)) continue;
    const std::string folder = match[1], names = match[2];
    for (std::sregex_iterator it(names.begin(), names.end(), name), end; it != end; ++it)
      in_docs.insert(folder + "/" + (*it)[1].str() + ".hpp");
  }
  const auto listed = public_headers();
  EXPECT_EQ(in_docs, std::set(listed.begin(), listed.end()));
}

}  // namespace
}  // namespace amble::tests
