#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "amble/exporting/c_source.hpp"
#include "tests/exporting/champions.hpp"
#include "tests/exporting/compiled.hpp"
#include "tests/io/temporary_folder.hpp"

// Exported controllers on bare processors, in QEMU and simavr: setup.d/packages-firmware.txt, without which
// these tests skip.
namespace amble::tests {
namespace {

using exporting::Arithmetic;
using test::TemporaryFolder;

const std::string firmware = AMBLE_SOURCE_DIR "/tests/exporting/firmware/",
                  example = AMBLE_SOURCE_DIR "/examples/firmware/";
const bool measures_all = std::getenv("AMBLE_EXPORT_STUDY") != nullptr;

bool installed(const std::string& program) {
  return run_shell("command -v " + program).exit_code == 0;
}

struct Target {
  std::string processor, compiler, emulator;
  std::string sample;
  Arithmetic arithmetic = Arithmetic::float32;
};

void PrintTo(const Target& target, std::ostream* out) {
  *out << target.processor << " " << target.sample;
}

/// In the study every champion on each processor.
std::vector<Target> targets() {
  std::vector<Target> all;
  for (const auto& [processor, compiler, emulator] :
       {std::tuple{"m0", "arm-none-eabi-gcc", "qemu-system-arm"},
        {"m4", "arm-none-eabi-gcc", "qemu-system-arm"},
        {"rv32imc", "riscv64-unknown-elf-gcc", "qemu-system-riscv32"}}) {
    for (const Sample& sample : twenty_samples())
      for (const char* name : {"quadruped_supg", "quadruped_sine", "quadruped_ctrnn", "biped_ctrnn"})
        if (measures_all || sample.name == name) {
          all.push_back({processor, compiler, emulator, sample.name, Arithmetic::float32});
          break;
        }
    all.push_back({processor, compiler, emulator, "quadruped_supg", Arithmetic::fixed});
  }
  return all;
}

std::string name_of(const testing::TestParamInfo<Target>& target) {
  const auto& [processor, compiler, emulator, sample, arithmetic] = target.param;
  return processor + "_" + sample + (arithmetic == Arithmetic::fixed ? "_fixed" : "");
}

class EachTarget : public testing::TestWithParam<Target> {};
INSTANTIATE_TEST_SUITE_P(Firmware, EachTarget, testing::ValuesIn(targets()), name_of);

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

experiment::Champion champion_of(const std::string& name) {
  for (const Sample& sample : twenty_samples())
    if (sample.name == name) return evolve(sample);
  throw std::logic_error("no such sample");
}

TEST_P(EachTarget, AnswersToTheBit) {
  const Target& target = GetParam();
  if (!installed(target.compiler) || !installed(target.emulator))
    GTEST_SKIP() << target.compiler << " and " << target.emulator << ": ./setup --firmware";
  const TemporaryFolder scratch;
  const experiment::Champion champion = champion_of(target.sample);
  const auto tables = exporting::controller_tables(champion.problem, champion.genome);
  const std::atomic<bool> stop{false};
  // Without an FPU a tick of a CTRNN takes a million instructions and more.
  const auto* const neural = std::get_if<exporting::NeuralTables>(&tables.parts);
  const bool slow =
      neural && neural->update != exporting::NeuralTables::Update::levels && target.processor != "m4";
  const bool patient = measures_all && std::string(std::getenv("AMBLE_EXPORT_STUDY")) == "full";
  const int ticks = !measures_all ? 300 : slow && !patient ? 3000 : 30000;
  const auto trace = exporting::record_trace(champion.problem, champion.genome, ticks, stop);
  write_walker(scratch.path(), champion, target.arithmetic);
  const Ran built = run_shell(firmware + "build " + target.processor + " '" + scratch.path().string() + "'");
  ASSERT_EQ(built.exit_code, 0) << built.out;
  const Difference difference = replay(scratch / target.processor, tables, trace);
  EXPECT_EQ(difference.ticks, trace.ticks.size());
  EXPECT_EQ(difference.states_of_other_bits, 0u);
  if (target.arithmetic == Arithmetic::fixed)
    EXPECT_LE(difference.largest_rad, std::ldexp(1.0, -exporting::fraction_bits(tables)));
  else
    EXPECT_EQ(difference.targets_of_other_bits, 0u);
  if (measures_all)
    fmt::print("| {} | {}{} | {} | {} | {} | {:.2g} |\n", target.processor, target.sample,
               target.arithmetic == Arithmetic::fixed ? " fixed" : "", one_line(built.out),
               one_line(difference.printed), difference.ticks, difference.largest_rad);
}

TEST(Firmware, InFixedPointPassesItsSelfTestOnAnAvr) {
  if (!installed("avr-gcc") || !installed("simavr")) GTEST_SKIP() << "avr-gcc and simavr: ./setup --firmware";
  const TemporaryFolder scratch;
  write_walker(scratch.path(), champion_of("quadruped_supg"), Arithmetic::fixed);
  const std::string folder = "'" + scratch.path().string() + "'";
  const std::string flags =
      " -mmcu=atmega2560 -DF_CPU=16000000UL -DWALKER_SELF_TEST -DWALKER_NO_MAIN -Os -Wall -Wextra -Werror ";
  const Ran built = run_shell("avr-gcc -std=c99 -pedantic" + flags + "-I" + folder + " " + folder +
                              "/walker.c -x c -std=gnu99 " + firmware + "avr.c -o " + folder + "/avr.elf");
  ASSERT_EQ(built.exit_code, 0) << built.out;
  const Ran ran = run_shell("timeout 60 simavr -m atmega2560 -f 16000000 " + folder + "/avr.elf");
  EXPECT_NE(ran.out.find("self-test passed"), std::string::npos) << ran.out;
  if (!measures_all) return;
  const Ran size =
      run_shell("cd " + folder +
                " && avr-gcc -std=c99 -pedantic -mmcu=atmega328p -Os -Wall -Wextra -Werror -fstack-usage "
                "-c walker.c -o small.o && avr-size small.o && cat *.su && avr-nm -S small.o");
  fmt::print("avr: {}{}\n", ran.out, size.out);
}

Ran make_example(const TemporaryFolder& scratch, const std::string& goal) {
  return run_shell("make -s -C " + example + " OUT='" + scratch.path().string() + "' " + goal);
}

TEST(Firmware, ExampleWalksInQemuOnBothProcessorsAlike) {
  if (!installed("arm-none-eabi-gcc") || !installed("qemu-system-arm") ||
      !installed("riscv64-unknown-elf-gcc") || !installed("qemu-system-riscv32"))
    GTEST_SKIP() << "compilers and emulators: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran arm = make_example(scratch, "run"), riscv = make_example(scratch, "run-riscv");
  EXPECT_EQ(arm.exit_code, 0) << arm.out;
  EXPECT_EQ(riscv.exit_code, 0) << riscv.out;
  EXPECT_NE(arm.out.find("300 ticks, late 0"), std::string::npos) << arm.out;
  EXPECT_EQ(arm.out, riscv.out);
}

TEST(Firmware, ExampleCompilesForAnEsp32) {
  if (!installed("riscv64-unknown-elf-gcc")) GTEST_SKIP() << "riscv64-unknown-elf-gcc: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "esp32");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
}

}  // namespace
}  // namespace amble::tests
