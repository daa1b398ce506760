// Writes recordings for the browser tests into a folder, and what the page must make of one of them.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "amble/ground/height_field.hpp"
#include "amble/io/file.hpp"
#include "amble/io/json_file.hpp"
#include "amble/motion/recorded_trial.hpp"
#include "amble/robot/pose.hpp"
#include "tests/page/synthetic.hpp"

namespace {

using namespace amble;

io::Json list(Vec3 v) {
  return {v.x, v.y, v.z};
}

/// The recorded numbers of a frame, and where the feet are.
io::Json expectation(const tests::SyntheticWalk& walk, const std::filesystem::path& path, int frame) {
  const auto row = walk.frame(frame);
  const auto number = [](float value) { return static_cast<double>(value); };
  io::Json json{{"time_s", (frame + 1) * walk.frame_s},
                {"root", io::Json::array()},
                {"com", io::Json::array()},
                {"angles", io::Json::array()},
                {"feet_m", io::Json::array()}};
  for (std::size_t i = 0; i < 22; ++i)
    json[i < 7 ? "root" : i < 10 ? "com" : "angles"].push_back(number(row[i]));
  const auto recorded = motion::read_recorded_trial(path);
  const auto poses = motion::body_poses(recorded.robot, recorded.motion, frame);
  for (const auto& leg : recorded.robot.legs) {
    const auto& geom = recorded.robot.geoms[static_cast<std::size_t>(leg.foot_geoms[0])];
    json["feet_m"].push_back(list(robot::centre_m(geom, poses)));
  }
  return json;
}

/// Heights of the uneven ground at some places: x, y, height (m).
io::Json heights() {
  const auto field = ground::make_field(tests::SyntheticWalk::hills(), {});
  io::Json json = io::Json::array();
  for (double x = -13.0; x < 14.0; x += 0.613)
    for (double y = -12.0; y < 12.0; y += 1.371) json.push_back({x, y, field.at(x, y).height_m});
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return EXIT_FAILURE;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const tests::SyntheticWalk walk;
  walk.write(folder / "walk.rec");
  tests::SyntheticWalk{.speed_m_s = 0.1}.write(folder / "slow.rec");
  tests::SyntheticWalk{.chatters = true}.write(folder / "chatter.rec");
  tests::SyntheticWalk{.frames = 30000}.write(folder / "long.rec");
  tests::SyntheticWalk{.frames = 7, .touches = false, .outcome = record::Outcome::fell}.write(folder /
                                                                                              "fell.rec");
  tests::SyntheticWalk{.frames = 0, .outcome = record::Outcome::diverged}.write(folder / "empty.rec");
  tests::SyntheticWalk{.speed_m_s = 1.0, .uneven = true}.write(folder / "uneven.rec");
  io::write_file(folder / "heights.json", heights().dump());
  io::write_file(folder / "expected.json", expectation(walk, folder / "walk.rec", 499).dump());
  return EXIT_SUCCESS;
}
