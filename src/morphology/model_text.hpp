#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "amble/morphology/reading_notes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {

/// What a model file says of a joint's motor beside what MuJoCo 2.2 reads.
struct MotorHint {
  double max_torque_nm = 0.0;    ///< URDF <limit effort>, MJCF actuatorfrcrange; 0: not given
  double max_speed_rad_s = 0.0;  ///< URDF <limit velocity>; 0: not given
  double kv_nm_s_per_rad = 0.0;  ///< MJCF <position kv>; 0: not given
};

/// A model file as a tree, made such that MuJoCo 2.2 reads what matters to a robot.
struct ModelText {
  XmlElement root;
  bool urdf = false;
  std::map<std::string, MotorHint> motors;  ///< by joint
  /// Meshes whose file is missing or in a format that MuJoCo does not read; replaced by a small placeholder.
  std::map<std::string, std::string> missing_meshes;  ///< name → file
};

constexpr std::uint64_t largest_file_bytes = 50'000'000;

/// The number that a text begins with if it is positive and below 1e9, else 0.
double positive_or_zero(const std::optional<std::string>& text);

/// Whether it is a file that MuJoCo reads as a mesh, by its name's end and size.
bool is_readable_mesh(const std::filesystem::path& path);

/// Whether it is an STL in the text form of that format, which MuJoCo refuses.
bool is_text_stl(const std::filesystem::path& path);
/// What follows its name in messages.
inline constexpr const char* text_stl_remark = " (an STL in text form: save it as binary STL)";

/// Reads MJCF with its includes, or URDF (.urdf). Everything that no robot needs is removed: textures,
/// sensors, visual and statistic settings, height fields and so on. Throws UserError: files larger than 50
/// MB, more than 1000 bodies, entities, includes outside the model's folder, of a file in itself, or more
/// than 32; elements that would make bodies without naming them (<composite>, <replicate>), URDF collision
/// meshes that are missing.
ModelText read_model_text(const std::filesystem::path& path, ReadingNotes& notes);

}  // namespace amble::morphology
