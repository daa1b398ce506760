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
  tests::expect_golden(texts, {{"arm.txt", "95ff50364e28cf2c"},
                               {"effort.txt", "76b37183f028fb8b"},
                               {"fixed_base.txt", "a3466dcef5a53cbe"},
                               {"head.txt", "52a735c5332ab669"},
                               {"keyframe.txt", "1f44077a23921051"},
                               {"mesh_feet.txt", "623025ceeb71c036"},
                               {"newer_mujoco.txt", "4d4febd435ce336e"},
                               {"no_limits.txt", "cd9392019f8d9b97"},
                               {"planar_base.txt", "26708740f21f31ae"},
                               {"three_hinges.txt", "1bd48ef9c53c1523"},
                               {"uneven_legs.txt", "c86df3b6b1d93387"},
                               {"wide_ranges.txt", "c55ed101b8ebe6f3"}});
}

TEST(GoldenRobot, OfEachFileInTheRepositoryMatches) {
  std::map<std::string, std::string> texts;
  for (const char* name : {"quadruped/paper", "quadruped/authors", "hexapod/hexapod", "biped/biped",
                           "octopod/octopod", "servo/servo"}) {
    const std::string path = name;
    texts[path.substr(path.find('/') + 1) + ".txt"] =
        reading_of(std::string(AMBLE_SOURCE_DIR "/robots/") + name + ".toml");
  }
  tests::expect_golden(texts, {{"authors.txt", "57e0e90a133047c6"},
                               {"biped.txt", "a1d0c40c1fc82794"},
                               {"hexapod.txt", "2a55711129c56c2a"},
                               {"octopod.txt", "60f342dd284b4f20"},
                               {"paper.txt", "26203f604aedd6d7"},
                               {"servo.txt", "e4d272392e633c73"}});
}

}  // namespace
}  // namespace amble::morphology
