#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "amble/core/error.hpp"
#include "amble/io/quoting.hpp"
#include "tests/cli/process.hpp"
#include "tests/models/small_models.hpp"

// What surrounds the program: shells, limits, terminals that are closed, folders for temporary files.
namespace amble::tests {
namespace {

using testing::HasSubstr;

constexpr int ok = static_cast<int>(ExitCode::ok), bad_input = static_cast<int>(ExitCode::bad_input),
              bad_file = static_cast<int>(ExitCode::bad_file), io_error = static_cast<int>(ExitCode::io),
              interrupted = static_cast<int>(ExitCode::interrupted);

const std::string config = std::string(AMBLE_SOURCE_DIR) + "/configs/authors/supg-objective.toml";

struct Said {
  int code = -1;  ///< −1: ended by a signal
  std::string text;
};

class Surroundings : public testing::Test {
 protected:
  Surroundings() {
    std::filesystem::create_directories(scratch_ / "bin");
    std::filesystem::create_symlink(AMBLE_PROGRAM, scratch_ / "bin/amble");
  }

  /// A script in a folder of its own, in which `amble` is the program.
  Said shell(const std::string& script) const {
    const std::string out = scratch_ / "out.txt";
    const std::string whole = "export PATH=" + (scratch_ / "bin").string() + ":$PATH; cd " +
                              scratch_.path().string() + "; " + script;
    const int status = std::system(("bash -c " + io::shell_quoted(whole) + " >" + out + " 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out)};
  }
  static std::string evolve(const std::string& out, const std::string& more = "--generations 1") {
    return "amble evolve '" + config +
           "' --set engine=batch --set population.size=6 --set trial.duration_s=0.3 --jobs 1 " + more +
           " --out " + io::shell_quoted(out);
  }
  static std::string small() {
    return " --set engine=batch --set population.size=6 --set trial.duration_s=0.3 --generations 1 --jobs 1 ";
  }
  std::vector<std::string> left_in(const std::string& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(scratch_ / folder))
      names.push_back(entry.path().filename());
    return names;
  }

  TemporaryFolder scratch_;
};

/// The rest of the line that begins so; "" if there is none.
std::string after(const std::string& text, const std::string& beginning) {
  const std::size_t at = ("\n" + text).find("\n" + beginning);
  if (at == std::string::npos) return "";
  const std::size_t from = at + beginning.size();
  return text.substr(from, text.find('\n', from) - from);
}

TEST_F(Surroundings, ConfigsAndRobotsOfTheDocsAreFoundFromAnyFolder) {
  const Said evolved = shell(
      "amble evolve configs/quick/quadruped.toml --set robot=robots/servo/servo.toml --set "
      "controller.substrate=auto" +
      small() + "--out robots/servo");
  EXPECT_EQ(evolved.code, ok) << evolved.text;
  EXPECT_THAT(
      evolved.text,
      HasSubstr(
          "note: configs/quick/quadruped.toml is not in this folder; it is taken from " AMBLE_SOURCE_DIR));
  EXPECT_THAT(evolved.text, HasSubstr("note: robots/servo/servo.toml is not in this folder"));
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "robots/servo/config.toml")) << "what is written stays here";
  const Said own = shell("amble trial robots/servo --undisturbed --seconds 0.1");
  EXPECT_EQ(own.code, ok) << own.text;
  EXPECT_EQ(own.text.find("note: robots"), std::string::npos) << "a folder of one's own goes before";
  EXPECT_EQ(shell("amble trial robots/hexapod/champion.json --undisturbed --seconds 0.1").code, ok);
  const Said written = shell(
      "mkdir away && cd away && amble gait ../robots/servo --undisturbed --seconds 1 --json "
      "robots/servo/servo.toml");
  EXPECT_EQ(written.text.find("note:"), std::string::npos)
      << written.text << "what is written is nobody's but one's own";
  const Said set = shell(
      "amble evolve configs/quick/quadruped.toml --set=robot=robots/hexapod/hexapod.toml --set "
      "controller.substrate=auto" +
      small() + "--out runs/2");
  EXPECT_EQ(set.code, ok) << set.text;
  EXPECT_THAT(shell("amble evolve configs/none.toml --out runs/1").text,
              HasSubstr("configs/none.toml: No such file"));
}

TEST_F(Surroundings, CommandsThatArePrintedCanBePastedWhateverTheRunIsCalled) {
  for (const std::string name :
       {"my run", "run$1 & co", "it's", "$(touch ran)", "a;b", "-x", "läufe/größe"}) {
    const Said run = shell(evolve(name.front() == '-' ? "./" + name : name));
    ASSERT_EQ(run.code, ok) << run.text;
    for (const char* line : {"to see it, run: ", "to read about it, run: "}) {
      const std::string command = after(run.text, line);
      ASSERT_NE(command, "") << run.text;
      const Said pasted = shell("rm -f *.html; " + command + " && ls *.html");
      EXPECT_EQ(pasted.code, ok) << command << "\n" << pasted.text;
    }
    const Said info = shell("amble info " + io::shell_word(name));
    EXPECT_EQ(info.code, ok) << info.text;
    const Said taken = shell(evolve(name.front() == '-' ? "./" + name : name));
    const std::size_t from = taken.text.find("with `") + 6;
    const std::string command = taken.text.substr(from, taken.text.find("`,", from) - from);
    EXPECT_EQ(shell(command + " --generations 2").code, ok) << command;
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "ran"));
  }
}

TEST_F(Surroundings, AReRunOfATouchedRunIsPrintedSuchThatItMakesTheSameRun) {
  ASSERT_EQ(shell(evolve("my run", "--generations 3 --seed 8")).code, ok);
  const Said resumed =
      shell("sed -i 's/$/\\r/' 'my run/generations.csv'; amble resume 'my run' --generations 4");
  EXPECT_EQ(resumed.code, bad_file);
  const std::size_t at = resumed.text.find("amble evolve ");
  ASSERT_NE(at, std::string::npos) << resumed.text;
  std::string command = resumed.text.substr(at, resumed.text.find('\n', at) - at);
  ASSERT_EQ(shell(command).code, ok) << command;
  EXPECT_EQ(all_champions(scratch_ / "NEW_FOLDER"), all_champions(scratch_ / "my run"));
}

TEST_F(Surroundings, AFileThatReachesTheLimitOfItsSizeIsToldAndTheRunGoesOnLater) {
  const Said limited = shell("ulimit -f 100; " + evolve("run", "--generations 3000"));
  EXPECT_EQ(limited.code, io_error) << limited.text;
  EXPECT_THAT(limited.text, HasSubstr("File too large"));
  EXPECT_THAT(limited.text, HasSubstr("run/"));
  const auto rows = [this] {
    const std::string table = slurp(scratch_ / "run/generations.csv");
    return std::count(table.begin(), table.end(), '\n') - 1;
  };
  const auto before = rows();
  ASSERT_GT(before, 0);
  const Said resumed = shell("amble resume run --generations " + std::to_string(before + 2));
  EXPECT_EQ(resumed.code, ok) << resumed.text;
  EXPECT_EQ(rows(), before + 2);
}

TEST_F(Surroundings, TooLittleMemoryIsToldWithTheSettingThatAsksForIt) {
#ifdef AMBLE_SANITIZED
  GTEST_SKIP() << "AddressSanitizer reserves terabytes of addresses, which the limit forbids";
#endif
  const Said many = shell("ulimit -v 400000; " + evolve("run",
                                                        "--set search.kind=novelty --set "
                                                        "population.size=50000 --set trial.duration_s=15"));
  EXPECT_TRUE(many.code == bad_input || many.code == io_error) << many.text;
  EXPECT_THAT(many.text, HasSubstr("not enough memory"));
  EXPECT_THAT(many.text, HasSubstr("population.size = 50000 × behaviours of 1500 numbers"));
  const Said episodes = shell("ulimit -v 400000; " + evolve("run",
                                                            "--set noise.push_m_s=1 --set noise.episodes=900 "
                                                            "--set population.size=20000"));
  EXPECT_THAT(episodes.text, HasSubstr("population.size = 20000 × noise.episodes = 900"));
  for (const Said& said : {many, episodes}) EXPECT_THAT(said.text, testing::Not(HasSubstr("defect")));
}

TEST_F(Surroundings, AnEmptyTmpdirIsNoneAndAWrongOneIsNamed) {
  ASSERT_EQ(shell(evolve("run")).code, ok);
  EXPECT_EQ(shell("TMPDIR= amble view run -o walker.html && [ -s walker.html ]").code, ok);
  EXPECT_EQ(shell("TMPDIR= amble page run -o page.html && [ -s page.html ]").code, ok);
  for (const char* wrong : {"/nowhere", "out.txt"}) {
    const Said said = shell(std::string("TMPDIR=") + wrong + " amble view run -o other.html");
    EXPECT_EQ(said.code, io_error) << said.text;
    EXPECT_THAT(said.text, HasSubstr(std::string("TMPDIR=") + wrong));
  }
}

TEST_F(Surroundings, AClosedTerminalStopsARunAsCtrlCDoesButNotUnderNohup) {
  const std::string wait_for_rows =
      "for i in $(seq 500); do [ $(wc -l < run/generations.csv 2>/dev/null || echo 0) -gt 2 ] && break; "
      "sleep 0.01; done; ";
  const Said closed = shell(evolve("run", "--generations 1000000") + " & sleep 0.05; " + wait_for_rows +
                            "kill -HUP $!; wait $!");
  EXPECT_EQ(closed.code, interrupted) << closed.text;
  EXPECT_THAT(closed.text, HasSubstr("to continue, run: amble resume run"));
  EXPECT_THAT(left_in("run"), testing::Not(testing::Contains(HasSubstr(".tmp."))));
  EXPECT_EQ(shell("amble verify run").code, ok);
  const Said on = shell("rm -r run; nohup " + evolve("run", "--generations 60") + " & sleep 0.05; " +
                        wait_for_rows + "kill -HUP $!; wait $!");
  EXPECT_EQ(on.code, ok) << on.text;
}

TEST_F(Surroundings, AnOutputHasTheStandardOutputAlone) {
  ASSERT_EQ(shell(evolve("run")).code, ok);
  const Said gait = shell("amble gait run --undisturbed --json /dev/stdout 2>said.txt | tee gait.json");
  EXPECT_EQ(gait.code, ok);
  EXPECT_TRUE(nlohmann::json::accept(gait.text)) << gait.text;
  EXPECT_THAT(slurp(scratch_ / "said.txt"), HasSubstr("duty"));
  EXPECT_EQ(shell("amble trial run --record /dev/stdout 2>/dev/null >walk.rec && amble gait walk.rec").code,
            ok);
  const Said page = shell("amble view run -o /dev/stdout --trials 2 2>/dev/null");
  EXPECT_EQ(page.text.find("<!DOCTYPE html>"), 0u);
  EXPECT_THAT(page.text, testing::EndsWith("</html>\n"));
}

TEST_F(Surroundings, ARobotsModelIsNotWrittenOverTheOneThatItIsReadFrom) {
  ASSERT_EQ(shell(evolve("run") + "&& amble export run --format mjcf -o own.xml && "
                                  "amble robot --init own.xml -o own && cp own.xml kept.xml")
                .code,
            ok);
  const Said said = shell("amble robot own/own.toml --mjcf own.xml");
  EXPECT_EQ(said.code, bad_input);
  EXPECT_THAT(said.text, HasSubstr("own/own.toml is made from it"));
  EXPECT_EQ(shell("cmp own.xml kept.xml && amble robot own/own.toml --mjcf other.xml").code, ok);
}

TEST_F(Surroundings, AStoppedViewLeavesNothingInTheFolderForTemporaryFiles) {
  ASSERT_EQ(shell(evolve("run")).code, ok);
  for (const char* signal : {"HUP", "TERM", "INT"}) {
    const Said stopped =
        shell(std::string(
                  "mkdir -p tmp; TMPDIR=$PWD/tmp amble view run --undisturbed --seconds 3000 --engine ode -o "
                  "long.html & while kill -0 $! && [ -z \"$(ls -A tmp)\" ]; do sleep 0.01; done; kill -") +
              signal + " $!; wait $!");
    EXPECT_EQ(stopped.code, interrupted) << signal << stopped.text;
    EXPECT_THAT(left_in("tmp"), testing::IsEmpty()) << signal;
  }
}

/// Fingers of milligrams with motors of newton metres.
std::string dog_with_fingers(const std::string& mass_kg, const std::string& inertia_kg_m2) {
  std::string fingers, motors_of_fingers;
  for (int i = 0; i < 3; ++i) {
    fingers +=
        fmt::format(R"(<body name="f{0}" pos="{1} 0 {2}"><joint name="finger{0}" axis="0 1 0" range="0 57"/>
      <inertial pos="0.005 0 0" mass="{3}" diaginertia="{4} {4} {4}"/>)",
                    i, 0.01, i == 0 ? 0.06 : 0.0, mass_kg, inertia_kg_m2);
    motors_of_fingers += fmt::format(R"(<velocity joint="finger{}" kv="1" forcerange="-3 3"/>)", i);
  }
  for (int i = 0; i < 3; ++i) fingers += "</body>";
  std::string actuators = motors(R"(velocity kv="1" forcerange="-9 9")");
  actuators.insert(actuators.find("</actuator>"), motors_of_fingers);
  return model_text(four_legs(), "<freejoint/>", fingers, actuators);
}

TEST_F(Surroundings, ARunOfWhichHardlyAnyTrialCountsEndsWithAnErrorThatSaysSo) {
  const auto run = [&](const std::string& name, const std::string& mass_kg,
                       const std::string& inertia_kg_m2) {
    spill(scratch_ / (name + ".xml"), dog_with_fingers(mass_kg, inertia_kg_m2));
    const Said init = shell("amble robot --init " + name + ".xml -o " + name);
    EXPECT_EQ(init.code, ok) << init.text;
    // As in a file of one's own: --init welds links of next to nothing.
    if (name == "light") shell("sed -i 's/^fixed = /held = /' light/light.toml");
    return shell(
        "amble evolve " + name +
        "/evolve.toml --set population.size=4 --set trial.duration_s=1 --generations 1 --jobs 1 --out run_" +
        name);
  };
  const Said good = run("heavy", "0.2", "1e-3");
  EXPECT_EQ(good.code, ok) << good.text;
  EXPECT_THAT(good.text, testing::Not(HasSubstr("note:")));
  const Said bad = run("light", "2e-6", "1e-10");
  EXPECT_THAT(bad.text, HasSubstr("note: held in its start pose it diverges after"));
  EXPECT_THAT(bad.text, HasSubstr("amble: run_light: 4 of 4 trials diverged, so the results mean nothing"));
  EXPECT_EQ(bad.code, bad_input);
  EXPECT_EQ(shell("amble info run_light").code, ok) << "the run is there to be looked at";
}

TEST_F(Surroundings, AModelOfAWorldWithAnotherUpIsRefusedBeforeAnythingIsWritten) {
  for (const auto& [gravity, why] : std::map<std::string, std::string>{{"0 -9.81 0", "has +y up"},
                                                                       {"9.81 0 0", "has -x up"},
                                                                       {"0 0 0", "nothing walks"},
                                                                       {"0 0 9.81", "points up"}}) {
    spill(scratch_ / "m.xml",
          model_text(four_legs(), "<freejoint/>", "", "", "<option gravity=\"" + gravity + "\"/>"));
    const Said init = shell("amble robot --init m.xml -o made");
    EXPECT_EQ(init.code, bad_input) << gravity;
    EXPECT_THAT(init.text, HasSubstr(why));
    EXPECT_THAT(init.text, HasSubstr("<option gravity=\"0 0 -9.81\"/>"));
    EXPECT_FALSE(std::filesystem::exists(scratch_ / "made"));
  }
}

TEST_F(Surroundings, InitAndTheStartOfARunSayWhatAHeldRobotDoes) {
  const std::string lying =
      R"(<keyframe><key name="home" qpos="0 0 0.4 1 0 0 0 .65 -1 .65 -1 .65 -1 .65 -1"/></keyframe>)";
  const std::string belly =
      R"(<body name="belly" pos="0 0 -0.33"><geom type="sphere" size="0.05" mass="0.1"/></body>)";
  spill(scratch_ / "lies.xml", model_text(four_legs(), "<freejoint/>", belly,
                                          motors(R"(position kp="40" forcerange="-9 9")") + lying));
  const Said init = shell("amble robot --init lies.xml -o lies");
  EXPECT_EQ(init.code, ok) << init.text;
  EXPECT_THAT(init.text, HasSubstr("look at its start before you evolve:\n  held in its start pose it "));
  EXPECT_THAT(shell("amble robot lies/lies.toml").text, HasSubstr("held in its start pose it "));
  const Said run = shell(
      "amble evolve lies/evolve.toml --set population.size=2 --set trial.duration_s=0.2 --generations 1 "
      "--jobs 1 --out run");
  EXPECT_THAT(run.text, HasSubstr("note: held in its start pose it "));
  spill(scratch_ / "stands.xml", model_text(four_legs()));
  EXPECT_THAT(shell("amble robot --init stands.xml -o stands").text,
              HasSubstr("start: held for a second in its start pose, it stands"));
}

TEST_F(Surroundings, SettingsWithoutEffectAreNamedAtTheStartOfARunAndOfAStudy) {
  const Said run =
      shell("amble evolve " AMBLE_SOURCE_DIR
            "/configs/paper/sine-objective.toml --set controller.supg.idle=mid --set population.size=2 "
            "--set trial.duration_s=0.2 --generations 1 --jobs 1 --out idle");
  EXPECT_EQ(run.code, ok) << run.text;
  EXPECT_THAT(run.text,
              HasSubstr("note: --set controller.supg.idle has no effect: controller.kind is \"network\""));
  spill(scratch_ / "study.toml",
        "name = \"s\"\nseeds = [1]\ngenerations = 1\nsettings = [\"population.size=2\", "
        "\"controller.supg.idle=mid\"]\n[[conditions]]\nname = \"sine\"\nconfig = \"" AMBLE_SOURCE_DIR
        "/configs/paper/sine-objective.toml\"\nsettings = [\"controller.supg.offset=phase\"]\n");
  EXPECT_THAT(shell("amble study study.toml --out s --status").text,
              HasSubstr("note: condition 'sine': controller.supg.offset has no effect"));
}

TEST_F(Surroundings, AUrdfIsTheSameRobotByABareNameAndByAPath) {
  const std::string stl = [] {
    std::string text(80, ' ');
    text += std::string("\4\0\0\0", 4);
    const float corners[4][3] = {{0, 0, 0}, {0.02f, 0, 0}, {0, 0.02f, 0}, {0, 0, -0.02f}};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    for (const auto& face : faces) {
      text += std::string(12, '\0');
      for (const int corner : face) text.append(reinterpret_cast<const char*>(corners[corner]), 12);
      text += std::string(2, '\0');
    }
    return text;
  }();
  std::string urdf = urdf_with_effort();
  for (std::size_t at = 0; (at = urdf.find("<sphere radius=\"0.03\"/>", at)) != std::string::npos;)
    urdf.replace(at, 23, "<mesh filename=\"foot.stl\"/>");
  spill(scratch_ / "r.urdf", urdf);
  spill(scratch_ / "foot.stl", stl);
  const Said bare = shell("amble robot --init r.urdf -o made"), toml = shell("cat made/r.toml; rm -r made"),
             dotted = shell("amble robot --init ./r.urdf -o made"), same = shell("cat made/r.toml");
  EXPECT_EQ(bare.code, ok) << bare.text;
  EXPECT_EQ(bare.text, dotted.text);
  EXPECT_EQ(toml.text, same.text);
}

}  // namespace
}  // namespace amble::tests
