#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "amble/experiment/problem.hpp"
#include "amble/morphology/mjcf_writer.hpp"
#include "amble/morphology/model_file.hpp"
#include "bench/benches.hpp"
#include "bench/walkers.hpp"
#include "bench/workload.hpp"

namespace amble::bench {
namespace {

constexpr int steps = 300;

/// All joints swing through their range, legs a quarter apart: the same targets for every engine.
void set_targets(const robot::RobotSpec& robot, int step, LaneArray& targets_rad) {
  for (int joint = 0; joint < targets_rad.rows(); ++joint) {
    const auto& spec = robot.joints[static_cast<std::size_t>(joint)];
    const double phase = 2.0 * 3.14159265358979 * (0.01 * step + 0.25 * (joint / 3));
    const double target =
        0.5 * (spec.lower_rad + spec.upper_rad) + 0.3 * (spec.upper_rad - spec.lower_rad) * std::sin(phase);
    for (int lane = 0; lane < targets_rad.lanes(); ++lane)
      targets_rad.at(joint, lane) = static_cast<float>(target);
  }
}

/// Fills the targets of all lanes at a step.
using Targets = std::function<void(int step, LaneArray& targets_rad)>;

/// Of which stretches of time a speed is.
struct Stretches {
  int walkers = 1;          ///< that take turns: each stretch has all of them
  bool in_threads = false;  ///< others do the same at the same time: one long stretch, without a choice
};

/// Seconds per call of `round`.
double seconds_per_round(const std::function<void()>& round, Stretches stretches) {
  if (stretches.in_threads) return seconds_per_call(round, 1.5, 1);
  if (stretches.walkers == 1) return seconds_per_call(round);
  const auto all = [&] {
    for (int walker = 0; walker < stretches.walkers; ++walker) round();
  };
  return seconds_per_call(all, 0.0, 12) / stretches.walkers;
}

Targets swing(const robot::RobotSpec& robot) {
  return [&robot](int step, LaneArray& targets_rad) { set_targets(robot, step, targets_rad); };
}

/// Robot-steps per second of an engine on one core, all lanes busy.
double steps_per_s(physics::Engine& engine, int joints, const Targets& targets, Stretches stretches = {}) {
  LaneArray targets_rad(joints, engine.lanes());
  const auto round = [&] {
    for (int lane = 0; lane < engine.lanes(); ++lane) engine.place(lane);
    for (int step = 0; step < steps; ++step) {
      targets(step, targets_rad);
      engine.step(targets_rad);
    }
  };
  return steps * engine.lanes() / seconds_per_round(round, stretches);
}

double steps_per_s(const char* name, const robot::RobotSpec& robot, const Targets& targets,
                   Stretches stretches = {}) {
  return steps_per_s(*physics::make_engine(name, robot, {}), static_cast<int>(robot.joints.size()), targets,
                     stretches);
}

/// Changes every quarter of a second: as many arrays of targets as stay in the cache.
Targets quarter_swing(const robot::RobotSpec& robot) {
  return [&robot](int step, LaneArray& targets_rad) { set_targets(robot, step / 25 * 25, targets_rad); };
}

/// Robot-steps per second of many robots in the batch engine, on one core: all take a step before any takes
/// the next.
double many_steps_per_s(const robot::RobotSpec& robot, int robots) {
  std::vector<std::unique_ptr<physics::Engine>> engines;
  for (int first = 0; first < robots; first += engines.back()->lanes())
    engines.push_back(physics::make_engine("batch", robot, {}));
  LaneArray targets_rad(static_cast<int>(robot.joints.size()), engines.front()->lanes());
  const Targets targets = quarter_swing(robot);
  const auto round = [&] {
    for (const auto& engine : engines)
      for (int lane = 0; lane < engine->lanes(); ++lane) engine->place(lane);
    for (int step = 0; step < steps; ++step) {
      targets(step, targets_rad);
      for (const auto& engine : engines) engine->step(targets_rad);
    }
  };
  return static_cast<double>(steps) * robots / seconds_per_call(round, 0.0, 5);
}

double steps_per_s(const char* name, const robot::RobotSpec& robot) {
  return steps_per_s(name, robot, swing(robot));
}

/// The same of MuJoCo by itself: mj_step with its own soft contacts and options, but for the limit of 20
/// iterations, and a damped servo with the same limits of torque. The engine "mujoco" is slower, because it
/// solves ODE's stiffer equations.
double mj_steps_per_s(const robot::RobotSpec& robot, const Targets& targets, Stretches stretches = {},
                      double timestep_s = physics::EngineSettings{}.timestep_s) {
  const auto mjcf = morphology::write_mjcf(robot);
  static std::mutex compiling;  // MuJoCo's compiler is not for several threads at once
  const auto owned = [&] {
    const std::lock_guard lock(compiling);
    return morphology::compile_mjcf(mjcf.text, "bench");
  }();
  mjModel* const model = owned.get();
  model->opt.timestep = timestep_s;
  model->opt.iterations = 20;
  const std::unique_ptr<mjData, decltype(&mj_deleteData)> data(mj_makeData(model), mj_deleteData);
  LaneArray targets_rad(static_cast<int>(robot.joints.size()), 1);
  const auto round = [&] {
    mj_resetData(model, data.get());
    for (int step = 0; step < steps; ++step) {
      targets(step, targets_rad);
      for (std::size_t place = 0; place < mjcf.joints.size(); ++place) {
        const int joint = mjcf.joints[place], dof = model->jnt_dofadr[place + 1];
        const double error_rad =
            static_cast<double>(targets_rad.at(joint, 0)) - data->qpos[model->jnt_qposadr[place + 1]];
        const auto& servo = robot.joints[static_cast<std::size_t>(joint)].servo;
        constexpr double damping_nm_s_per_rad = 1.0;
        const double torque_nm = damping_nm_s_per_rad * (servo.gain_per_s * error_rad - data->qvel[dof]);
        data->qfrc_applied[dof] = std::clamp(torque_nm, -servo.max_torque_nm, servo.max_torque_nm);
      }
      mj_step(model, data.get());
    }
  };
  return steps / seconds_per_round(round, stretches);
}

/// The sum of what as many threads as there are processors measure at once, each with robots of its own.
double on_all_processors(const std::function<double(Stretches)>& rate) {
  std::vector<std::future<double>> threads;
  for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
    threads.push_back(std::async(std::launch::async, rate, Stretches{.in_threads = true}));
  double sum = 0.0;
  for (auto& thread : threads) sum += thread.get();
  return sum;
}

void measure_threads(const std::string& name, const robot::RobotSpec& robot, std::vector<Figure>& figures) {
  const auto batch_rate = [&](Stretches stretches) {
    return steps_per_s("batch", robot, quarter_swing(robot), stretches);
  };
  const auto mujoco_rate = [&](Stretches stretches) {
    return mj_steps_per_s(robot, quarter_swing(robot), stretches);
  };
  const double batch = on_all_processors(batch_rate), mujoco = on_all_processors(mujoco_rate);
  const std::string what = fmt::format("{} threads, {}", std::thread::hardware_concurrency(), name);
  figures.push_back({"batch_robot_steps_per_s_threads_" + name, batch, "1/s", what});
  figures.push_back({"mujoco_robot_steps_per_s_threads_" + name, mujoco, "1/s",
                     what + ", mj_step alone, a simulation in each thread"});
  figures.push_back({"batch_vs_mujoco_threads_" + name, batch / mujoco, "1", what});
  without_avx512([&] {
    const double narrow = on_all_processors(batch_rate);
    figures.push_back(
        {"batch_vs_mujoco_threads_" + name + "_avx2", narrow / mujoco, "1", what + ", without AVX-512"});
  });
}

/// One engine of one lane takes the walkers one after the other.
Targets one_by_one(const Walkers& walkers) {
  return [&walkers, walker = -1](int step, LaneArray& targets_rad) mutable {
    if (step == 0) walker = (walker + 1) % walker_count;
    const LaneArray& all = walkers.targets_rad[static_cast<std::size_t>(step)];
    for (int joint = 0; joint < targets_rad.rows(); ++joint) targets_rad.at(joint, 0) = all.at(joint, walker);
  };
}

double walker_us(const Walkers& walkers) {
  return 1e6 / steps_per_s("batch", walkers.robot, [&](int step, LaneArray& targets_rad) {
           targets_rad = walkers.targets_rad[static_cast<std::size_t>(step)];
         });
}

/// What one step of the authors' robot takes, without and per contact: the former from executed instructions,
/// the latter added up from the source (docs/BATCH.md). A fused multiply-add is two.
constexpr double step_flop = 13900.0, contact_flop = 2100.0;

void measure_walkers(std::vector<Figure>& figures) {
  const Walkers walkers = evolve_walkers(steps);
  const Stretches by_turns{.walkers = walker_count};
  const double ode_us = 1e6 / steps_per_s("ode", walkers.robot, one_by_one(walkers), by_turns),
               mujoco_us = 1e6 / mj_steps_per_s(walkers.robot, one_by_one(walkers), by_turns);
  const double flop = step_flop + contact_flop * walkers.mean_contacts;
  const auto tell = [&](const std::string& suffix, const std::string& note) {
    const double us = walker_us(walkers);
    figures.push_back(
        {"batch_us_per_step_walkers" + suffix, us, "us", "per robot, sixteen different SUPGs" + note});
    figures.push_back(
        {"batch_vs_ode_walkers" + suffix, ode_us / us, "1", "steps per second, the same walkers" + note});
    figures.push_back(
        {"batch_vs_mujoco_walkers" + suffix, mujoco_us / us, "1", "mj_step, the same walkers" + note});
    figures.push_back({"batch_peak_share" + suffix, flop / (us * 1e-6 * peak_flop_per_s()), "1",
                       "of the core's fused multiply-adds" + note});
  };
  tell("", "");
  without_avx512([&] { tell("_avx2", ", without AVX-512"); });
}

}  // namespace

void measure_robots(std::vector<Figure>& figures) {
  const auto authors = experiment::load_robot_file(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
  for (const int robots : {16, 1024, 4096})
    figures.push_back({fmt::format("batch_robot_steps_per_s_{}", robots), many_steps_per_s(authors, robots),
                       "1/s", "one core, authors' quadruped, one step after the other of all"});
  figures.push_back({"mujoco_robot_steps_per_s", mj_steps_per_s(authors, quarter_swing(authors)), "1/s",
                     "one core, authors' quadruped, mj_step alone, at most 20 iterations"});
  measure_threads("quadruped", authors, figures);
  for (const std::string name : {"biped", "hexapod", "octopod"}) {
    const auto robot =
        experiment::load_robot_file(fmt::format("{0}/robots/{1}/{1}.toml", AMBLE_SOURCE_DIR, name));
    const double batch = steps_per_s("batch", robot, quarter_swing(robot)),
                 mujoco = mj_steps_per_s(robot, quarter_swing(robot));
    const std::string what =
        fmt::format("one core, {} joints, {} legs", robot.joints.size(), robot.legs.size());
    figures.push_back({"batch_robot_steps_per_s_" + name, batch, "1/s", what});
    figures.push_back({"batch_vs_mujoco_" + name, batch / mujoco, "1", what + ", mj_step alone"});
    without_avx512([&] {
      figures.push_back({"batch_vs_mujoco_" + name + "_avx2",
                         steps_per_s("batch", robot, quarter_swing(robot)) / mujoco, "1",
                         what + ", the same without AVX-512"});
    });
    if (name == "hexapod") measure_threads(name, robot, figures);
  }
}

void measure_config(const std::string& config_file, std::vector<Figure>& figures) {
  const auto config = experiment::load_config(config_file, {});
  const auto problem = experiment::Problem::make(config, experiment::load_robot(config));
  const robot::RobotSpec& robot = problem.robot;
  const int joints = static_cast<int>(robot.joints.size());
  const Targets targets = quarter_swing(robot);
  const auto engine_rate = [&](Stretches stretches) {
    return steps_per_s(*problem.make_engine(), joints, targets, stretches);
  };
  const auto mujoco_rate = [&](Stretches stretches) {
    return mj_steps_per_s(robot, targets, stretches, problem.trial.timestep_s);
  };
  const std::string what = fmt::format("{}, {} joints, {} legs, steps of {:g} s", robot.name, joints,
                                       robot.legs.size(), problem.trial.timestep_s);
  const std::string threads = fmt::format("{} threads, ", std::thread::hardware_concurrency()) + what;
  const double one = engine_rate({}), one_mujoco = mujoco_rate({}), all = on_all_processors(engine_rate),
               all_mujoco = on_all_processors(mujoco_rate);
  figures.push_back({problem.engine + "_robot_steps_per_s", one, "1/s", "one core, " + what});
  figures.push_back({problem.engine + "_robot_steps_per_s_threads", all, "1/s", threads});
  figures.push_back({"mujoco_robot_steps_per_s", one_mujoco, "1/s", "mj_step alone, one core, " + what});
  figures.push_back({"mujoco_robot_steps_per_s_threads", all_mujoco, "1/s",
                     "mj_step alone, a simulation in each thread, " + threads});
  figures.push_back({problem.engine + "_vs_mujoco", one / one_mujoco, "1", "one core, " + what});
  figures.push_back({problem.engine + "_vs_mujoco_threads", all / all_mujoco, "1", threads});
}

void measure_physics(std::vector<Figure>& figures) {
  const auto paper = experiment::load_robot_file(AMBLE_SOURCE_DIR "/robots/quadruped/paper.toml");
  const auto authors = experiment::load_robot_file(AMBLE_SOURCE_DIR "/robots/quadruped/authors.toml");
  const double ode = steps_per_s("ode", paper), mujoco = mj_steps_per_s(paper, swing(paper)),
               batch = steps_per_s("batch", paper);
  figures.push_back({"raw_steps_per_s_ode", ode, "1/s", "one core, paper's quadruped, dWorldStep"});
  figures.push_back({"raw_steps_per_s_mujoco", mujoco, "1/s",
                     "one core, paper's quadruped, mj_step alone, at most 20 iterations"});
  figures.push_back({"raw_steps_per_s_mujoco_referee", steps_per_s("mujoco", paper), "1/s",
                     "one core, the engine \"mujoco\", which solves ODE's equations"});
  figures.push_back({"raw_steps_per_s_batch", batch, "1/s", "one core, paper's quadruped"});
  figures.push_back({"batch_vs_ode_raw", batch / ode, "1", "steps per second, paper's quadruped"});
  figures.push_back({"batch_vs_mujoco_raw", batch / mujoco, "1", "steps per second, paper's quadruped"});
  const double ode_authors = steps_per_s("ode", authors);
  figures.push_back({"batch_vs_ode_raw_authors", steps_per_s("batch", authors) / ode_authors, "1",
                     "steps per second, authors' quadruped"});
  without_avx512([&] {
    figures.push_back(
        {"batch_vs_ode_raw_avx2", steps_per_s("batch", paper) / ode, "1", "the same without AVX-512"});
    figures.push_back({"batch_vs_ode_raw_authors_avx2", steps_per_s("batch", authors) / ode_authors, "1",
                       "the same without AVX-512"});
  });
  measure_walkers(figures);
}

}  // namespace amble::bench
