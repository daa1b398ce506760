#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "amble/cli/help.hpp"
#include "amble/cli/messages.hpp"
#include "amble/cli/options.hpp"
#include "amble/cli/outputs.hpp"
#include "amble/cli/stop_signal.hpp"
#include "amble/core/hash.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/gait_observer.hpp"
#include "amble/experiment/given_damage.hpp"
#include "amble/experiment/idle_settings.hpp"
#include "amble/experiment/problem/episode_set.hpp"
#include "amble/experiment/problem/live_inputs.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/experiment/run_folder.hpp"
#include "amble/experiment/steering.hpp"
#include "amble/figures/steering_figure.hpp"
#include "amble/gait/report_text.hpp"
#include "amble/io/file.hpp"
#include "amble/io/text.hpp"
#include "amble/motion/recorded_trial.hpp"
#include "amble/record/frame_codec.hpp"

namespace amble::cli {
namespace {

struct TrialOptions {
  std::filesystem::path champion;
  std::optional<double> seconds;
  std::optional<std::string> engine;
  std::optional<std::filesystem::path> record;
  std::optional<std::uint32_t> episode, unseen;
  std::optional<std::filesystem::path> ground;
  std::optional<std::string> damage, command, steering;
  std::optional<std::filesystem::path> inputs, draw;
  presentation::TrialChoice disturbance;
};

/// The largest number of an earlier version: episodes, and from most_evolution_episodes on unseen ones.
constexpr std::uint32_t most_old_number =
    experiment::episode_number(experiment::EpisodeSet::unseen, experiment::most_unseen_episodes - 1);

void take_old_number(TrialOptions& options, std::string_view option, std::uint32_t number) {
  constexpr std::uint32_t first_unseen = experiment::episode_number(experiment::EpisodeSet::unseen, 0);
  const bool unseen = number >= first_unseen;
  const std::uint32_t of_set = unseen ? number - first_unseen : number;
  print_message(fmt::format("{} {}: for {}, now written --{} {}\n", option, number,
                            unseen ? "a trial that evolution has not met" : "an episode",
                            unseen ? "unseen" : "episode", of_set));
  options.episode.reset();
  (unseen ? options.unseen : options.episode) = of_set;
}

/// `--noise 3`, which once meant an episode, and `--episode 1003`, which meant `--unseen 3`.
void take_old_numbers(TrialOptions& options) {
  auto& noise = options.disturbance.noise;
  std::error_code error;
  std::uint32_t number = 0;
  if (options.episode && *options.episode >= experiment::most_evolution_episodes)
    take_old_number(options, "--episode", *options.episode);
  if (!noise || std::filesystem::exists(*noise, error)) return;
  if (!CLI::detail::lexical_cast(noise->string(), number) || number > most_old_number) return;
  if (options.unseen || options.disturbance.trials)
    fail(ExitCode::bad_input, "--noise {}: once meant one trial, and is not for {}; expected a config file",
         number, options.unseen ? "--unseen" : "--trials");
  take_old_number(options, "--noise", number);
  noise.reset();
}

/// Puts a champion on the ground of a config, or gives it the damage of a config.
template <typename Change>
void change_as_in(const std::filesystem::path& path, Change change) {
  const auto config = experiment::load_config(path, {});
  try {
    change(config);
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
}

/// `spec`: as experiment::damage_of() takes it.
void damage_as_in(const std::string& spec, std::optional<double> seconds, experiment::Champion& champion) {
  const auto give = [&] {
    const damage::Settings damage = experiment::damage_of(spec);
    experiment::check_begins(damage, seconds.value_or(champion.problem.trial.duration_s));
    champion.problem.set_damage(damage);
  };
  std::error_code error;
  if (std::filesystem::exists(spec, error))
    change_as_in(spec, [&](const experiment::Config&) { give(); });
  else
    give();
}

/// The [command] of a config. Throws UserError with its place if it says nothing.
void command_as_in_config(const std::filesystem::path& path, experiment::Champion& champion) {
  change_as_in(path, [&](const experiment::Config& config) {
    if (config.command.kind == trial::CommandKind::none)
      fail_setting({"command.kind"},
                   "command.kind is none; expected fixed or random, or commands in one line in place of the "
                   "file, e.g. --command \"0.4,0; 0.4,0.5; 0,0\"");
    champion.problem.set_commands(config.command);
  });
}

/// `spec`: a config file, or commands in one line.
void command_as_in(const std::string& spec, std::optional<double> seconds, experiment::Champion& champion) {
  if (seconds) champion.problem.trial.duration_s = *seconds;
  std::error_code error;
  if (std::filesystem::exists(spec, error))
    command_as_in_config(spec, champion);
  else if (spec.ends_with(".toml"))
    fail(ExitCode::bad_input, "--command: there is no file {}", io::printable(spec));
  else
    experiment::tell(champion.problem, spec, "--command");
  if (const auto untold = experiment::untold_commands(champion.problem))
    print_message(fmt::format("--command: {}; for more: --seconds\n", *untold));
}

/// What it is told, and how it is steered by hand.
void tell(const TrialOptions& options, experiment::Champion& champion) {
  if (options.command) command_as_in(*options.command, options.seconds, champion);
  if (options.steering && champion.problem.command.kind == trial::CommandKind::none)
    fail(ExitCode::bad_input, "--steering: {} was told nothing in its evolution; expected --command as well",
         options.champion.string());
  if (options.steering) experiment::steer_by_hand(champion.problem, *options.steering, "--steering");
  if (!options.command) return;
  if (const auto unheard = experiment::unheard_commands(champion.problem))
    print_message(fmt::format("--command: {}\n", *unheard));
}

/// What the champion typically does in trials like this one.
void print_typical(const experiment::Champion& champion, const TrialOptions& options) {
  experiment::Problem problem = champion.problem;
  if (options.seconds) problem.trial.duration_s = *options.seconds;
  if (options.engine) problem.engine = *options.engine;
  problem.trial.validate();
  auto trials = presentation::typical_trials(problem, champion.seed, options.disturbance, processors());
  const auto results = trials.run(champion.genome, stop_signal());
  if (!results) fail(ExitCode::interrupted, "stopped before the end of the trials");
  fmt::print("{}\n\nits trial without noise:\n",
             experiment::typical_text(experiment::typical_distance(*results), {}, problem.trial.duration_s,
                                      trials.level().under()));
}

std::string followed_text(const experiment::Tracking& tracking) {
  if (!tracking.speed_error_m_s) return "followed to 0 of 1: it ended within the first second";
  return fmt::format("followed to {:.3f} of 1; wrong by {:.3f} m/s and {:.3f} rad/s (mean over seconds)",
                     tracking.tracking, *tracking.speed_error_m_s, *tracking.turn_error_rad_s);
}

/// Where there is no recording that is wanted, `scratch` is one.
void prepare_to_draw(const TrialOptions& options, const experiment::Champion& champion,
                     std::optional<io::ScratchFile>& scratch) {
  if (champion.problem.command.kind == trial::CommandKind::none)
    fail(ExitCode::bad_input, "--draw: {} was told nothing in its evolution; expected --command as well",
         options.champion.string());
  stop_signal();  // from here on what is in the folder for temporary files is removed
  if (!options.record) scratch.emplace("walk.rec");
}

/// What it was told beside what it did.
void draw_steering(const std::filesystem::path& recording, const std::string& note,
                   const std::filesystem::path& out) {
  const auto recorded = motion::read_recorded_trial(recording);
  if (recorded.motion.frames() == 0) fail(ExitCode::bad_input, "--draw: it broke down in its first step");
  io::write_output(out, figures::steering_svg(recorded.robot, recorded.motion, note));
}

/// A live session of a page, with all that was done to the robot.
ExitCode run_again(const std::filesystem::path& champion_path, const std::filesystem::path& inputs_path) {
  const std::string text = io::read_file(champion_path);
  const auto session = experiment::parse_inputs(io::read_file(inputs_path), inputs_path.string());
  if (session.champion != hex(hash_text(text)))
    fail(ExitCode::bad_input, "{}: it is of another champion than {}", inputs_path.string(),
         champion_path.string());
  const auto champion = experiment::parse_champion_for(session.engine, text, champion_path.string());
  const auto again = experiment::replay_live(champion, session);
  fmt::print("engine    {}\nsteps     {}\ninputs    {}\ndistance  {:.3f} m\nat last   {}\n", session.engine,
             again.steps, session.inputs.size(), again.distance_m, again.fallen ? "fallen" : "upright");
  if (!again.first_difference) {
    fmt::print("bits      the same in every step\n");
    return ExitCode::ok;
  }
  fmt::print("bits      other ones from step {} on\n", *again.first_difference);
  return ExitCode::differs;
}

ExitCode run_trial(const TrialOptions& options) {
  const auto path = experiment::champion_at(options.champion);
  if (options.inputs) return run_again(path, *options.inputs);
  check_distinct({{"--record", options.record.value_or("")}, {"--draw", options.draw.value_or("")}});
  if (options.draw) check_drawing("--draw", *options.draw);
  auto champion = experiment::load_champion(path);
  check_seconds(options.seconds, champion.problem.trial);
  if (options.ground)
    change_as_in(*options.ground,
                 [&](const experiment::Config& config) { champion.problem.set_ground(config.ground); });
  if (options.damage) damage_as_in(*options.damage, options.seconds, champion);
  tell(options, champion);
  if (options.record) check_output(*options.record, record::recording_magic, "a recording");
  std::optional<io::ScratchFile> scratch;
  if (options.draw) prepare_to_draw(options, champion, scratch);
  if (options.record) io::make_folder(options.record->parent_path());
  experiment::GaitObserver gait(champion.problem, {});
  experiment::ReplayOptions how{.seconds = options.seconds,
                                .engine = options.engine,
                                .record = scratch ? scratch->path() : options.record,
                                .origin = path.string(),
                                .observer = &gait,
                                .trace = false,
                                .noise = {}};
  const bool one_episode = options.episode || options.unseen;
  if (one_episode) {
    if (options.disturbance.noise)
      champion.problem.noise = presentation::level_of(champion.problem, options.disturbance).noise;
    if (!champion.problem.trials_vary())
      fail(ExitCode::bad_input, "--{}: {} was evolved without noise, and from one place",
           options.episode ? "episode" : "unseen", path.string());
    how.noise = options.episode ? champion.scenario_key(*options.episode)
                                : champion.unseen_scenario_key(*options.unseen);
  }
  if (!one_episode && !options.disturbance.undisturbed) print_typical(champion, options);
  const auto replay = experiment::replay(champion.problem, champion.genome, how, stop_signal());
  if (!replay) fail(ExitCode::interrupted, "stopped before the end of the trial");
  const auto& result = replay->result;
  const auto& home = champion.problem.engine;
  const auto& judge = options.engine.value_or(home);
  fmt::print("engine    {}{}\n", judge, judge == home ? "" : fmt::format(" (evolved in {})", home));
  fmt::print("outcome   {}\nupright   {:.2f} s\ndistance  {:.3f} m\nspeed     {:.3f} m/s\n",
             record::outcome_names[to_index(result.outcome)], result.seconds, result.distance_m,
             result.distance_m / result.seconds);
  if (result.tracking) fmt::print("commands  {}\n", followed_text(*result.tracking));
  if (!replay->events.empty()) {
    fmt::print("events   ");
    for (const auto& [name, count] : replay->events) fmt::print(" {} {}", name, count);
    fmt::print("\n");
  }
  fmt::print("{}", gait::report_summary(gait.finish(result.outcome)));
  if (options.record) fmt::print("recorded  {}\n", options.record->string());
  if (options.draw) {
    draw_steering(*how.record, followed_text(result.tracking.value()), *options.draw);
    fmt::print("drawn     {}\n", options.draw->string());
  }
  return ExitCode::ok;
}

/// Where it walks, with what damage, and what it is told.
void add_surroundings(CLI::App& command, TrialOptions& options) {
  command.add_option("--ground", options.ground,
                     "Walk on the [ground] of this config (default: as in its evolution)");
  command
      .add_option("--damage", options.damage,
                  "With the robot damaged as in the [damage] of this config, or as "
                  "KIND:NAME[=NUMBER][@SECONDS] says, e.g. "
                  "missing:FL,weak:FR_knee=0.3@5; none: intact (default: as in its evolution)")
      ->type_name("DAMAGE|FILE");
  command
      .add_option("--command", options.command,
                  "Told to do this: SPEED,TURN[,SECONDS]; … in m/s, rad/s to the left and s, or the "
                  "[command] of this config (default: as in its evolution)")
      ->type_name("COMMANDS|FILE");
  command
      .add_option("--steering", options.steering,
                  "Steered by hand: [controller.differential] in one line, e.g. \"turn_gain = 1.5, "
                  "full_speed_m_s = 0.4\" (default: as in its evolution; docs/STEERING.md)")
      ->type_name("GAINS");
  command.add_option("--draw", options.draw,
                     "Draw what it is told beside what it does into this file: both paths from above, speed "
                     "and turn over time (SVG)");
}

}  // namespace

void add_trial(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "trial", "Let a champion walk again, for as long as you like: what it typically does, and one trial");
  auto options = std::make_shared<TrialOptions>();
  command->add_option("CHAMPION", options->champion, "Champion file, or run folder (its best champion)")
      ->required();
  command->add_option("--seconds", options->seconds, "Length of the trial, s (default: as in its evolution)")
      ->check(seconds_check());
  add_engine(*command, options->engine, "Physics engine (default: as in its evolution)");
  command->add_option("--record", options->record, "Write every step to this recording");
  add_disturbance(*command, options->disturbance);
  auto* const episode =
      command
          ->add_option("--episode", options->episode,
                       "Only one trial, disturbed as in this episode of its evaluation, from 0")
          ->check(between(0u, most_old_number));
  auto* const unseen =
      command
          ->add_option(
              "--unseen", options->unseen,
              "Only one trial, disturbed as evolution has not met it, or by --noise: which one, from 0")
          ->check(between(0u, experiment::most_unseen_episodes - 1))
          ->excludes(episode);
  for (const char* other : {"--level", "--trials", "--undisturbed"}) {
    episode->excludes(command->get_option(other));
    unseen->excludes(command->get_option(other));
  }
  episode->excludes(command->get_option("--noise"));
  add_surroundings(*command, *options);
  auto* const inputs = command->add_option("--inputs", options->inputs,
                                           "Run a live session of a page again, with all that was done to "
                                           "the robot: the file that the page saved");
  for (const char* other :
       {"--seconds", "--engine", "--record", "--episode", "--unseen", "--ground", "--damage", "--command",
        "--steering", "--draw", "--level", "--noise", "--trials", "--undisturbed"})
    inputs->excludes(command->get_option(other));
  add_examples(*command, {{"amble trial runs/1", "what it typically does"},
                          {"amble trial runs/1 --command \"0.4,0; 0.4,0.5; 0,0\"", "straight, left, stop"},
                          {"amble trial runs/1 --command \"0.2,0.3; 0.2,-0.3\" --draw eight.svg",
                           "a picture of what it was told, and what it did"},
                          {"amble trial runs/1 --seconds 300 --engine ode", ""},
                          {"amble trial runs/1 --damage missing:FL", "with its front left leg missing"}});
  command->callback([options, &action] {
    action = [options] {
      take_old_numbers(*options);
      return run_trial(*options);
    };
  });
}

}  // namespace amble::cli
