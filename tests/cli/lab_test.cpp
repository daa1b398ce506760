#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <string>
#include <vector>

#include "amble/io/base64.hpp"
#include "tests/cli/bad_input.hpp"

namespace amble::tests {
namespace {

using testing::ElementsAre;

constexpr std::size_t most_bytes = 8 << 20;

/// The robots in a page of `amble lab`, unpacked.
nlohmann::json robots_in(const std::string& page) {
  const auto packed = io::from_base64(page_data(slurp(page)).at("robots").get<std::string>()).value();
  std::string all(most_bytes, '\0');
  uLongf size = most_bytes;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(all.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size())),
            Z_OK);
  return nlohmann::json::parse(all.substr(0, size));
}

std::vector<std::string> names_in(const std::string& page) {
  std::vector<std::string> names;
  for (const auto& robot : robots_in(page)) names.push_back(robot.at("name").get<std::string>());
  return names;
}

class LabCommand : public BadInput {
 protected:
  static std::string robot(const std::string& name) { return source + "/robots/" + name + "/evolve.toml"; }

  std::string page_ = scratch_ / "lab.html";
};

TEST_F(LabCommand, HasTheRobotsOfItsConfigsInTheirOrder) {
  const auto made = amble({"lab", robot("servo"), robot("biped"), robot("hexapod"), "-o", page_});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, page_ + "\n");
  EXPECT_THAT(names_in(page_), ElementsAre("servo", "biped", "hexapod"));
  EXPECT_EQ(amble({"lab", robot("biped"), "-o", page_}).exit_code, 0) << "its own pages it replaces";
  EXPECT_THAT(names_in(page_), ElementsAre("biped"));
}

TEST_F(LabCommand, GivesEachRobotFourControllersInTheBatchEngine) {
  ASSERT_EQ(amble({"lab", robot("octopod"), "-o", page_}).exit_code, 0);
  const auto configs = robots_in(page_).at(0).at("configs");
  std::vector<std::string> kinds;
  for (const char* name : {"supg", "together", "sine", "ctrnn"}) {
    kinds.push_back(configs.at(name).at("controller").at("kind").get<std::string>());
    EXPECT_EQ(configs.at(name).at("engine"), "batch") << name;
    EXPECT_TRUE(configs.at(name).at("referees").empty()) << name;
  }
  EXPECT_THAT(kinds, ElementsAre("supg", "supg", "network", "ctrnn"));
}

TEST_F(LabCommand, WritesNothingWhereThePageCannotBe) {
  const std::string notes = scratch_ / "notes.txt", below = notes + "/lab.html";
  spill(notes, "not a page");
  expect_refusal({"lab", robot("servo"), "-o", below}, ExitCode::io,
                 "cannot write " + below + ": Not a directory");
  expect_refusal({"lab", robot("servo"), "-o", notes}, ExitCode::bad_input,
                 notes + " exists and is not a page that amble wrote: name another file");
  expect_refusal({"lab", robot("servo")}, ExitCode::bad_input, "--out is required (amble lab --help)");
}

TEST_F(LabCommand, NamesTheConfigOrRobotThatIsNotThere) {
  expect_refusal({"lab", robot("unicorn"), "-o", page_}, ExitCode::io,
                 robot("unicorn") + ": No such file or directory");
  const std::string lost = scratch_ / "lost.toml";
  spill(lost, "include = [\"" + source + "/configs/quick/supg.toml\"]\nrobot = \"unicorn.toml\"\n");
  expect_refusal({"lab", lost, "-o", page_}, ExitCode::io, lost + ":2: 'robot': ");
}

TEST_F(LabCommand, RefusesTwoRobotsOfOneName) {
  expect_refusal({"lab", robot("servo"), robot("biped"), robot("servo"), "-o", page_}, ExitCode::bad_input,
                 robot("servo") + ": a robot called servo is in the lab already");
}

}  // namespace
}  // namespace amble::tests
