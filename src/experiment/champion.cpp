#include "amble/experiment/champion.hpp"

#include <string>

#include "amble/core/error.hpp"
#include "amble/experiment/run_paths.hpp"
#include "amble/io/file.hpp"
#include "amble/record/frame_codec.hpp"

namespace amble::experiment {

Champion load_champion(const std::filesystem::path& path) {
  if (is_source(path))
    fail(ExitCode::bad_input,
         "{}: what a run is made of, and no walker; expected a run folder or the file of a champion. A "
         "robot is drawn by amble robot FILE --draw ROBOT.svg",
         path.string());
  const std::string text = io::read_file(path);
  if (text.starts_with(record::recording_magic))
    fail(ExitCode::bad_file,
         "{}: is a recording, which `amble view`, `gait` and `info` take: expected a champion (JSON)",
         path.string());
  return parse_champion(text, path.string()).champion;
}

}  // namespace amble::experiment
