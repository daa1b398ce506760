#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "amble/experiment/plan/config.hpp"

namespace amble::io {
class TomlDocument;
}

/// Experiments: configs, what follows from them, runs and their champions.
namespace amble::experiment {

/// Overrides of a config file on the command line, applied in this order.
struct Overrides {
  std::vector<std::string> assignments;  ///< "key.path=value", in order; the value is TOML, or a bare word
  std::optional<std::int64_t> seed;      ///< Config::seed; nothing: as in the file
  std::optional<int> generations;        ///< Config::generations; nothing: as in the file
};

/// Reads, overrides, checks. `robot` becomes an absolute path. Throws UserError: no such file (ExitCode::io),
/// a syntax error, an unknown key, a value out of its range, settings that do not fit together; the
/// message names file and line where there is one.
Config load_config(const std::filesystem::path& path, const Overrides& overrides);
/// The same from a document that has been read, which is copied. Throws as load_config(). Within amble: the
/// header of documents is not installed.
Config config_from(const io::TomlDocument& document, const Overrides& overrides);

}  // namespace amble::experiment
