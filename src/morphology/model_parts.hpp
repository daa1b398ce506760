#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "amble/core/math.hpp"
#include "amble/morphology/model_drives.hpp"
#include "amble/morphology/model_file.hpp"
#include "amble/morphology/reading_notes.hpp"
#include "amble/robot/spec.hpp"

namespace amble::morphology {

/// How a robot stands at the start, and which of its joints do not move.
struct ReadingOptions {
  std::string start_keyframe = {};  ///< of the MJCF; empty: the model's default pose
  std::map<std::string, double> start_angles_rad =
      {};                                      ///< by joint, as the model counts; beside the keyframe
  std::vector<std::string> fixed_joints = {};  ///< welded at their start angle
  std::optional<Quat> start_rotation = {};  ///< of the root in the world; none: as keyframe or model have it
};

/// The parts of a robot that a model file defines. Bodies that are fixed to their parent are one rigid body
/// with it, under the parent's name. Frames, anchors and axes are those of the start pose.
struct ModelParts {
  std::vector<robot::Body> bodies;
  std::vector<robot::Joint> joints;  ///< in the order of the model, without servo, but with its spring
  std::vector<Drive> drives;         ///< per joint: what moves it in the model
  bool root_is_free = false;         ///< whether the model's root moves by a free joint, or by none
  std::vector<double> start_rad;     ///< per joint: the start pose's angle as the model counts it
  std::vector<robot::Geom> geoms;
  std::vector<int> model_joints, model_geoms;  ///< MuJoCo's numbers of `joints` and `geoms`
  std::vector<int> welded_links;  ///< per geom: MuJoCo's number of its body if no joint moves that, else −1
  Vec3 gravity_m_s2;
  ReadingNotes notes;  ///< with those of the file
};

/// Corners of a collision mesh's convex hull, and of one that is only to look at.
inline constexpr std::size_t most_collision_vertices = 32, most_decoration_vertices = 100;

/// Extracts the parts from a compiled model. A geom without a name gets that of its body in the model, with
/// ".0", ".1", … appended where there are several. Meshes and ellipsoids become convex hulls; a root that is
/// not free becomes free. Left out and noted: world-fixed geoms and bodies (the ground is amble's own),
/// tendons, constraints that couple joints. Throws UserError for what amble cannot simulate: more than one
/// robot, joints that are neither hinges nor fixed, closed loops, colliding planes and height fields; names
/// of keyframes and joints that are not there.
/// `before`: parts of the same file in another pose, whose hulls of meshes are taken; none: they are made.
ModelParts extract_parts(const ModelFile& file, const ReadingOptions& options = {},
                         const ModelParts* before = nullptr);

}  // namespace amble::morphology
