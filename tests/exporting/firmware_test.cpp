#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "amble/exporting/c_source.hpp"
#include "amble/io/file.hpp"
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
  return run_shell("make -s --no-print-directory -C " + example + " OUT='" + scratch.path().string() + "' " +
                   goal);
}

TEST(Firmware, ExampleWalksInQemuOnBothProcessorsAlike) {
  if (!installed("arm-none-eabi-gcc") || !installed("qemu-system-arm") ||
      !installed("riscv64-unknown-elf-gcc") || !installed("qemu-system-riscv32"))
    GTEST_SKIP() << "compilers and emulators: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran arm = make_example(scratch, "run"), riscv = make_example(scratch, "run-riscv");
  EXPECT_EQ(arm.exit_code, 0) << arm.out;
  EXPECT_EQ(riscv.exit_code, 0) << riscv.out;
  EXPECT_NE(arm.out.find("600 ticks, late 0"), std::string::npos) << arm.out;
  EXPECT_EQ(arm.out, riscv.out);
}

bool installed_for_esp32() {
  return installed("riscv64-unknown-elf-gcc") && installed("qemu-system-riscv32");
}

bool installed_for_arduino() {
  return installed("avr-g++") && std::filesystem::exists("/usr/include/simavr/sim_avr.h") &&
         std::filesystem::exists("/usr/share/arduino/hardware/arduino/avr/cores/arduino/Arduino.h");
}

/// From the first line of a Markdown table on.
std::string table_of(const std::string& text) {
  const std::size_t start = text.find("| what |");
  return start == std::string::npos ? "no table: " + text : text.substr(start);
}

void expect_in_page(const std::string& table) {
  EXPECT_NE(io::read_file(example + "README.md").find(table), std::string::npos)
      << "examples/firmware/README.md does not have\n"
      << table;
}

TEST(Firmware, OfAnEsp32WalksStopsAndKeepsItsLimitsIn60EmulatedSecondsAsItsPageSays) {
  if (!installed_for_esp32()) GTEST_SKIP() << "compiler and emulator: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-60s-esp32 run-60s-host");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  EXPECT_EQ(io::read_file(scratch / "esp32.log"), io::read_file(scratch / "host.log"));
  const Ran judged = run_shell("cd '" + scratch.path().string() + "' && ./check_run <esp32.log");
  expect_in_page(table_of(judged.out));
}

TEST(Firmware, OfAnEsp32DoesTheSameWithAPca9685) {
  if (!installed_for_esp32()) GTEST_SKIP() << "compiler and emulator: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-60s-esp32-pca9685");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  expect_in_page(table_of(ran.out));
}

TEST(Firmware, OfAnArduinoDoesTheSameWithAPca9685) {
  if (!installed_for_arduino()) GTEST_SKIP() << "compiler, core and emulator: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-60s-arduino");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  expect_in_page(table_of(ran.out));
}

TEST(Firmware, OfAnArduinoThatHangsIsResetAndWaitsToBeArmed) {
  if (!installed_for_arduino()) GTEST_SKIP() << "compiler, core and emulator: ./setup --firmware";
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-hang");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
  EXPECT_EQ(ran.out.rfind("hung while walking", 0), 0u) << ran.out;
  expect_in_page(ran.out);
}

TEST(Firmware, OfALostBusCutsTheServosOffAndIsNotArmedBeforeItIsBackAsItsPageSays) {
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-lost-bus");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  EXPECT_NE(ran.out.find("10.10 s: OE cuts the servos off\n"), std::string::npos) << ran.out;
  expect_in_page(ran.out);
  if (!installed_for_arduino()) GTEST_SKIP() << "compiler, core and emulator: ./setup --firmware";
  const Ran arduino = make_example(scratch, "run-lost-bus-arduino");
  EXPECT_EQ(arduino.exit_code, 0) << arduino.out;
  EXPECT_NE(arduino.out.find(ran.out), std::string::npos) << arduino.out;
}

TEST(Firmware, KeepsWhatItPromisesWhateverComesByPinsSerialPortAndBus) {
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "check-robot");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
}

/// The example with another controller.
void write_example(const TemporaryFolder& scratch, const experiment::Champion& champion,
                   Arithmetic arithmetic = Arithmetic::float32) {
  std::filesystem::copy(example, scratch / "firmware", std::filesystem::copy_options::recursive);
  write_walker(scratch / "firmware", champion, arithmetic);
}

Ran make_other(const TemporaryFolder& scratch, const std::string& goal) {
  return run_shell("make -s --no-print-directory -C '" + (scratch / "firmware").string() + "' OUT='" +
                   (scratch / "build").string() + "' " + goal);
}

const std::string modulation = "controller.supg.modulation.";
const std::vector<std::string> no_switches = {"controller.supg.trigger=none", "controller.supg.idle=wrap"};

/// SUPGs without switches that are told a speed and a turn.
experiment::Champion obeying() {
  Sample sample{.name = "obeying", .preset = "authors/supg", .assignments = no_switches};
  sample.assignments.insert(sample.assignments.end(),
                            {modulation + R"(sensors=["command_speed","command_turn"])",
                             modulation + "rate=1", modulation + "shape=1", "command.kind=random"});
  return evolve(sample);
}

/// A controller that reads all that an export can read.
experiment::Champion feeling() {
  return evolve(
      {.name = "feeling",
       .preset = "authors/supg",
       .assignments = {
           modulation + R"(sensors=["roll","yaw_rate","load","speed.hip_io","torque.knee","angle.knee"])",
           modulation + "rate=1", modulation + "shape=1"}});
}

/// SUPGs with switches that are told a speed and a turn.
experiment::Champion obeying_with_switches() {
  return evolve({.name = "obeying_with_switches",
                 .preset = "authors/supg",
                 .assignments = {modulation + R"(sensors=["command_speed","command_turn"])",
                                 modulation + "rate=1", modulation + "shape=1", "command.kind=random"}});
}

/// Replaces in a file of the example, which must have it.
void replace_in(const std::filesystem::path& file, const std::string& what, const std::string& by) {
  std::string text = io::read_file(file);
  const std::size_t at = text.find(what);
  ASSERT_NE(at, std::string::npos) << file << " " << what;
  io::write_file(file, text.replace(at, what.size(), by));
}

TEST(Firmware, OfARobotWithSwitchesThatIsToldToStandStaysArmed) {
  const TemporaryFolder scratch;
  write_example(scratch, obeying_with_switches());
  const Ran ran = make_other(scratch, "check-robot run-60s-host");
  EXPECT_EQ(ran.exit_code, 0) << ran.out;
  EXPECT_NE(ran.out.find("| told to stand it stays armed, whatever its feet do | yes |"), std::string::npos)
      << ran.out;
}

TEST(Firmware, KeepsTheTimeOfControllersOfOtherTicks) {
  for (const char* tick_us : {"5000", "12500", "16667", "20000"}) {
    const TemporaryFolder scratch;
    std::filesystem::copy(example, scratch / "firmware", std::filesystem::copy_options::recursive);
    replace_in(scratch / "firmware/walker.h", "WALKER_TICK_US 10000",
               std::string("WALKER_TICK_US ") + tick_us);
    const Ran ran = make_other(scratch, "run-60s-host check-robot");
    EXPECT_EQ(ran.exit_code, 0) << tick_us << "\n" << ran.out;
  }
}

TEST(Firmware, CheckOfPromisesSeesEachThatIsBroken) {
  struct Fault {
    std::string file, what, by, claim;
  };
  for (const auto& [file, what, by, claim] : std::vector<Fault>{
           {"robot.c", "left > 0 && (character", "(character", "no tick is longer"},
           {"robot.c", "if (r->quiet_ticks > 0) return;", "", "no tick is longer"},
           {"robot.c", "(ends && mode == ROBOT_CALIBRATES)", "0", "lines that arm and stop"},
           {"robot.c", "character - 'A' + 'a'", "character", "`stop` stops in large"},
           {"robot.c", "  board_outputs(0);\n", "", "cut off without the bus"},
           {"robot.c", "if (board_outputs(1)) return 1;", "board_outputs(1);\n  return 1;",
            "before the bus is back"},
           {"robot.c", "least_arm_ticks = 300000", "least_arm_ticks = 20000", "a spike"},
           {"robot.c", "&& ticks <= most_arm_ticks", "", "a spike"},
           {"safety.c", "limits->slow_us > 0", "limits->slow_us == 0", "1.2 times"},
           {"safety.c", "s->landed && !touches", "!touches && in->walks", "in the air it walks"}}) {
    const TemporaryFolder scratch;
    std::filesystem::copy(example, scratch / "firmware", std::filesystem::copy_options::recursive);
    replace_in(scratch / "firmware" / file, what, by);
    const Ran ran = make_other(scratch, "check-robot");
    EXPECT_NE(ran.exit_code, 0) << what;
    const std::size_t at = ran.out.find(claim);
    ASSERT_NE(at, std::string::npos) << what << "\n" << ran.out;
    EXPECT_EQ(ran.out.substr(ran.out.find(" |", at), 12), " | **no** |\n") << what << "\n" << ran.out;
  }
}

TEST(Firmware, OfOtherControllersIsJudgedGoodAsWell) {
  const experiment::Champion blind = evolve(
                                 {.name = "blind", .preset = "authors/supg", .assignments = no_switches}),
                             other = champion_of("quadruped_supg"), feels = feeling();
  for (const auto& [champion, arithmetic] : {std::pair{&other, Arithmetic::float32},
                                             {&other, Arithmetic::fixed},
                                             {&blind, Arithmetic::float32},
                                             {&blind, Arithmetic::fixed},
                                             {&feels, Arithmetic::float32}}) {
    const TemporaryFolder scratch;
    write_example(scratch, *champion, arithmetic);
    const Ran ran = make_other(scratch, "run-60s-host check-robot");
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
  }
}

/// Expects that a log with a fault is judged bad, in a row.
void expect_seen(const std::filesystem::path& folder, const std::string& fault, const std::string& row) {
  const Ran judged = run_shell("cd '" + folder.string() + "' && sed '" + fault + "' host.log | ./check_run");
  EXPECT_EQ(judged.exit_code, 1) << fault;
  const std::size_t at = judged.out.find(row);
  ASSERT_NE(at, std::string::npos) << row;
  const std::string line = judged.out.substr(at, judged.out.find('\n', at) - at);
  EXPECT_NE(line.find("not as wanted"), std::string::npos) << fault << "\n" << judged.out;
}

TEST(Firmware, OfAControllerThatObeysIsToldWhatToDoAndStandsWhereNoLineFollows) {
  const TemporaryFolder scratch;
  write_example(scratch, obeying());
  const Ran ran = make_other(scratch, "run-60s-host check-robot");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  for (const auto& [fault, row] : std::map<std::string, std::string>{
           {"/^T 800 /,/^T 801 /s/^P 13 .*/P 13 1777/", "those of the exported controller"},
           {"/^S no line for long/d", "told to stand"},
           {"/^S not obeyed/d", "while it does not walk"}})
    expect_seen(scratch / "build", fault, row);
  // A second is the builder's choice.
  run_shell("sed -i 's/robot_command_ticks = 1000000/robot_command_ticks = 2000000/' '" +
            (scratch / "firmware/my_robot.c").string() + "'");
  const Ran slower = make_other(scratch, "run-60s-host");
  EXPECT_EQ(slower.exit_code, 0) << slower.out;
  EXPECT_NE(slower.out.find("| 3 from 13.51 s on | 3 from 13.51 s on |"), std::string::npos) << slower.out;
}

TEST(Firmware, OfAControllerThatReadsMoreSaysWhatAndIsCopiedOnceThatIsRead) {
  const TemporaryFolder scratch;
  write_example(scratch, feeling());
  for (const char* goal : {"esp32", "esp32-pca9685", "arduino"}) {
    const Ran refused = make_other(scratch, goal);
    EXPECT_NE(refused.exit_code, 0) << goal;
    for (const char* what : {"ATTITUDE", "YAW_RATE", "ANGLES", "SPEEDS", "TORQUES", "LOADS"})
      EXPECT_NE(refused.out.find(std::string("This controller reads ") + what), std::string::npos)
          << what << " " << refused.out;
    EXPECT_FALSE(std::filesystem::exists(scratch / "build/main/my_robot.c")) << goal;
  }
  // Headers that are not here do not matter.
  run_shell("sed -i 's/^#error .*/#include \"of_an_imu.h\"/' '" + (scratch / "firmware/my_robot.c").string() +
            "'");
  const Ran copied = make_other(scratch, "esp32");
  EXPECT_EQ(copied.exit_code, 0) << copied.out;
  EXPECT_TRUE(std::filesystem::exists(scratch / "build/main/my_robot.c"));
}

TEST(Firmware, CheckOfARunSeesEachKindOfFault) {
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-60s-host");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  for (const auto& [fault, row] : std::map<std::string, std::string>{
           {"/^T 1000 /,/^T 1001 /s/^P 13 .*/P 13 1777/", "those of the exported controller"},
           {"/^T 1000 /,/^T 1001 /s/^P 14 .*/P 14 650/", "beyond `least_us`"},
           {"/^T 1000 /,/^T 1001 /s/^P 16 .*/P 16 1400/", "largest change"},
           {"/^T 200 /,/^T 201 /s/^P 17 .*/P 17 1700/", "ramps"},
           {"/^T 1850 /,/^T 1851 /s/^P 17 .*/P 17 1700/", "pressed at 18.00 s"},
           {"/^T 3200 /,/^T 3201 /s/^P 17 .*/P 17 1700/", "a tick 70 ms late"},
           {"/^T 50 /,/^T 51 /s/^P 17 .*/P 17 1700/", "before it is armed"},
           {"/^T 4000 /,/^T 4001 /d", "got its pulse"},
           {"s/^T 5999 .*/T 5999 48000000/", "got its pulse"},
           {"0,/^S not obeyed/{/^S not obeyed/d}", "takes none"}})
    expect_seen(scratch.path(), fault, row);
}

/// The lines of a code block of a page, from the one that begins with `first` on.
std::vector<std::string> block(const std::string& page, const std::string& first) {
  std::vector<std::string> lines;
  std::istringstream text(page.substr(std::min(page.find("\n" + first), page.size() - 1) + 1));
  for (std::string line; std::getline(text, line) && line != "```";) lines.push_back(line);
  return lines;
}

TEST(Firmware, CalibrationAnswersAsItsPageSaysAndItsTableCompiles) {
  const TemporaryFolder scratch;
  const Ran ran = make_example(scratch, "run-calibration");
  ASSERT_EQ(ran.exit_code, 0) << ran.out;
  std::size_t at = 0;
  const auto shown = block(io::read_file(AMBLE_SOURCE_DIR "/docs/BUILDING.md"), "> calibrate");
  ASSERT_GT(shown.size(), 10u);
  for (const std::string& line : shown) {
    if (line == "…") continue;
    const std::size_t found = ran.out.find(line + "\n", at);
    ASSERT_NE(found, std::string::npos) << line << "\n" << ran.out;
    at = found;
  }
  // What a builder does: all rows in place of those of servos that nobody has calibrated.
  std::string rows;
  std::istringstream text(ran.out);
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("[WALKER_JOINT_")) rows += line + "\n";
  io::write_file(scratch / "my_robot.c", "#include \"robot.h\"\nconst servo robot_servos[] = {\n" + rows +
                                             "};\ntypedef char all[sizeof robot_servos == WALKER_JOINTS * "
                                             "sizeof(servo) ? 1 : -1];\n");
  const Ran compiled =
      run_shell("gcc -std=c99 -pedantic -Wall -Wextra -Werror -I" + example + " -c '" +
                (scratch / "my_robot.c").string() + "' -o '" + (scratch / "a.o").string() + "'");
  EXPECT_EQ(compiled.exit_code, 0) << compiled.out;
}

TEST(Firmware, OfAnEsp32ComesAsAComponentOfEspIdfAlsoWhereItCannotBeCompiled) {
  const TemporaryFolder scratch;
  for (const auto& [target, ours, other] :
       {std::tuple{"esp32", "main/pulses_ledc.c", "main/pulses_pca9685.c"},
        {"esp32-pca9685", "main/pulses_pca9685.c", "main/pulses_ledc.c"},
        {"esp32", "main/pulses_ledc.c", "main/pca9685.c"},
        {"esp32-pca9685 RISCV=no-compiler", "main/pulses_pca9685.c", "main/pulses_ledc.c"},
        {"esp32 RISCV=no-compiler", "main/pulses_ledc.c", "main/pulses_pca9685.c"}}) {
    const bool compiles =
        std::string(target).find('=') == std::string::npos && installed("riscv64-unknown-elf-gcc");
    const Ran ran = make_example(scratch, target);
    EXPECT_EQ(ran.exit_code, 0) << ran.out;
    EXPECT_TRUE(std::filesystem::exists(scratch / "main/main.c"));
    EXPECT_TRUE(std::filesystem::exists(scratch / ours)) << target;
    EXPECT_FALSE(std::filesystem::exists(scratch / other)) << target;
    EXPECT_EQ(ran.out.find("copied without compiling it") == std::string::npos, compiles) << ran.out;
    EXPECT_EQ(std::ranges::count(ran.out, '\n'), compiles ? 0 : 1) << ran.out;
  }
}

TEST(Firmware, OfAnEsp32IsCompiledByEspIdfWithoutFusedOperations) {
  const TemporaryFolder scratch;
  const Ran copied = make_example(scratch, "esp32 RISCV=no-compiler");
  ASSERT_EQ(copied.exit_code, 0) << copied.out;
  io::write_file(scratch / "CMakeLists.txt",
                 "cmake_minimum_required(VERSION 3.16)\nproject(walker C)\n"
                 "function(idf_component_register)\n"
                 "  cmake_parse_arguments(given \"\" \"\" \"SRCS;INCLUDE_DIRS\" ${ARGN})\n"
                 "  add_library(main STATIC ${given_SRCS})\nendfunction()\n"
                 "set(COMPONENT_LIB main)\nadd_subdirectory(main)\n");
  const std::string folder = "'" + scratch.path().string() + "'";
  const Ran made =
      run_shell("cmake -S " + folder + " -B " + folder + "/made -DCMAKE_EXPORT_COMPILE_COMMANDS=ON");
  ASSERT_EQ(made.exit_code, 0) << made.out;
  std::istringstream commands(io::read_file(scratch / "made/compile_commands.json"));
  int seen = 0;
  for (std::string line; std::getline(commands, line);)
    if (line.find("\"command\"") != std::string::npos && line.find("/walker.c") != std::string::npos) {
      ++seen;
      EXPECT_NE(line.find(" -ffp-contract=off "), std::string::npos) << line;
    }
  EXPECT_EQ(seen, 1);
}

TEST(Firmware, WithAPca9685HasNoMoreJointsThanTheChipHasChannels) {
  for (const auto& [joints, compiles] : {std::pair{"16", true}, {"17", false}}) {
    const TemporaryFolder scratch;
    std::filesystem::copy(example, scratch / "firmware", std::filesystem::copy_options::recursive);
    replace_in(scratch / "firmware/walker.h", "WALKER_JOINTS 12", std::string("WALKER_JOINTS ") + joints);
    // An Arduino's folder is compiled from its sources in C on, of which my_robot.c has twelve servos.
    replace_in(scratch / "firmware/my_robot.c", "? 1 : -1", "? 1 : 1");
    for (const char* goal : {"arduino.elf", "riscv-esp32-pulses_pca9685.o"}) {
      if (goal[0] == 'a' ? !installed_for_arduino() : !installed("riscv64-unknown-elf-gcc")) continue;
      const Ran ran = make_other(scratch, "'" + (scratch / "build" / goal).string() + "'");
      EXPECT_EQ(ran.exit_code == 0, compiles) << goal << " " << joints << "\n" << ran.out;
      EXPECT_EQ(ran.out.find("a_channel_for_each_joint") == std::string::npos, compiles) << goal << "\n"
                                                                                         << ran.out;
    }
  }
}

TEST(Firmware, NamesNoLegAndNoJoint) {
  for (const char* file :
       {"robot.c", "robot.h", "my_robot.c", "board.h", "safety.c", "calibrate.c", "commands.c", "servos.c",
        "arduino/arduino.ino", "esp32/main.c", "esp32/pulses_ledc.c", "esp32/pulses_pca9685.c",
        "emulator/board_qemu.c", "emulator/esp_idf_fake.c", "emulator/check_run.c", "emulator/check_robot.c",
        "emulator/sense.h"}) {
    const std::string text = io::read_file(example + file);
    for (const char* name : {"WALKER_JOINT_", "WALKER_LEG_", "front", "rear", "knee", "shoulder"})
      EXPECT_EQ(text.find(name), std::string::npos) << file << " " << name;
  }
}

}  // namespace
}  // namespace amble::tests
