#include "amble/experiment/problem/implied_settings.hpp"

namespace amble::experiment {

void leave_out_implied(io::Json& json, const score::Settings& score, const ground::Settings& ground,
                       const damage::Settings& damage, const trial::CommandSettings& command) {
  if (score.is_distance()) json.erase("score");
  if (ground.is_default()) json.erase("ground");
  if (damage.is_default()) json.erase("damage");
  if (command.is_default()) json.erase("command");
}

}  // namespace amble::experiment
