#pragma once

#include <filesystem>
#include <memory>
#include <string>

struct mjModel_;  // MuJoCo's mjModel

namespace amble::morphology {

struct DeleteModel {
  void operator()(mjModel_* model) const;
};

using ModelPointer = std::unique_ptr<mjModel_, DeleteModel>;

/// A robot's model, compiled by MuJoCo.
struct ModelFile {
  ModelPointer model;
  std::filesystem::path path;
  bool root_is_welded = false;  ///< URDF cannot express a free root link: it is welded to the world
};

/// Compiles MJCF (.xml, .mjcf) or URDF (.urdf). Throws UserError: missing file (ExitCode::io), or the
/// compiler's own message in one line.
ModelFile compile_model(const std::filesystem::path& path);

/// Compiles the text of an MJCF model that refers to no other files. Throws UserError with the compiler's
/// message in one line, after `what`.
ModelPointer compile_mjcf(const std::string& text, const std::string& what);

}  // namespace amble::morphology
