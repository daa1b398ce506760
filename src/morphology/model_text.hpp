#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "amble/morphology/mass_text.hpp"
#include "amble/morphology/mesh_store.hpp"
#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// What a model file says of a joint's motor beside what MuJoCo 2.2 reads.
struct MotorHint {
  double max_torque_nm = 0.0;    ///< URDF <limit effort>, MJCF actuatorfrcrange; 0: not given
  double max_speed_rad_s = 0.0;  ///< URDF <limit velocity>; 0: not given
  double kv_nm_s_per_rad = 0.0;  ///< MJCF <position kv>; 0: not given
  double damping_ratio = 0.0;    ///< MJCF <position dampratio>, in place of kv; 0: not given

  /// URDF <safety_controller>, soft_lower_limit and soft_upper_limit.
  std::optional<std::array<double, 2>> soft_limits_rad = {};

  /// Templates of URDFs have an effort of 1000 N m beside a velocity of 0.5 rad/s or so: neither is a
  /// motor's.
  bool is_of_a_template() const {
    return max_torque_nm >= 1000.0 && max_speed_rad_s > 0.0 && max_speed_rad_s <= 1.0;
  }
};

/// A model file as a tree, made such that MuJoCo 2.2 reads what matters to a robot.
struct ModelText {
  XmlElement root;
  bool urdf = false;
  std::map<std::string, MotorHint> motors = {};  ///< by joint
  /// Joints of a URDF that a <transmission> or <ros2_control> names as driven.
  std::set<std::string> motors_named = {};
  std::vector<std::pair<std::string, std::string>> mimics =
      {};                 ///< of a URDF: a joint and the one it follows
  MeshStore meshes = {};  ///< the files that the tree names
  std::map<std::string, std::string> mesh_files =
      {};  ///< by MuJoCo's name of a mesh: the file as the model names it
  /// Meshes that could not be read, in whose place a small tetrahedron is.
  std::map<std::string, std::string> missing_meshes = {};  ///< name → file and reason
  MissingMasses missing_masses = {};
  /// Sections <size> and <statistic>, which are removed, as MuJoCo's own simulation depends on them.
  std::vector<XmlElement> aside = {};
};

/// Puts a mesh into the store, and its name there under `key` of the element; `path` is empty if there is no
/// such file, `named` what the model calls it.
void take_mesh(ModelText& text, XmlElement& element, const std::string& key, const std::string& named,
               const std::filesystem::path& path, ReadingNotes& notes);

/// Reads MJCF with its includes, or URDF, told by its first element. Everything that no robot needs is
/// removed: textures, sensors, visual and statistic settings, height fields and so on. Throws UserError:
/// files larger than 50 MB, more than 1000 bodies, entities, includes from outside the model's repository or
/// the folder above it, of a file in itself, or more than 32; macros of xacro, SDF and other formats, with
/// what to do; and see clean_mjcf().
ModelText read_model_text(const std::filesystem::path& path, ReadingNotes& notes);

/// Faults of a model's tree that MuJoCo refuses without saying where they are.

/// Refuses parts of one kind with the same name: a URDF's links and joints; an MJCF's bodies, joints, geoms,
/// sites and meshes. Throws UserError with name and both places.
void refuse_repeated_names(const XmlElement& root, bool urdf);

/// Refuses a URDF whose joints name no links or links that are not there, or whose links are no tree: a link
/// behind two joints, or links that hang on each other in a loop. Throws UserError with their names.
void refuse_odd_tree(const XmlElement& root);

}  // namespace amble::morphology
