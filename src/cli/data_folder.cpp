#include "amble/cli/data_folder.hpp"

#include <system_error>
#include <vector>

#include "amble/experiment/robot_folder.hpp"

namespace amble::cli {
namespace fs = std::filesystem;

std::optional<fs::path> data_folder() {
  std::error_code error;
  std::vector<fs::path> folders;
  for (fs::path at = fs::read_symlink("/proc/self/exe", error).parent_path(); at.has_relative_path();
       at = at.parent_path()) {
    folders.push_back(at);
    folders.push_back(at / "share/amble");
  }
  folders.push_back(fs::current_path());
  for (const fs::path& folder : folders)
    if (fs::exists(folder / experiment::robot_preset, error)) return folder;
  return std::nullopt;
}

std::optional<fs::path> preset_of_robots() {
  const auto folder = data_folder();
  return folder ? std::optional(*folder / experiment::robot_preset) : std::nullopt;
}

}  // namespace amble::cli
