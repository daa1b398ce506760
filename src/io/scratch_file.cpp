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

/// TMPDIR, or /tmp where it is not set; set to nothing is not set.
fs::path folder_for_temporary_files() {
  const char* const set = std::getenv("TMPDIR");
  if (set == nullptr || *set == '\0') return "/tmp";
  std::error_code error;
  if (!fs::is_directory(set, error))
    fail(ExitCode::io, "TMPDIR={}: {}: expected a folder for temporary files", set,
         error ? error.message() : "not a folder");
  return set;
}

fs::path new_folder() {
  const fs::path parent = folder_for_temporary_files();
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
