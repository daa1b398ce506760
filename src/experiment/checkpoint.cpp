#include "amble/experiment/checkpoint.hpp"

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"

namespace amble::experiment {

void save_checkpoint(const std::filesystem::path& path, const Config& config, const Progress& progress,
                     const search::Strategy& strategy) {
  io::write_file(path, checkpoint_bytes(config, progress, strategy));
}

std::vector<std::filesystem::path> unnamed_checkpoints(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(path.parent_path(), none))
    if (io::destination_of(entry.path()) == path) found.push_back(entry.path());
  return found;
}

Progress load_checkpoint(const std::filesystem::path& path, const Config& config,
                         search::Strategy& strategy) {
  return parse_checkpoint(io::read_file(path), path.string(), config, strategy);
}

}  // namespace amble::experiment
