#include <gtest/gtest.h>

#include "amble/io/json_file.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/summary.hpp"
#include "tests/figures/golden.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

/// All that is read from a robot's files and shown of it.
std::string reading_of(const std::filesystem::path& file) {
  ReadingNotes notes;
  const robot::RobotSpec robot = load_robot(file, &notes);
  return robot::summary(robot) + notes.text() + robot::to_json(robot).dump(1) + write_mjcf(robot).text;
}

TEST(GoldenGuess, OfEachSmallModelMatches) {
  const Files files;
  std::map<std::string, std::string> texts;
  for (const tests::SmallModel& model : tests::small_models()) {
    const std::string name = model.name + "." + model.extension;
    const RobotGuess guess = guess_robot(compile_model(files.write(name, model.text)), name);
    std::string text = guess.name + "\n" + guess.toml;
    for (const std::string& missing : guess.asked) text += "\nmissing: " + missing;
    texts[model.name + ".txt"] = text + "\n" + reading_of(files.write(model.name + ".toml", guess.toml));
  }
  tests::expect_golden(texts, {{"arm.txt", "da60dcd298b75d98"},
                               {"effort.txt", "a1428e8f6292585b"},
                               {"fixed_base.txt", "d441c34050578300"},
                               {"head.txt", "b0f211bb083376d8"},
                               {"keyframe.txt", "b49e97eebc4244fc"},
                               {"mesh_feet.txt", "5ad0b640e1a18943"},
                               {"newer_mujoco.txt", "83881bc1954d96b7"},
                               {"no_limits.txt", "ee9b3c8b2e10ac1e"},
                               {"planar_base.txt", "f6b73999e5b08012"},
                               {"three_hinges.txt", "9ea719f005735640"},
                               {"uneven_legs.txt", "a04cb31bcd6d1f7f"},
                               {"wide_ranges.txt", "fc5ad2d30f55d60f"}});
}

TEST(GoldenRobot, OfEachFileInTheRepositoryMatches) {
  std::map<std::string, std::string> texts;
  for (const char* name : {"quadruped/paper", "quadruped/authors", "hexapod/hexapod", "biped/biped",
                           "octopod/octopod", "servo/servo"}) {
    const std::string path = name;
    texts[path.substr(path.find('/') + 1) + ".txt"] =
        reading_of(std::string(AMBLE_SOURCE_DIR "/robots/") + name + ".toml");
  }
  tests::expect_golden(texts, {{"authors.txt", "126ff54c6133d786"},
                               {"biped.txt", "374ee11237795532"},
                               {"hexapod.txt", "bd9a53da1c0af0d6"},
                               {"octopod.txt", "b1ab3cd0d6432c72"},
                               {"paper.txt", "6566ca3408254930"},
                               {"servo.txt", "0f9e5bea01653a96"}});
}

}  // namespace
}  // namespace amble::morphology
