#include "amble/experiment/problem/live_inputs.hpp"

#include <gtest/gtest.h>

#include "amble/core/error.hpp"

namespace amble::experiment {
namespace {

LiveInputs session() {
  ground::Settings ground;
  ground.kind = "stairs";
  damage::Settings damage;
  damage.parts.push_back({.kind = damage::Kind::missing, .leg = "rear_left"});
  return {.champion = "0123456789abcdef",
          .engine = "batch",
          .inputs = {{.step = 3, .push_n_s = Vec3{0.1, -0.2, 1e-300}},
                     {.step = 3, .ground = ground},
                     {.step = 9, .damage = damage},
                     {.step = 10, .command = trial::Command{0.1f, -0.3f}},
                     {.step = 10, .lift_m = 0.125}},
          .trace = std::vector<std::uint32_t>(10, 0xdeadbeef)};
}

void expect_refused(const LiveInputs& wrong) {
  EXPECT_THROW(parse_inputs(inputs_text(wrong), "inputs"), UserError);
}

TEST(LiveInputs, TextReadsBackToTheSameBits) {
  const std::string text = inputs_text(session());
  const LiveInputs read = parse_inputs(text, "inputs");
  EXPECT_EQ(inputs_text(read), text);
  EXPECT_EQ(read.inputs[0].push_n_s->z, 1e-300);
  EXPECT_EQ(read.inputs[1].ground->kind, "stairs");
  EXPECT_EQ(read.inputs[2].damage->parts.at(0).leg, "rear_left");
  EXPECT_EQ(read.inputs[3].command, (trial::Command{0.1f, -0.3f}));
  EXPECT_EQ(read.inputs[4].lift_m, 0.125);
  EXPECT_EQ(read.trace.size(), 10u);
}

TEST(LiveInputs, RefusesInputsOutOfOrderOrAfterTheEnd) {
  LiveInputs wrong = session();
  wrong.inputs[2].step = 2;
  expect_refused(wrong);
  wrong = session();
  wrong.inputs[2].step = 11;
  expect_refused(wrong);
  wrong = session();
  wrong.inputs[0].step = 0;
  expect_refused(wrong);
}

TEST(LiveInputs, RefusesAlteredText) {
  std::string text = inputs_text(session());
  text.replace(text.find("0.1"), 3, "0.2");
  EXPECT_THROW(parse_inputs(text, "inputs"), UserError);
}

}  // namespace
}  // namespace amble::experiment
