#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "amble/core/error.hpp"
#include "tests/cli/process.hpp"

namespace amble::tests {

inline const std::string source = AMBLE_SOURCE_DIR;
inline const std::string config = source + "/configs/authors/supg-objective.toml",
                         novelty_config = source + "/configs/authors/supg-novelty.toml";

/// Every file below a folder with its text.
inline std::map<std::string, std::string> snapshot(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    files[entry.path().string()] = entry.is_regular_file() ? slurp(entry.path()) : "";
  return files;
}

/// The data in a page of `amble view`, `repertoire` or `adapt`.
inline nlohmann::json page_data(const std::string& html) {
  const std::string mark = "id=\"amble-data\">";
  const auto from = html.find(mark) + mark.size();
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

class BadInput : public testing::Test {
 protected:
  /// One line on stderr that holds `words`, the exit code, and no file touched.
  void expect_refusal(const std::vector<std::string>& arguments, ExitCode code, const std::string& words) {
    const auto before = snapshot(scratch_.path());
    const auto finished = amble(arguments);
    EXPECT_EQ(finished.exit_code, static_cast<int>(code)) << finished.err;
    EXPECT_THAT(finished.err, testing::StartsWith("amble: "));
    EXPECT_THAT(finished.err, testing::HasSubstr(words));
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    auto after = snapshot(scratch_.path());
    std::erase_if(after, [](const auto& file) { return file.first.ends_with("/.lock"); });
    auto expected = before;
    std::erase_if(expected, [](const auto& file) { return file.first.ends_with("/.lock"); });
    EXPECT_EQ(after, expected);
  }

  /// A config of its own: that of the authors with more lines at its end.
  std::string config_with(const std::string& lines) {
    spill(scratch_ / "c.toml", "include = [\"" + config + "\"]\n" + lines + "\n");
    return scratch_ / "c.toml";
  }

  /// A finished run of two generations.
  void make_run(const std::string& from = config) {
    const auto run = amble({"evolve", from, "--set", "population.size=40", "--set", "trial.duration_s=1",
                            "--generations", "2", "--out", run_});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }

  TemporaryFolder scratch_;
  std::string out_ = scratch_ / "out";
  std::string run_ = scratch_ / "run";
};

}  // namespace amble::tests
