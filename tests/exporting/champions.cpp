#include "tests/exporting/champions.hpp"

#include <algorithm>
#include <map>

#include "amble/experiment/run_paths.hpp"
#include "amble/io/file.hpp"
#include "tests/experiment/fixture.hpp"
#include "tests/robot/legged.hpp"

namespace amble::tests {
namespace {

using namespace experiment;

const std::string ctrnn = "controller.ctrnn.", supg = "controller.supg.";

robot::RobotSpec robot_called(const std::string& name) {
  if (name == "hexapod") return legged_robot(3);
  if (name == "biped") return legged_robot(1);
  const robot::RobotSpec quadruped = legged_robot(2);
  if (name == "sprung") return with_passive_joint(quadruped);
  return name == "lacking" ? without_hip_io(quadruped, 2) : with_held_joint(quadruped, 1, 0);
}

}  // namespace

std::vector<Sample> twenty_samples() {
  return {
      {"quadruped_supg", "authors/supg"},
      {"quadruped_sine", "authors/sine"},
      {"quadruped_ctrnn", "authors/ctrnn"},
      {"paper_supg", "paper/supg"},
      {"paper_sine", "paper/sine"},
      {"paper_ctrnn", "paper/ctrnn"},
      {"holding_level",
       "authors/supg",
       "quadruped",
       {supg + "idle=hold", supg + "trigger=level", supg + "offset=delay", supg + "start_tick=0"}},
      {"wrapping_debounced",
       "authors/supg",
       "quadruped",
       {supg + "idle=wrap", supg + "trigger_debounce_ticks=5", supg + "period_s=0.7"}},
      {"ctrnn_runge_kutta",
       "authors/ctrnn",
       "quadruped",
       {ctrnn + "equation=potential", ctrnn + "integrator=rk4", ctrnn + "state=kept", ctrnn + "slope=1"}},
      {"ctrnn_exponential",
       "authors/ctrnn",
       "quadruped",
       {ctrnn + "integrator=exponential_euler", ctrnn + "state=kept"}},
      {"ctrnn_potential", "authors/ctrnn", "quadruped", {ctrnn + "equation=potential"}},
      {"recurrent_sine",
       "authors/sine",
       "quadruped",
       {R"(controller.substrate.links=[{from="input",to="hidden"},{from="hidden",to="output",both_ways=true}])"}},
      {"hexapod_supg", "authors/supg", "hexapod"},
      {"hexapod_sine", "authors/sine", "hexapod"},
      {"hexapod_ctrnn", "authors/ctrnn", "hexapod"},
      {"biped_supg", "authors/supg", "biped"},
      {"biped_sine", "authors/sine", "biped"},
      {"biped_ctrnn", "authors/ctrnn", "biped"},
      {"lacking_supg", "paper/supg", "lacking"},
      {"holding_ctrnn", "paper/ctrnn", "holding", {ctrnn + "integrator=rk4"}},
  };
}

std::vector<Sample> seam_samples() {
  const std::string seam = supg + "seam.";
  return {
      {"residual", "authors/supg", "quadruped", {seam + "residual_s=0.05"}},
      {"delayed_residual",
       "paper/supg",
       "quadruped",
       {seam + "residual_s=0.1", supg + "idle=wrap", seam + "time=circle"}},
      {"filtered", "authors/supg", "hexapod", {seam + "filter_s=0.04", seam + "detrend=true"}},
      {"filtered_residual",
       "authors/supg",
       "holding",
       {seam + "filter_s=0.02", seam + "filter_order=1", seam + "residual_s=0.02", supg + "idle=hold",
        supg + "offset=delay"}},
  };
}

std::vector<Sample> modulated_samples() {
  const std::string modulation = supg + "modulation.", seam = supg + "seam.",
                    hand = "controller.differential.";
  return {
      {"modulated",
       "authors/supg",
       "quadruped",
       {modulation + R"(sensors=["pitch","angle.knee"])", modulation + "rate=1", modulation + "shape=1"}},
      {"modulated_rate",
       "paper/supg",
       "hexapod",
       {modulation + R"(sensors=["roll","yaw_rate","load"])", modulation + "rate=0.5",
        modulation + "reset=0.5", modulation + "refractory_ticks=20", supg + "idle=wrap"}},
      {"modulated_shape",
       "authors/supg",
       "lacking",
       {modulation + R"(sensors=["speed.hip_io","torque.knee"])", modulation + "shape=0.5",
        supg + "offset=delay", seam + "residual_s=0.05", seam + "filter_s=0.02",
        "controller.sensing.sensors=[{of=\"speed\",scale=2.0}]"}},
      {"modulated_reading",
       "authors/supg",
       "hexapod",
       {modulation + R"(sensors=["pitch","angle.knee"])", modulation + "rate=1", modulation + "shape=0.5",
        modulation + "shape_by=reading", seam + "residual_s=0.05", seam + "detrend=true"}},
      {"torque_contact",
       "authors/supg",
       "quadruped",
       {supg + "contact.source=torque", supg + "contact.joint_type=knee", supg + "contact.threshold=1"}},
      {"tracking_contact",
       "authors/supg",
       "hexapod",
       {supg + "contact.source=tracking", supg + "contact.threshold=0.05", seam + "filter_s=0.02"}},
      {"shock_contact",
       "authors/supg",
       "quadruped",
       {supg + "contact.source=shock", supg + "contact.threshold=5", modulation + "reset=0.5"}},
      {"load_feedback",
       "authors/supg",
       "quadruped",
       {modulation + "load_feedback=4", supg + "trigger=none", supg + "idle=wrap"}},
      {"load_feedback_and_rates",
       "authors/supg",
       "hexapod",
       {modulation + R"(sensors=["pitch","angle.knee"])", modulation + "rate=1", modulation + "shape=0.5",
        modulation + "shape_by=reading", modulation + "load_feedback=1.5", seam + "residual_s=0.05"}},
      {"soft_reset", "authors/supg", "quadruped", {modulation + "reset=0.25", seam + "filter_s=0.02"}},
      {"obeying",
       "authors/supg",
       "hexapod",
       {modulation + R"(sensors=["command_turn","heading_error"])", modulation + "rate=1",
        modulation + "shape=1", "command.kind=random", "trial.first_command=before_first_step"}},
      {"by_hand",
       "authors/supg",
       "hexapod",
       {hand + "turn_gain=2", hand + "full_speed_m_s=0.3", hand + "heading_gain=0.5", "command.kind=random",
        "command.least_speed_m_s=-0.4"}},
      {"by_hand_with_lead",
       "authors/supg",
       "quadruped",
       {hand + "turn_gain=2", hand + "heading_gain=0.5", "controller.sensing.heading.lead_rad=0.02",
        "command.kind=random"}},
      {"by_hand_and_hearing",
       "authors/supg",
       "quadruped",
       {modulation + R"(sensors=["command_turn"])", modulation + "rate=1", modulation + "shape=1",
        hand + "turn_gain=1", "command.kind=random", "trial.first_command=before_first_step"}},
      {"by_hand_oscillators",
       "authors/supg",
       "hexapod",
       {"controller.kind=oscillators", hand + "turn_gain=4", hand + "full_speed_m_s=0.2",
        hand + "about=middle", "command.kind=random"}},
      {"oscillators", "authors/supg", "quadruped", {"controller.kind=oscillators"}},
      {"oscillators_reset",
       "authors/supg",
       "hexapod",
       {"controller.kind=oscillators", "controller.oscillators.reset=touch"}},
      {"oscillators_lacking",
       "paper/supg",
       "lacking",
       {"controller.kind=oscillators", "controller.oscillators.reset=touch"}},
      {"mixed",
       "authors/supg",
       "quadruped",
       {"controller.kind=mixed", "controller.substrate=auto", "command.kind=random", "cppn.linear=identity"}},
      {"mixed_smooth",
       "paper/supg",
       "hexapod",
       {"controller.kind=mixed", supg + "idle=wrap", seam + "residual_s=0.05", seam + "filter_s=0.02",
        "command.kind=random", "cppn.linear=identity", modulation + "reset=0.5"}},
  };
}

std::vector<Sample> sensing_samples() {
  const std::string modulation = supg + "modulation.", contact = supg + "contact.";
  return {
      {"ctrnn_obeying",
       "authors/ctrnn",
       "hexapod",
       {ctrnn +
            R"(sensors=["command_stop","command_speed","command_turn","heading_error","yaw_rate","roll","pitch"])",
        ctrnn + "motor_bias=evolved", ctrnn + "state=kept", ctrnn + "steps_per_tick=1", "command.kind=random",
        R"(controller.sensing.sensors=[{of="command_speed",scale=2.5},{of="yaw_rate",scale=0.5}])"}},
      {"ctrnn_feeling",
       "paper/ctrnn",
       "quadruped",
       {"controller.substrate=auto",
        ctrnn + R"(sensors=["yaw","angle.hip_fb","speed.knee","torque.knee","load","command_turn"])",
        ctrnn + "equation=potential", "command.kind=random", "trial.first_command=before_first_step",
        R"(controller.sensing.sensors=[{of="load",scale=0.05,delay_s=0.04},{of="speed",dead_time_s=0.03}])"}},
      {"modulated_late",
       "authors/supg",
       "quadruped",
       {modulation + R"(sensors=["pitch","torque.knee","command_speed"])", modulation + "rate=1",
        modulation + "shape=1", "command.kind=random",
        R"(controller.sensing.sensors=[{of="pitch",delay_s=0.03},{of="touch",delay_s=0.02,dead_time_s=0.04}])"}},
      {"modulated_by_torque",
       "paper/supg",
       "hexapod",
       {contact + "source=torque", contact + "threshold=1",
        modulation + R"(sensors=["roll","heading_error"])", modulation + "rate=1", modulation + "shape=0.5",
        "controller.sensing.heading.lead_rad=0.1", "command.kind=random"}},
      {"mixed_late",
       "authors/supg",
       "hexapod",
       {"controller.kind=mixed", "command.kind=random", "cppn.linear=identity",
        R"(controller.sensing.sensors=[{of="command_turn",scale=2.0,delay_s=0.1},{of="touch",dead_time_s=0.05}])"}},
      {"mixed_by_shock",
       "authors/supg",
       "quadruped",
       {"controller.kind=mixed", "controller.substrate=auto", contact + "source=shock",
        contact + "threshold=5", "command.kind=random", "cppn.linear=identity"}},
      {"mixed_by_tracking",
       "authors/supg",
       "quadruped",
       {"controller.kind=mixed", "controller.substrate=auto", contact + "source=tracking",
        contact + "threshold=0.05", "command.kind=random", "cppn.linear=identity"}},
  };
}

Champion evolve(const Sample& sample) {
  if (!sample.file.empty()) {
    Champion champion = load_champion(champion_at(sample.file));
    champion.problem.robot.fall_height_m = -1.0;
    return champion;
  }
  const TemporaryFolder scratch;
  Overrides overrides{.assignments = {"engine=batch", "population.size=40", "trial.duration_s=1"},
                      .seed = 7,
                      .generations = 4};
  const bool automatic = sample.robot != "quadruped";
  if (automatic) {
    io::write_file(scratch / "robot.json", robot_file_text(robot_called(sample.robot)));
    overrides.assignments.push_back("robot=" + (scratch / "robot.json").string());
    if (std::ranges::count(sample.assignments, "controller.kind=oscillators") == 0)
      overrides.assignments.emplace_back("controller.substrate=auto");
  }
  overrides.assignments.insert(overrides.assignments.end(), sample.assignments.begin(),
                               sample.assignments.end());
  const Config config =
      load_config(std::string(AMBLE_SOURCE_DIR) + "/configs/" + sample.preset + "-objective.toml", overrides);
  Listener listener;
  Run::start(scratch / "run", config, 1).execute(listener, listener.stop);
  Champion champion = load_champion(RunPaths(scratch / "run").best_champion());
  champion.problem.robot.fall_height_m = -1.0;
  return champion;
}

}  // namespace amble::tests
