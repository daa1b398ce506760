#include "amble/morphology/model_file.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"

namespace amble::morphology {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// MuJoCo fuses a URDF's root link into the world, and its mass is lost, unless the compiler option
/// fusestatic is off. That option belongs into an element <mujoco>, which most URDF files do not have.
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

/// A one-file file system in memory, from which MuJoCo reads the amended text.
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

/// What MuJoCo reports as a fatal error, after which its default handler ends the process.
class FatalComplaint : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

void throw_complaint(const char* text) {
  throw FatalComplaint(text);
}
void ignore_warning(const char*) {}

/// Redirects MuJoCo's complaints while it lives. The handlers belong to the whole process, so models are
/// loaded one at a time, and a program that uses MuJoCo itself gets its own handlers back.
class ComplaintsCaught {
 public:
  ComplaintsCaught()
      : lock_(mutex()),
        error_(std::exchange(mju_user_error, throw_complaint)),
        // MuJoCo's default writes a log file into the current folder.
        warning_(std::exchange(mju_user_warning, ignore_warning)) {}
  ~ComplaintsCaught() {
    mju_user_error = error_;
    mju_user_warning = warning_;
  }
  ComplaintsCaught(const ComplaintsCaught&) = delete;
  ComplaintsCaught& operator=(const ComplaintsCaught&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one_for_all;
    return one_for_all;
  }

  std::lock_guard<std::mutex> lock_;
  void (*error_)(const char*);
  void (*warning_)(const char*);
};

mjModel* load(const std::filesystem::path& path, const mjVFS* files) {
  const ComplaintsCaught caught;
  std::array<char, 1000> complaint{};
  mjModel* model = nullptr;
  try {
    model = mj_loadXML(path.c_str(), files, complaint.data(), static_cast<int>(complaint.size()));
  } catch (const FatalComplaint& fatal) {
    std::snprintf(complaint.data(), complaint.size(), "%s", fatal.what());
  }
  if (model == nullptr) {
    fail(ExitCode::bad_input, "{}: MuJoCo refuses the model: {}", path.string(), one_line(complaint.data()));
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
    compiled.model.reset(load(path, amended.get()));
  } else {
    compiled.model.reset(load(path, nullptr));
  }
  return compiled;
}

}  // namespace amble::morphology
