#include "amble/ground/recorded.hpp"

#include <limits>

namespace amble::ground {
namespace {

std::uint32_t small(const io::JsonView& json) {
  const std::int64_t value = json.integer();
  if (value < 0 || value > std::numeric_limits<std::uint32_t>::max()) json.bad("a whole number below 2^32");
  return static_cast<std::uint32_t>(value);
}

}  // namespace

io::Json to_json(const Settings& settings, const Key& key) {
  return {{"settings", io::settings_to_json(settings)},
          {"key", {{"seed", key.seed}, {"generation", key.generation}, {"set", key.set}}}};
}

HeightField field_from_json(const io::JsonView& json) {
  const auto settings = io::settings_from_json<Settings>(json.at("settings"));
  settings.validate();
  const io::JsonView key = json.at("key");
  return make_field(settings, {.seed = static_cast<std::uint64_t>(key.at("seed").integer()),
                               .generation = small(key.at("generation")),
                               .set = small(key.at("set"))});
}

}  // namespace amble::ground
