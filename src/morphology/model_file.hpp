#pragma once

#include <filesystem>
#include <memory>

struct mjModel_;  // MuJoCo's mjModel

namespace amble::morphology {

struct DeleteModel {
  void operator()(mjModel_* model) const;
};

/// A robot's model as MuJoCo's compiler understood it.
struct ModelFile {
  std::unique_ptr<mjModel_, DeleteModel> model;
  std::filesystem::path path;
  bool root_is_welded = false;  ///< URDF cannot say that the root link moves freely: it hangs on the world
};

/// Compiles MJCF (.xml, .mjcf) or URDF (.urdf). Throws UserError: missing file (ExitCode::io), or the
/// compiler's own complaint in one line.
ModelFile compile_model(const std::filesystem::path& path);

}  // namespace amble::morphology
