#include "amble/experiment/given_damage.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "amble/core/error.hpp"
#include "amble/damage/text.hpp"
#include "amble/experiment/config.hpp"
#include "amble/io/text.hpp"

namespace amble::experiment {

damage::Settings damage_of(const std::string& spec) {
  std::error_code error;
  // A path that may not be looked at is named by who reads it.
  if (std::filesystem::exists(spec, error) ||
      (error && spec != "none" && spec.find(':') == std::string::npos)) {
    damage::Settings damage = load_config(spec, {}).damage;
    if (damage.is_default())
      fail(ExitCode::bad_input,
           "damage \"{}\": the config has no [damage]; expected one that has, damages such as missing:FL, or "
           "none for the intact robot",
           io::printable(spec));
    return damage;
  }
  if (spec == "none") return {};
  if (spec.find(':') == std::string::npos)
    fail(ExitCode::bad_input,
         "damage \"{}\": no such file; expected damages such as missing:FL,weak:FR_knee=0.3, the path of a "
         "config with [damage], or none for the intact robot",
         io::printable(spec));
  return damage::parse(spec);
}

void check_begins(const damage::Settings& damage, double duration_s) {
  for (std::size_t i = 0; i < damage.parts.size(); ++i)
    if (damage.parts[i].from_s >= duration_s)
      fail_setting({fmt::format("damage.parts[{}].from_s", i)},
                   "damage.parts[{}].from_s = {:g}: the trial is {:g} s long, and has ended by then", i,
                   damage.parts[i].from_s, duration_s);
}

}  // namespace amble::experiment
