#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/run_folder.hpp"
#include "amble/record/generations_csv.hpp"

namespace amble::experiment {

/// The result of running a champion again.
struct Verification {
  bool agrees = false;
  std::string text;  ///< "agrees: …", "differs: …" with the first step that does, or "unsound: …"
};

/// The run that a champion is checked against.
struct Origin {
  Config config;
  Problem problem;
  record::Generations table = {};  ///< of the run, as far as it goes
};
/// Reads all but the table from the run's folder. Throws UserError.
Origin origin_of(const RunPaths& paths);

/// Runs the champion of a file again, step by step against its trace. With an `origin` it must be that run's,
/// of the generation in the file's name, and have walked as far as the run's table says. An altered or
/// unsound file is a result, not an error. Nothing if `stop` was set. Throws UserError if the file cannot be
/// read at all.
std::optional<Verification> verify_champion(const std::filesystem::path& path, const std::atomic<bool>& stop,
                                            const Origin* origin = nullptr);

}  // namespace amble::experiment
