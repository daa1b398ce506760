#pragma once

#include <string>

#include "amble/morphology/mesh_file.hpp"

namespace amble::morphology {

/// All triangles and polygons of the scene of a COLLADA file (.dae), in metres: its unit and the transforms
/// of its nodes are applied. Its up axis is not, as the programs of ROS do not: most exporters write Y_UP
/// whatever is up. What a scene only mentions (lines, morphs, cameras) is skipped. `file`: its name.
MeshReading read_collada(std::string bytes, const std::string& file);

}  // namespace amble::morphology
