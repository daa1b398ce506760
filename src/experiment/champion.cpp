#include "amble/experiment/champion.hpp"

#include <string>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/file_kind.hpp"

namespace amble::experiment {

Champion load_champion(const std::filesystem::path& path) {
  if (io::file_kind(path) == io::FileKind::recording)
    fail(ExitCode::bad_file,
         "{}: is a recording, which `amble view`, `gait` and `info` take: expected a champion (JSON)",
         path.string());
  io::refuse_other_kinds(path, io::FileKind::champion,
                         "and no walker; expected a run folder or the file of a champion");
  const std::string text = io::read_file(path);
  if (text.find_first_not_of(" \t\r\n") != text.find('{'))
    fail(ExitCode::bad_file, "{}: expected a run folder, a champion (JSON), or, to look at, a recording",
         path.string());
  return parse_champion(text, path.string()).champion;
}

}  // namespace amble::experiment
