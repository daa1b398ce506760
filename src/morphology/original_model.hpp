#pragma once

#include <memory>
#include <string>

#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/robot/original_model.hpp"

namespace amble::morphology {

/// The model of a robot as its author wrote it, as far as this MuJoCo can simulate it, and without what no
/// motion depends on: sensors, keyframes, meshes that are only to look at. `options` and `parts` are those
/// that `robot` was made from. Added: where the model has no ground, the plane
/// z = 0 with MuJoCo's own friction, which everything touches that collides. Of models for a newer MuJoCo are
/// kept: kv and dampratio of position actuators, actuatorfrcrange of joints with one actuator, and
/// implicitfast as implicit; notes say so. Throws UserError in one line: URDF; a root that moves neither by a
/// free joint nor by slides and hinges; meshes of more than 32 MB; what cannot be compiled.
std::shared_ptr<const robot::OriginalModel> keep_model(const ModelFile& file, const ReadingOptions& options,
                                                       const ModelParts& parts, const robot::RobotSpec& robot,
                                                       ReadingNotes& notes);

/// The line of a robot file that says keep_model, or a comment with the reason why not; empty for a URDF.
std::string keeping_lines(const ModelFile& file, const ReadingOptions& options, const ModelParts& parts,
                          const robot::RobotSpec& robot);

}  // namespace amble::morphology
