#include "amble/io/scratch_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

#include "amble/core/error.hpp"

namespace amble::io {
namespace {

namespace fs = std::filesystem;

fs::path new_folder() {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) fail(ExitCode::io, "the folder for temporary files (TMPDIR): {}", error.message());
  std::string name = (parent / "amble-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr)
    fail(ExitCode::io, "cannot make folder {}: {}", name, std::generic_category().message(errno));
  return name;
}

}  // namespace

ScratchFile::ScratchFile(const std::string& name) : path_(new_folder() / name) {}

ScratchFile::~ScratchFile() {
  std::error_code none;
  fs::remove_all(path_.parent_path(), none);
}

}  // namespace amble::io
