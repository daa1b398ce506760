#include "amble/morphology/model_file.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::morphology {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// MuJoCo fuses a URDF's root link into the world, and its mass is lost, unless the compiler option
/// fusestatic is off. That option goes into an element <mujoco>, which most URDF files do not have.
std::string with_root_kept(std::string text, const std::filesystem::path& path) {
  if (text.find("<mujoco") != std::string::npos) {
    if (text.find("fusestatic=\"false\"") == std::string::npos) {
      fail(ExitCode::bad_input,
           "{}: the element <mujoco> must hold <compiler fusestatic=\"false\"/>, or the root link is lost",
           path.string());
    }
    return text;
  }
  const std::size_t robot = text.find("<robot");
  const std::size_t end = robot == std::string::npos ? robot : text.find('>', robot);
  if (end == std::string::npos)
    fail(ExitCode::bad_input, "{}: a URDF needs an element <robot>", path.string());
  text.insert(end + 1, "<mujoco><compiler fusestatic=\"false\"/></mujoco>");
  return text;
}

/// A one-file file system in memory, from which MuJoCo reads a text.
class MemoryFile {
 public:
  MemoryFile(const std::filesystem::path& path, const std::string& text) : files_(std::make_unique<mjVFS>()) {
    mj_defaultVFS(files_.get());
    if (mj_makeEmptyFileVFS(files_.get(), path.filename().c_str(), static_cast<int>(text.size())) != 0) {
      fail(ExitCode::bad_input, "{}: too long a file name", path.string());
    }
    std::memcpy(files_->filedata[0], text.data(), text.size());
  }
  ~MemoryFile() { mj_deleteVFS(files_.get()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

ModelPointer load(const std::filesystem::path& path, const mjVFS* files, const std::string& what) {
  const ScopedMujocoHandlers handlers;
  std::array<char, 1000> message{};
  ModelPointer model;
  try {
    model.reset(mj_loadXML(path.c_str(), files, message.data(), static_cast<int>(message.size())));
  } catch (const MujocoError& fatal) {
    std::snprintf(message.data(), message.size(), "%s", fatal.what());
  }
  if (model == nullptr) {
    fail(ExitCode::bad_input, "{}: MuJoCo refuses the model: {}", what, one_line(message.data()));
  }
  return model;
}

}  // namespace

void DeleteModel::operator()(mjModel_* model) const {
  mj_deleteModel(model);
}

ModelFile compile_model(const std::filesystem::path& path) {
  ModelFile compiled;
  compiled.path = path;
  const std::string text = io::read_file(path);
  if (path.extension() == ".urdf") {
    compiled.root_is_welded = true;
    const MemoryFile amended(path, with_root_kept(text, path));
    compiled.model = load(path, amended.get(), path.string());
  } else {
    compiled.model = load(path, nullptr, path.string());
  }
  return compiled;
}

ModelPointer compile_mjcf(const std::string& text, const std::string& what) {
  const MemoryFile file("model.xml", text);
  return load("model.xml", file.get(), what);
}

}  // namespace amble::morphology
