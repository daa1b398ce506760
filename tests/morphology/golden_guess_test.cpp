#include <gtest/gtest.h>

#include "amble/io/json_file.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/robot/json.hpp"
#include "amble/robot/summary.hpp"
#include "tests/graphics/golden.hpp"
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
  tests::expect_golden(texts, {{"arm.txt", "b281bdc3ac129e7e"},
                               {"effort.txt", "2380b7f50c0bff84"},
                               {"fixed_base.txt", "ce3ba527994257b8"},
                               {"head.txt", "86c91bcf0fea3286"},
                               {"keyframe.txt", "6286d82e456ac448"},
                               {"mesh_feet.txt", "6d84fcaa9b5635ca"},
                               {"newer_mujoco.txt", "2aaa1242def350d3"},
                               {"no_limits.txt", "9cf29e1f327d58bb"},
                               {"planar_base.txt", "479239f686bacbf6"},
                               {"three_hinges.txt", "99d80f8c5d457822"},
                               {"uneven_legs.txt", "86ac82b4f23f325e"},
                               {"wide_ranges.txt", "1c8e46a9448885e1"}});
}

TEST(GoldenRobot, OfEachFileInTheRepositoryMatches) {
  std::map<std::string, std::string> texts;
  for (const char* name : {"quadruped/paper", "quadruped/authors", "hexapod/hexapod", "biped/biped",
                           "octopod/octopod", "servo/servo"}) {
    const std::string path = name;
    texts[path.substr(path.find('/') + 1) + ".txt"] =
        reading_of(std::string(AMBLE_SOURCE_DIR "/robots/") + name + ".toml");
  }
  tests::expect_golden(texts, {{"authors.txt", "57f151ce75cad1a3"},
                               {"biped.txt", "bfe561235afbf4dd"},
                               {"hexapod.txt", "a5b604008bba12bb"},
                               {"octopod.txt", "d447db7ac9834e0b"},
                               {"paper.txt", "a4587a14161c6381"},
                               {"servo.txt", "b0de84c822a2f0b5"}});
}

}  // namespace
}  // namespace amble::morphology
