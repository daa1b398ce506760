#include <pybind11/stl.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/experiment/champion_choice.hpp"
#include "amble/experiment/checkpoint.hpp"
#include "amble/experiment/generation.hpp"
#include "amble/experiment/run_files.hpp"
#include "amble/io/text.hpp"
#include "amble/neat/genome_json.hpp"
#include "amble/physics/engine.hpp"
#include "python/bind.hpp"
#include "python/readable.hpp"
#include "python/task.hpp"

namespace amble::python {
namespace {

/// Ask and tell.
struct OpenSearch {
  explicit OpenSearch(LoadedConfig loaded) : task(std::make_shared<Task>(std::move(loaded))) {
    check_search(task->config.value, task->problem());
    state.emplace(task->config.value, task->problem());
  }

  /// The logs as their files would be (search::Strategy::logs). To be called with the lock.
  const std::vector<std::string>& grown_logs() {
    logs.resize(state->strategy->logs().size());
    for (std::size_t i = 0; i < logs.size(); ++i) logs[i] += state->strategy->take_log_growth(i);
    return logs;
  }

  /// Where ask() gave a genome, at last if it did so again: round and index. To be called with the lock.
  std::optional<std::pair<int, int>> origin(const neat::Genome& genome) const {
    const auto now = state->strategy->ask();
    if (const auto at = std::ranges::find(now, genome); at != now.end())
      return std::pair(state->strategy->round(), static_cast<int>(at - now.begin()));
    for (std::size_t round = told.size(); round-- > 0;)
      if (const auto at = std::ranges::find(told[round], genome.hash()); at != told[round].end())
        return std::pair(static_cast<int>(round), static_cast<int>(at - told[round].begin()));
    return std::nullopt;
  }

  std::shared_ptr<Task> task;
  std::optional<experiment::RunState> state;
  bool has_asked = false;                        ///< for the genomes of this round, or was pickled
  std::vector<std::vector<std::uint64_t>> told;  ///< hashes of the genomes of each round that is over
  std::vector<std::string> logs;                 ///< as far as they have been taken
  /// Of the round in which it was pickled: a checkpoint has none.
  std::optional<std::pair<int, std::vector<std::pair<std::string, double>>>> pickled_metrics;
  CallLock lock;  ///< of state, told, logs and pickled_metrics
};

LoadedConfig seeded(const py::object& config, std::optional<std::int64_t> seed) {
  auto loaded = config_of(config);
  set_seed(loaded.value, seed);
  return loaded;
}

std::vector<neat::Genome> ask(OpenSearch& self) {
  const auto lock = self.lock.hold();
  const auto candidates = self.state->strategy->ask();
  self.has_asked = true;
  return {candidates.begin(), candidates.end()};
}

using Metrics = std::vector<std::pair<std::string, double>>;

/// To be called with the lock.
Metrics metrics_of(const OpenSearch& self) {
  const search::Strategy& strategy = *self.state->strategy;
  if (self.pickled_metrics && self.pickled_metrics->first == strategy.round())
    return self.pickled_metrics->second;
  Metrics metrics;
  for (const auto& [name, value] : strategy.metrics()) metrics.emplace_back(name, value);
  return metrics;
}

/// The rows of behaviours that a search compares; nothing for a search that compares none.
std::optional<py::array_t<float, py::array::c_style>> behaviours_of(const py::object& behaviour,
                                                                    py::ssize_t candidates,
                                                                    py::ssize_t length) {
  if (length == 0) return {};
  if (behaviour.is_none())
    throw py::value_error(fmt::format(
        "behaviour: this search compares behaviours; expected the shape ({}, {})", candidates, length));
  auto rows = numbers_of<float>(behaviour, "behaviour", {candidates, length});
  for (py::ssize_t i = 0; i < candidates * length; ++i)
    if (!std::isfinite(rows.data()[i]))
      throw py::value_error(fmt::format("behaviour[{}]: expected finite numbers", i / length));
  return rows;
}

void tell(OpenSearch& self, const py::object& fitness, const py::object& behaviour,
          const py::object& viable) {
  if (py::isinstance(fitness, py::module_::import("amble._evaluation").attr("Evaluation"))) {
    if (!behaviour.is_none() || !viable.is_none())
      throw py::type_error("tell: an Evaluation has its behaviour and viable already");
    const auto both = fitness.cast<py::tuple>();
    return tell(self, both[0], both[1], fitness.attr("viable"));
  }
  {
    const auto lock = self.lock.hold();
    if (!self.has_asked)
      throw py::value_error(fmt::format(
          "tell: round {} has not been asked for: expected ask() first, and one tell() for each round",
          self.state->strategy->round()));
  }
  const auto candidates = static_cast<py::ssize_t>(ask(self).size());
  const auto length = static_cast<py::ssize_t>(self.task->behaviour().length());
  const auto values = numbers_of<double>(fitness, "fitness", {candidates});
  for (py::ssize_t i = 0; i < candidates; ++i)
    if (!(std::isfinite(values.at(i)) && values.at(i) >= 0.0))
      throw py::value_error(
          fmt::format("fitness[{}] = {}: expected a finite number, at least 0", i, values.at(i)));
  const auto rows = behaviours_of(behaviour, candidates, length);
  const auto sound = mask_of(viable, candidates, "viable");
  std::vector<search::Evaluation> evaluations;
  for (py::ssize_t i = 0; i < candidates; ++i)
    evaluations.push_back(
        {.objective = values.at(i),
         .behaviour = rows ? std::span(rows->data(i, 0), to_index(length)) : std::span<const float>(),
         .viable = sound.empty() || sound[to_index(i)] != 0});
  const Unlocked unlocked;
  const auto lock = self.lock.hold();
  const auto genomes = self.state->strategy->ask();
  if (genomes.size() != evaluations.size())
    throw std::runtime_error("another thread has told the search meanwhile");
  std::vector<std::uint64_t> hashes;
  for (const neat::Genome& genome : genomes) hashes.push_back(genome.hash());
  self.state->strategy->tell(evaluations);
  self.told.push_back(std::move(hashes));
  self.has_asked = false;
}

/// Config, checkpoint, logs, as a run folder has them; and the hashes of what was told.
py::tuple pickled_search(OpenSearch& self) {
  std::string checkpoint;
  py::list logs, told;
  Metrics metrics;
  {
    const auto lock = self.lock.hold();
    for (const std::string& log : self.grown_logs()) logs.append(py::bytes(log));
    for (const auto& round : self.told)
      told.append(py::array_t<std::uint64_t>(static_cast<py::ssize_t>(round.size()), round.data()));
    checkpoint = experiment::checkpoint_bytes(self.task->config.value, {}, *self.state->strategy);
    metrics = metrics_of(self);
  }
  return py::make_tuple(self.task->config, py::bytes(checkpoint), logs, told, metrics);
}

std::unique_ptr<OpenSearch> unpickled_search(const py::tuple& state) {
  constexpr const char* what = "Search: its pickled state";
  if (state.size() != 5) throw py::value_error(std::string(what) + " is of another version");
  auto search = std::make_unique<OpenSearch>(state[0].cast<const LoadedConfig&>());
  search->has_asked = true;
  auto& strategy = *search->state->strategy;
  experiment::parse_checkpoint(state[1].cast<std::string>(), what, search->task->config.value, strategy);
  search->logs = state[2].cast<std::vector<std::string>>();
  search->told = state[3].cast<std::vector<std::vector<std::uint64_t>>>();
  search->pickled_metrics.emplace(strategy.round(), state[4].cast<Metrics>());
  if (search->logs.size() != strategy.logs().size())
    throw py::value_error(std::string(what) + " is of another search");
  for (std::size_t i = 0; i < search->logs.size(); ++i) {
    io::InputFile file(search->logs[i], what);
    strategy.restore_log(i, file, what);
  }
  return search;
}

/// A genome as the champion that a run would make of it: with its trials in the config's own objective.
ReadableChampion champion_of(OpenSearch& self, const neat::Genome& genome) {
  const Task& task = *self.task;
  checked_genomes(task, py::make_tuple(genome));
  std::optional<std::pair<int, int>> origin;
  {
    const auto lock = self.lock.hold();
    origin = self.origin(genome);
  }
  if (!origin)
    fail(ExitCode::bad_input,
         "genome: this search never gave it; expected one of ask(), as a champion names its round");
  std::optional<experiment::Champion> champion;
  Interruptible interruptible;
  interruptible.run([&] {
    experiment::StageTimes times;
    champion =
        experiment::try_champion(task.config.value, task.problem(),
                                 {.generation = origin->first, .index = origin->second, .genome = genome},
                                 jobs_of({}), times, interruptible.stop());
  });
  return {{}, std::move(champion).value()};
}

experiment::ToldGeneration evaluate(Task& task, Arena& arena, std::span<const neat::Genome> genomes,
                                    int generation, std::int64_t seed, int jobs,
                                    const std::atomic<bool>& stop) {
  const auto lock = arena.lock.hold(stop);
  if (!lock) return {};
  auto& evaluator = arena.evaluators[jobs];
  if (!evaluator || !evaluator->works_here())
    evaluator = std::make_unique<experiment::Evaluator>(arena.problem, task.behaviour().path(), jobs,
                                                        task.behaviour().measures());
  const auto all = experiment::evaluate_generation(*evaluator, arena.problem, task.config.value.evaluation,
                                                   arena.memory, seed, generation, genomes, stop);
  return all ? experiment::told(*all, task.behaviour()) : experiment::ToldGeneration{};
}

py::object evaluate_genomes(const py::object& on, const py::object& genomes,
                            std::optional<std::string> engine, std::optional<int> jobs,
                            std::optional<int> generation) {
  const auto task = task_of(on);
  int round = 0;
  if (py::isinstance<OpenSearch>(on)) {
    auto& search = on.cast<OpenSearch&>();
    const auto lock = search.lock.hold();
    round = search.state->strategy->round();
  }
  if (generation && (*generation < 0 || *generation >= experiment::most_generations))
    throw py::value_error(fmt::format("generation: {}: expected a whole number from 0 to {}", *generation,
                                      experiment::most_generations - 1));
  const auto all = checked_genomes(*task, genomes);
  const int workers = jobs_of(jobs);
  Arena& arena = task->in(engine);
  const auto n = static_cast<py::ssize_t>(all.size()),
             d = static_cast<py::ssize_t>(task->behaviour().length());
  experiment::ToldGeneration evaluated;
  if (n > 0) {
    Interruptible interruptible;
    interruptible.run([&] {
      evaluated = evaluate(*task, arena, all, generation.value_or(round), task->config.value.seed, workers,
                           interruptible.stop());
    });
  }
  py::array_t<double> objectives(n);
  py::array_t<float> behaviours({n, d});
  py::array_t<bool> viable(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const search::Evaluation& one = evaluated.evaluations[to_index(i)];
    objectives.mutable_at(i) = one.objective;
    viable.mutable_at(i) = one.viable;
    std::copy(one.behaviour.begin(), one.behaviour.end(), behaviours.mutable_data() + i * d);
  }
  return py::module_::import("amble._evaluation")
      .attr("Evaluation")(std::move(objectives), std::move(behaviours), std::move(viable));
}

/// Throws UserError for a key that to_dict() does not give.
void refuse_other_keys(const io::Json& found, const std::string& what,
                       std::initializer_list<std::string_view> keys) {
  for (const auto& item : found.items())
    if (std::ranges::find(keys, item.key()) == keys.end())
      fail(ExitCode::bad_file, "{}: unknown key '{}': expected {}", what, io::printable(item.key()),
           fmt::join(keys, ", "));
}

neat::Genome genome_from(const py::object& dict) {
  if (!py::isinstance<py::dict>(dict)) throw py::type_error("Genome: expected a dict");
  const auto json = to_json(dict, "Genome");
  auto genome = neat::genome_from_json(io::JsonView(json, "Genome"));
  refuse_other_keys(json, "Genome", {"nodes", "links"});
  for (std::size_t i = 0; i < genome.nodes.size(); ++i)
    refuse_other_keys(json["nodes"][i], fmt::format("Genome: nodes[{}]", i), {"id", "kind", "activation"});
  for (std::size_t i = 0; i < genome.links.size(); ++i)
    refuse_other_keys(json["links"][i], fmt::format("Genome: links[{}]", i),
                      {"innovation", "from", "to", "weight", "enabled"});
  neat::validate(genome, genome.count(neat::NodeKind::input), genome.count(neat::NodeKind::output), true);
  return genome;
}

py::object genome_dict(const neat::Genome& genome) {
  return to_python(neat::to_json(genome));
}

void bind_genome(py::module_& module) {
  py::class_<neat::Genome>(
      module, "Genome", R"(A CPPN as NEAT evolves it. Does not change; can be compared, hashed and pickled.)")
      .def(py::init(&genome_from), py::arg("dict"),
           "From what to_dict() gives. Raises Error naming the key, or the node or link, that is wrong.")
      .def("to_dict", genome_dict,
           R"({"nodes": [{"id", "kind", "activation"}, …], "links": [{"innovation", "from", "to",
"weight", "enabled"}, …]}, as in champion files.)")
      .def_property_readonly(
          "digest", [](const neat::Genome& self) { return fmt::format("{:016x}", self.hash()); },
          "Of all genes, weights to the bit: 16 hexadecimal digits.")
      .def("__eq__",
           [](const neat::Genome& self, const py::object& other) {
             return py::isinstance<neat::Genome>(other) && self == other.cast<const neat::Genome&>();
           })
      .def("__hash__", [](const neat::Genome& self) { return static_cast<std::int64_t>(self.hash() >> 1); })
      .def(py::pickle([](const neat::Genome& self) { return py::make_tuple(genome_dict(self)); },
                      [](const py::tuple& state) {
                        if (state.size() != 1) throw py::value_error("Genome: not its pickled state");
                        return genome_from(state[0]);
                      }))
      .def("__repr__", [](const neat::Genome& self) {
        return fmt::format("<amble.Genome {:016x}: {} nodes, {} links>", self.hash(), self.nodes.size(),
                           self.links.size());
      });
}

}  // namespace

std::shared_ptr<Task> task_of(const py::object& object) {
  if (py::isinstance<OpenSearch>(object)) return object.cast<const OpenSearch&>().task;
  if (py::isinstance<Task>(object)) return object.cast<std::shared_ptr<Task>>();
  return std::make_shared<Task>(config_of(object));
}

std::vector<neat::Genome> checked_genomes(const Task& task, const py::object& genomes) {
  const auto& problem = task.problem();
  std::vector<neat::Genome> all;
  for (const auto& item : py::iter(genomes)) {
    if (!py::isinstance<neat::Genome>(item))
      throw py::type_error(fmt::format("genomes[{}]: expected amble.Genome, found {}", all.size(),
                                       py::str(py::type::of(item).attr("__name__")).cast<std::string>()));
    all.push_back(item.cast<const neat::Genome&>());
    try {
      neat::validate(all.back(), problem.cppn_inputs(), problem.cppn_outputs(), problem.cppn.recurrent);
    } catch (const UserError& error) {
      fail(error.code(), "genomes[{}]: {}", all.size() - 1, error.what());
    }
  }
  return all;
}

void bind_search(py::module_& module) {
  bind_genome(module);
  py::class_<Task, std::shared_ptr<Task>>(
      module, "Problem", R"(What gives genomes their objective: a config and its robot, made ready once.

evaluate() takes it in place of a config, and then starts no workers and reads no robot anew.)")
      .def(
          py::init([](const py::object& config, std::optional<std::int64_t> seed) {
            return std::make_shared<Task>(seeded(config, seed));
          }),
          py::arg("config"), py::arg("seed") = py::none(),
          "config: Config or path. seed: of noise and ground. Raises Error if its parts do not fit together.")
      .def_property_readonly("config", [](const Task& self) { return self.config; })
      .def(py::pickle([](const Task& self) { return py::make_tuple(self.config); },
                      [](const py::tuple& state) {
                        if (state.size() != 1) throw py::value_error("Problem: not its pickled state");
                        return std::make_shared<Task>(state[0].cast<const LoadedConfig&>());
                      }))
      .def_property_readonly(
          "behaviour_length", [](const Task& self) { return self.behaviour().length(); },
          "Numbers in a behaviour, d; 0 unless the config's search compares behaviours.")
      .def_property_readonly(
          "inputs", [](const Task& self) { return self.problem().cppn_inputs(); },
          "Inputs of a genome's CPPN, without the bias.")
      .def_property_readonly(
          "outputs", [](const Task& self) { return self.problem().cppn_outputs(); },
          "Outputs of a genome's CPPN.");
  py::class_<OpenSearch>(
      module, "Search",
      R"(amble's search, round by round: ask() for genomes, evaluate them by any means, tell() their fitness.

With evaluate(search, genomes) it evolves what evolve() does, to the bit. Can be pickled, and then goes on to the bit.)")
      .def(py::init([](const py::object& config, std::optional<std::int64_t> seed) {
             auto search = std::make_unique<OpenSearch>(seeded(config, seed));
             const LoadedConfig& loaded = search->task->config;
             warn_of_idle(loaded.value, search->task->problem(), loaded.assignments);
             return search;
           }),
           py::arg("config"), py::arg("seed") = py::none(),
           "config: Config or path. seed: of all randomness (default: the config's). Raises Error.")
      .def("ask", ask, "The genomes of this round: a list, the same until tell().")
      .def(
          "tell", tell, py::arg("fitness"), py::arg("behaviour") = py::none(), py::arg("viable") = py::none(),
          R"(Takes what the genomes of ask() are worth, in their order, and advances to the next round: once after each
ask().

fitness: n numbers, finite, at least 0, higher is better; or all that evaluate() returned. behaviour:
n × behaviour_length, finite; needed where the config's search compares behaviours, else unused. viable: n bools
(default: all true); MAP-Elites keeps none that is not. Raises TypeError and ValueError.)")
      .def(
          "champion", champion_of, py::arg("genome"),
          R"(A genome that ask() gave, in whatever round, as a Champion: trial(), typical(), save(), amble.view() and `amble
export` take it.

Its facts are of the config's objective, whatever fitness tell() was given, and name that round. Raises Error for any other.)")
      .def(py::pickle(&pickled_search, &unpickled_search))
      .def_property_readonly(
          "round",
          [](OpenSearch& self) {
            const auto lock = self.lock.hold();
            return self.state->strategy->round();
          },
          "Rounds completed.")
      .def_property_readonly(
          "metrics",
          [](OpenSearch& self) {
            py::dict metrics;
            const auto lock = self.lock.hold();
            for (const auto& [name, value] : metrics_of(self)) metrics[py::str(name)] = value;
            return metrics;
          },
          "Statistics of the last completed round, a dict: species, threshold and so on.")
      .def_property_readonly(
          "problem", [](const OpenSearch& self) { return self.task; }, "Its Problem.")
      .def_property_readonly("config", [](const OpenSearch& self) { return self.task->config; })
      .def_property_readonly(
          "behaviour_length", [](const OpenSearch& self) { return self.task->behaviour().length(); },
          "Numbers in a behaviour, d; 0: tell() needs none.");
  module.def("evaluate", evaluate_genomes, py::arg("problem"), py::arg("genomes"), py::kw_only(),
             py::arg("engine") = py::none(), py::arg("jobs") = py::none(), py::arg("generation") = py::none(),
             R"(Lets each genome walk, and returns (objective, behaviour): float64 [n] and float32 [n, d].

problem: Problem, Search, Config or path. genomes: Genomes that fit it. engine: "ode", "ode-variant", "batch", "mujoco" or "mujoco-model" (default:
the config's). jobs: workers (default: processors); results do not depend on it. generation: whose noise and ground
(default: the round of a Search, else 0). objective: in m unless the config scores something else. behaviour: the path
over the ground, x0, y0, x1, y1, …, m, where the config's search compares paths, the quantities of the map under
MAP-Elites, else empty (d = 0). The pair, an Evaluation, also has viable, bool [n]: false where a simulation diverged.
Of equal genomes one is tried, and none that was among those of the call before on the same trials.
Raises Error; Ctrl-C raises KeyboardInterrupt at once.)");
  refuse_unmade<neat::Genome>();
  refuse_unmade<Task>();
  refuse_unmade<OpenSearch>();
}

}  // namespace amble::python
