#include "amble/experiment/plan/manifest.hpp"

namespace amble::experiment {

std::string manifest_text(const Config& config, const io::Json& processes) {
  return io::sealed_json(
      manifest_format, run_version,
      {{"name", config.name}, {"seed", config.seed}, {"engine", config.engine}, {"processes", processes}});
}

}  // namespace amble::experiment
