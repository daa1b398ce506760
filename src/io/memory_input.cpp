// InputFile where there are no files: what a page has read is in memory.
#include <algorithm>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"

namespace amble::io {

InputFile::InputFile(const std::filesystem::path& path) : path_(path) {
  fail(ExitCode::io, "{}: there are no files here", path_.string());
}

InputFile::InputFile(std::string bytes, const std::filesystem::path& path)
    : path_(path), bytes_(std::move(bytes)) {}

InputFile::~InputFile() = default;

std::string InputFile::read(std::uint64_t count) {
  std::string part = bytes_.substr(
      position_, static_cast<std::size_t>(std::min<std::uint64_t>(count, bytes_.size() - position_)));
  position_ += part.size();
  return part;
}

}  // namespace amble::io
