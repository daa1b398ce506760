#include <fmt/format.h>
#include <gtest/gtest.h>

#include "amble/core/hash.hpp"
#include "amble/experiment/replay.hpp"
#include "amble/ground/kinds.hpp"
#include "tests/figures/golden.hpp"

// What GoldenRun's quadruped on the plane does not meet: other bodies, grounds, damages, pushes, scores. Only
// the batch engine, as there.
namespace amble::experiment {
namespace golden_trial_test {

/// A line of a trial of three seconds.
std::string line(const std::string& what, const Problem& problem, const neat::Genome& genome,
                 std::optional<trial::ScenarioKey> noise = {}) {
  const std::atomic<bool> never{false};
  ReplayOptions options{.seconds = 3.0, .engine = "batch"};
  options.noise = noise;
  const auto replayed = replay(problem, genome, options, never);
  if (!replayed) return what + ": stopped\n";
  std::string text =
      fmt::format("{}: {:.12g} m, score {:.12g}, {} steps, {}", what, replayed->result.distance_m,
                  replayed->result.value(), replayed->result.steps,
                  record::outcome_names[to_index(replayed->result.outcome)]);
  for (const auto& event : replayed->events) text += fmt::format(", {} {}", event.name, event.count);
  return text + ", " + hex(hash_span<std::uint32_t>(replayed->trace, 0)) + "\n";
}

std::string on_all_grounds(const Champion& champion) {
  std::string text;
  for (std::size_t kind = 0; kind < ground::kinds().size(); ++kind) {
    Problem problem = champion.problem;
    ground::Settings settings;
    settings.kind = ground::kinds()[kind].name;
    settings.height_m = 0.03;
    settings.length_m = 0.3;
    settings.slope_x = kind % 2 == 0 ? 0.05 : 0.0;
    settings.slope_y = kind % 3 == 0 ? -0.03 : 0.0;
    settings.friction = 0.5 + 0.1 * static_cast<double>(kind);
    settings.start_radius_m = 0.9;
    problem.set_ground(settings);
    text += line(settings.kind, problem, champion.genome);
  }
  return text;
}

std::string with_all_damages(const Champion& champion) {
  using damage::Kind;
  const robot::RobotSpec& robot = champion.problem.robot;
  const std::string leg = robot.legs[1].name, joint = robot.joints[2].name;
  const damage::Part parts[] = {{.kind = Kind::missing, .leg = leg},
                                {.kind = Kind::numb, .leg = leg},
                                {.kind = Kind::locked, .joint = joint, .angle_rad = 0.1},
                                {.kind = Kind::slack, .joint = joint},
                                {.kind = Kind::weak, .joint = joint, .share = 0.3},
                                {.kind = Kind::payload, .mass_kg = 0.4, .x_m = 0.1, .y_m = 0.05}};
  std::string text;
  for (damage::Part part : parts)
    for (const double from_s : {0.0, 1.5}) {
      part.from_s = from_s;
      Problem problem = champion.problem;
      const auto name = damage::kind_names[static_cast<std::size_t>(part.kind)];
      try {
        problem.set_damage({{part}});
        text += line(fmt::format("{} from {} s", name, from_s), problem, champion.genome);
      } catch (const UserError& error) {
        text += fmt::format("{} from {} s: {}\n", name, from_s, error.what());
      }
    }
  return text;
}

std::string by_all_scores(const Champion& champion) {
  std::string text;
  for (const char* quantity : {"distance", "forward", "heading", "sideways", "turn", "speed_kept", "energy",
                               "economy", "uprightness", "upright_time", "duty_factor", "phase", "height"}) {
    Problem problem = champion.problem;
    problem.score.terms = {{.quantity = quantity}};
    problem.score.heading_deg = 20.0;
    text += line(quantity, problem, champion.genome);
  }
  return text;
}

TEST(GoldenTrial, OfTheGallerysChampionsMatches) {
  std::map<std::string, std::string> texts;
  for (const std::string name : {"hexapod", "biped", "octopod", "servo"}) {
    const Champion champion = load_champion(AMBLE_SOURCE_DIR "/robots/" + name + "/champion.json");
    std::string text = on_all_grounds(champion) + with_all_damages(champion) + by_all_scores(champion);
    if (champion.problem.noise.any())
      text += line("noise", champion.problem, champion.genome, champion.unseen_scenario_key(0));
    texts[name + "-trials.txt"] = text;
  }
  tests::expect_golden(texts, {{"biped-trials.txt", "a7a1d1e3bb0dd157"},
                               {"hexapod-trials.txt", "93be53c0e262cb10"},
                               {"octopod-trials.txt", "68eaef8872b0781a"},
                               {"servo-trials.txt", "85970ba1a87db023"}});
}

}  // namespace golden_trial_test
}  // namespace amble::experiment
