#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/process.hpp"

namespace amble::tests {

namespace fs = std::filesystem;

/// A study of two conditions and three seeds that takes a second or two.
inline const std::string study_toml = R"(name = "tiny"
seeds = [1, 2, 3]
generations = 4
settings = ["engine=batch", "population.size=30", "speciation.target_min=3", "speciation.target_max=6", "trial.duration_s=2"]
[[conditions]]
name = "supg"
config = "SOURCE/configs/authors/supg-novelty.toml"
[[conditions]]
name = "sine"
config = "SOURCE/configs/authors/sine-objective.toml"
[[tests]]
name = "longer"
seconds = 6
[[tests]]
name = "noisy"
seconds = 2
noise = "SOURCE/configs/robust/supg-objective.toml"
episodes = 2
conditions = ["supg"]
)";

inline std::string replaced(std::string text, const std::string& old, const std::string& now) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += now.size())
    text.replace(at, old.size(), now);
  return text;
}

class Study : public testing::Test {
 protected:
  Study() { write(study_toml); }

  void write(const std::string& text) const {
    spill(folder_ / "study.toml", replaced(text, "SOURCE", AMBLE_SOURCE_DIR));
  }
  std::vector<std::string> command(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{"study", (folder_ / "study.toml").string(), "--out",
                                   (folder_ / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Finished study(const std::string& out, std::vector<std::string> more = {}) const {
    return amble(command(out, std::move(more)));
  }
  fs::path record(const std::string& out, const std::string& name) const {
    return folder_ / out / "ledger" / (name + ".json");
  }

  const TemporaryFolder folder_;
};

/// "…digest 0123456789abcdef" of what a study printed at its end.
inline std::string digest(const Finished& finished) {
  const auto at = finished.out.find("digest ");
  return at == std::string::npos ? "none: " + finished.out + finished.err : finished.out.substr(at + 7, 16);
}

/// Every file of a study's folder.
inline std::map<std::string, std::string> all_files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = slurp(entry.path());
  return files;
}

}  // namespace amble::tests
