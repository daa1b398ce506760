#include "amble/cli/data_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// Options whose values are written, or are words.
bool takes_no_input(std::string_view option) {
  constexpr std::array<std::string_view, 11> options{"-o",      "--out",    "--csv",      "--figures",
                                                     "--json",  "--record", "--patterns", "--mjcf",
                                                     "--slurm", "--title",  "--draw"};
  return std::ranges::find(options, option) != options.end();
}

/// Of a word such as configs/quick/supg.toml, --noise=configs/…, robot=robots/… or --set=robot=robots/… the
/// path, as far as it can be one of ours; else empty.
std::string_view path_in(std::string_view word) {
  if (word.starts_with("-")) {
    const std::size_t equals = word.find('=');
    if (equals == std::string_view::npos || takes_no_input(word.substr(0, equals))) return {};
    word.remove_prefix(equals + 1);
  }
  constexpr std::string_view robot = "robot=";  // of --set
  if (word.starts_with(robot)) word.remove_prefix(robot.size());
  return word.starts_with("configs/") || word.starts_with("robots/") ? word : std::string_view();
}

}  // namespace

std::vector<std::string> with_own_files(std::vector<std::string> words) {
  std::optional<fs::path> data;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string path(path_in(words[i]));
    std::error_code error;
    if (path.empty() || takes_no_input(words[i - 1]) || fs::exists(path, error)) continue;
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
