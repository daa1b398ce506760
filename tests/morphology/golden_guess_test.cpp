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
  tests::expect_golden(texts, {{"arm.txt", "03382363205cdb00"},
                               {"effort.txt", "b6324f899c01f519"},
                               {"fixed_base.txt", "3631917054e22f97"},
                               {"head.txt", "43ef2381f7c067f4"},
                               {"keyframe.txt", "a8e89605d3821550"},
                               {"mesh_feet.txt", "6fc5ee05d7feab7e"},
                               {"newer_mujoco.txt", "747e3f1b98772c8a"},
                               {"no_limits.txt", "2bbac639a0b88a5c"},
                               {"planar_base.txt", "9d67a9e9804d8084"},
                               {"three_hinges.txt", "0e4d50655db0cee1"},
                               {"uneven_legs.txt", "1609a1bd61370cc6"},
                               {"wide_ranges.txt", "4b1a677bd8f60f6d"}});
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
