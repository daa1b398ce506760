#pragma once

#include <filesystem>

namespace amble::io {

/// Loads a plugin (core/plugin.hpp) for as long as the process lives, and lets it register what it has.
/// Before the first config is read. Throws UserError in one line: no such file, none that the system can load
/// (its own words), no plugin, built for another version or by another compiler, a name that is taken.
void load_plugin(const std::filesystem::path& file);

}  // namespace amble::io
