#pragma once

#include <filesystem>
#include <string_view>

namespace amble::io {

/// What a file holds, by its beginning or its keys and not by its name.
enum class FileKind {
  none,       ///< there is no such file, or it cannot be read
  folder,     ///< a folder, whatever is in it
  champion,   ///< JSON of amble
  robot,      ///< JSON of amble: the robot of a run
  recording,  ///< of a trial
  side_file,  ///< TOML that names the model of a robot
  config,     ///< TOML: the settings of a run
  study,      ///< TOML: conditions and tests
  model,      ///< XML: MJCF or URDF, or of xacro
  other,      ///< anything else, among it TOML with errors, pipes and devices
};

/// Reads at most a megabyte. Never throws for what it finds.
FileKind file_kind(const std::filesystem::path& path);

/// Throws UserError for a file of a kind with a name that is not `wanted`: what it is, `instead` ("and not a
/// study"), and what one may do with it. Whatever else is wrong is left to who reads the file.
void refuse_other_kinds(const std::filesystem::path& path, FileKind wanted, std::string_view instead);

}  // namespace amble::io
