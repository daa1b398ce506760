#pragma once

#include <filesystem>

#include "amble/morphology/model_text.hpp"

namespace amble::morphology {

/// Makes the tree of an MJCF model, `text.root`, one that MuJoCo 2.2 reads as the robot that is meant, and
/// takes from it what MuJoCo does not read: `text.motors`. Throws UserError: elements that would make bodies
/// without naming them (<composite>, <replicate>).
void clean_mjcf(ModelText& text, const std::filesystem::path& path, ReadingNotes& notes);

}  // namespace amble::morphology
