#include "amble/cli/data_folder.hpp"

#include <fmt/format.h>

#include <string_view>
#include <system_error>

#include "amble/cli/messages.hpp"
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

namespace {

/// Of a word such as configs/quick/supg.toml, --noise=configs/… or robot=robots/… the path, as far as it can
/// be one of ours; else empty.
std::string_view path_in(std::string_view word) {
  const std::size_t equals = word.find('=');
  const std::string_view path = equals == std::string_view::npos ? word : word.substr(equals + 1);
  return path.starts_with("configs/") || path.starts_with("robots/") ? path : std::string_view();
}

}  // namespace

std::vector<std::string> with_own_files(std::vector<std::string> words) {
  const auto names_output = [](std::string_view word) { return word == "-o" || word == "--out"; };
  std::optional<fs::path> data;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string path(path_in(words[i]));
    std::error_code error;
    if (path.empty() || names_output(words[i - 1]) || words[i].starts_with("--out=") ||
        fs::exists(path, error))
      continue;
    if (!data) data = data_folder();
    if (!data || !fs::exists(*data / path, error)) continue;
    words[i].replace(words[i].size() - path.size(), path.size(), (*data / path).string());
    print_message(fmt::format("note: {} is not in this folder; it is taken from {}\n", path, data->string()));
  }
  return words;
}

std::optional<fs::path> preset_of_robots() {
  const auto folder = data_folder();
  return folder ? std::optional(*folder / experiment::robot_preset) : std::nullopt;
}

}  // namespace amble::cli
