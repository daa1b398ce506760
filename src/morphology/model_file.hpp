#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "amble/morphology/model_text.hpp"
#include "amble/morphology/reading_notes.hpp"

struct mjModel_;  // MuJoCo's mjModel

namespace amble::morphology {

struct DeleteModel {
  void operator()(mjModel_* model) const;
};

using ModelPointer = std::unique_ptr<mjModel_, DeleteModel>;

/// An attribute that this MuJoCo does not know, and the element's name.
struct RemovedAttribute {
  std::string element, key, value;
};

/// A robot's model, compiled by MuJoCo.
struct ModelFile {
  ModelPointer model;
  std::filesystem::path path;
  bool root_is_welded = false;  ///< URDF cannot express a free root link: it is welded to the world
  std::map<std::string, MotorHint> motors = {};                  ///< by joint
  std::set<std::string> motors_named = {};                       ///< ModelText::motors_named
  std::vector<std::pair<std::string, std::string>> mimics = {};  ///< ModelText::mimics
  std::map<std::string, std::string> missing_meshes = {};        ///< name → file
  std::set<int> mended_bodies = {};  ///< whose masses the text does not have, by MuJoCo's number
  ReadingNotes notes = {};
  /// What was compiled, what of it was set aside (ModelText::aside), and what had to be removed.
  XmlElement text = {};
  std::vector<XmlElement> aside = {};
  std::vector<RemovedAttribute> removed = {};
  std::map<std::string, MeshStore::Bytes> meshes = {};  ///< that the text names

  bool is_urdf() const { return root_is_welded; }
};

/// Compiles MJCF (.xml, .mjcf) or URDF (.urdf). Attributes and elements that this MuJoCo does not know, since
/// the model was written for a newer one, are left out and noted, outside of bodies' structure. Throws
/// UserError: missing file (ExitCode::io), see read_model_text(), or the compiler's own message in one line.
ModelFile compile_model(const std::filesystem::path& path);

/// Compiles the text of an MJCF model that refers to no other files than `meshes` (name → bytes). Throws
/// UserError with the compiler's message in one line, after `what`.
ModelPointer compile_mjcf(const std::string& text, const std::string& what,
                          const std::map<std::string, std::string>& meshes = {});

}  // namespace amble::morphology
