#include "amble/cli/scratch_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <system_error>

namespace amble::cli {
namespace {

int made = 0;

}  // namespace

ScratchFile::ScratchFile(const std::string& kind)
    : path_(std::filesystem::temp_directory_path() /
            fmt::format("amble-{}-{}-{}.rec", kind, getpid(), made++)) {}

ScratchFile::~ScratchFile() {
  std::error_code none;
  std::filesystem::remove(path_, none);
}

}  // namespace amble::cli
