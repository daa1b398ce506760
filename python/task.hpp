#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/evaluator.hpp"
#include "amble/experiment/generation.hpp"
#include "amble/experiment/problem.hpp"
#include "python/bind.hpp"

namespace amble::python {

/// A problem in one engine, with the workers that have been needed so far.
struct Arena {
  experiment::Problem problem;
  std::map<int, std::unique_ptr<experiment::Evaluator>> evaluators;  ///< by number of workers
  experiment::GenerationMemory memory;
  CallLock lock;  ///< held while one evaluates

  explicit Arena(experiment::Problem made) : problem(std::move(made)) {}
};

/// What maps genomes to objectives: config, robot, engines as they are needed.
class Task {
 public:
  explicit Task(LoadedConfig loaded) : config(std::move(loaded)), home_(config.value.engine) {
    arenas_.emplace(home_, std::make_unique<Arena>(experiment::Problem::make(config.value, *config.robot)));
    behaviour_ = config.value.make_behaviour(&problem().robot);
  }

  const experiment::Problem& problem() const { return arenas_.at(home_)->problem; }
  /// Throws UserError for an unknown engine, or one that cannot simulate the robot.
  Arena& in(const std::optional<std::string>& engine) {
    const std::string name = engine.value_or(home_);
    auto& arena = arenas_[name];
    if (!arena) {
      auto elsewhere = problem();
      elsewhere.engine = name;
      try {
        elsewhere.complete();
      } catch (...) {
        arenas_.erase(name);
        throw;
      }
      arena = std::make_unique<Arena>(std::move(elsewhere));
    }
    return *arena;
  }

  const score::Behaviour& behaviour() const { return *behaviour_; }

  const LoadedConfig config;

 private:
  std::unique_ptr<const score::Behaviour> behaviour_;
  std::string home_;
  std::map<std::string, std::unique_ptr<Arena>> arenas_;
};

/// That of a Problem or Search, or made of a Config or the path of one. TypeError for anything else.
std::shared_ptr<Task> task_of(const py::object& object);
/// TypeError for anything but a sequence of Genomes; UserError for one that does not fit the task.
std::vector<neat::Genome> checked_genomes(const Task& task, const py::object& genomes);

}  // namespace amble::python
