#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "amble/experiment/config.hpp"
#include "tests/io/temporary_folder.hpp"

namespace amble::watch {

/// The files of a run that pages are told of, without the run.
class FakeRun {
 public:
  FakeRun(const std::filesystem::path& folder, int generations) : folder_(folder) {
    std::filesystem::create_directories(folder / "champions");
    std::ofstream(folder / "robot.json") << "{}";
    table("generation,best,mean,median,best_so_far,typical,species,wall_s\n");
    lengthen(generations);
  }

  void lengthen(int generations) const {
    experiment::Config config =
        experiment::load_config(AMBLE_SOURCE_DIR "/configs/quick/quadruped.toml",
                                {.assignments = {}, .seed = 7, .generations = generations});
    config.name = "fake";
    std::ofstream(folder_ / "config.toml") << config.to_toml();
  }
  /// A generation whose best is `best`, after two seconds.
  void grow(double best, int species = 3) {
    const std::string number = std::to_string(done_++), value = std::to_string(best);
    table(number + "," + value + ",0.1,0.2," + value + ",0.5," + std::to_string(species) + ",2\n");
  }
  void champion(int generation, const std::string& text) const {
    char name[16];
    std::snprintf(name, sizeof(name), "%05d.json", generation);
    std::ofstream(folder_ / "champions" / name) << text;
  }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void table(const std::string& line) const {
    std::ofstream(folder_ / "generations.csv", std::ios::app) << line;
  }

  std::filesystem::path folder_;
  int done_ = 0;
};

}  // namespace amble::watch
