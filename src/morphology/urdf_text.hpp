#pragma once

#include <filesystem>

#include "amble/morphology/model_text.hpp"

namespace amble::morphology {

/// Makes the tree of a URDF, `text.root`, one that MuJoCo reads as the robot that is meant, and takes from it
/// what MuJoCo does not read: `text.motors`. `path` is that of the file, near which meshes are looked for.
void clean_urdf(ModelText& text, const std::filesystem::path& path, ReadingNotes& notes);

}  // namespace amble::morphology
