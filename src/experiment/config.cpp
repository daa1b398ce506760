#include "amble/experiment/config.hpp"

#include <fmt/format.h>

#include <memory>

#include "amble/core/error.hpp"
#include "amble/experiment/run_paths.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::experiment {
namespace fs = std::filesystem;

Config load_config(const std::filesystem::path& path, const Overrides& overrides) {
  if (is_run_folder(path))
    fail(ExitCode::bad_input, "{}: a run folder, and not a config; expected its {}", path.string(),
         RunPaths(path).config.string());
  // The first unknown key of another kind of file would say little.
  io::refuse_other_kinds(path, io::FileKind::config,
                         "and not the config of a run (one that has robot = \"…\", e.g. the evolve.toml of "
                         "amble robot --init)");
  return config_from(io::TomlDocument::read(path), overrides);
}

Config config_from(const io::TomlDocument& read, const Overrides& overrides) {
  const auto document = std::make_shared<io::TomlDocument>(read);
  for (const auto& assignment : overrides.assignments) document->set(assignment);
  if (overrides.seed) document->set("seed=" + std::to_string(*overrides.seed));
  if (overrides.generations) document->set("generations=" + std::to_string(*overrides.generations));

  Config config;
  config.locate_setting = [document](const std::vector<std::string>& keys) { return document->where(keys); };
  config.describe(*document->reader());
  config.neat.speciation.scale_targets(config.neat.population.size);  // what the document has comes after
  const auto reader = document->reader();
  config.describe(*reader);
  reader->finish();
  try {
    config.validate();
  } catch (const SettingError& error) {
    throw config.with_location(error);
  }
  config.robot = fs::absolute(document->folder_of("robot") / config.robot).lexically_normal().string();
  return config;
}

}  // namespace amble::experiment
