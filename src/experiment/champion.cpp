#include "amble/experiment/champion.hpp"

#include "amble/io/file.hpp"

namespace amble::experiment {

Champion load_champion(const std::filesystem::path& path) {
  return parse_champion(io::read_file(path), path.string()).champion;
}

}  // namespace amble::experiment
