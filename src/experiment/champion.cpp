#include "amble/experiment/champion.hpp"

#include <string>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/record/frame_codec.hpp"

namespace amble::experiment {

Champion load_champion(const std::filesystem::path& path) {
  const std::string text = io::read_file(path);
  if (text.starts_with(record::recording_magic))
    fail(ExitCode::bad_file,
         "{}: is a recording, which `amble view`, `gait` and `info` take: expected a champion (JSON)",
         path.string());
  return parse_champion(text, path.string()).champion;
}

}  // namespace amble::experiment
