#include "amble/watch/elite.hpp"

#include <atomic>

#include "amble/core/error.hpp"
#include "amble/experiment/repertoire.hpp"

namespace amble::watch {

std::string elite_text(const experiment::RunPaths& paths, std::uint32_t cell) {
  try {
    const auto repertoire = experiment::load_repertoire(paths);
    const std::atomic<bool> stop = false;
    const auto champion = experiment::elite_champion(repertoire, cell, 1, stop);
    return champion ? experiment::champion_text(*champion) : std::string();
  } catch (const UserError&) {
    return {};
  }
}

}  // namespace amble::watch
