#include "amble/morphology/mesh_path.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>

namespace amble::morphology {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool alike(const std::string& a, const std::string& b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// The entry of a folder that is called so but for capitals, the first by name.
fs::path entry_like(const fs::path& folder, const fs::path& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  fs::path found;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, error), end; !error && at != end;
       at.increment(error))
    if (alike(at->path().filename().string(), name.string()) && (found.empty() || at->path() < found))
      found = at->path();
  return found;
}

fs::path like(const fs::path& path) {
  fs::path at;
  for (const fs::path& part : path) {
    if (part.has_root_path() || part == "." || part == "..") {
      at /= part;
      continue;
    }
    at = entry_like(at, part);
    if (at.empty()) return {};
  }
  return is_file(at) ? at : fs::path();
}

/// %20 and the like.
std::string without_percents(const std::string& text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool code = text[at] == '%' && at + 2 < text.size() &&
                      std::isxdigit(static_cast<unsigned char>(text[at + 1])) != 0 &&
                      std::isxdigit(static_cast<unsigned char>(text[at + 2])) != 0;
    plain += code ? static_cast<char>(std::strtol(text.substr(at + 1, 2).c_str(), nullptr, 16)) : text[at];
    if (code) at += 2;
  }
  return plain;
}

}  // namespace

std::string plain_path(std::string name) {
  std::ranges::replace(name, '\\', '/');
  const std::size_t first = name.find_first_not_of(" \t\r\n"), last = name.find_last_not_of(" \t\r\n");
  name = first == std::string::npos ? std::string() : name.substr(first, last + 1 - first);
  if (const std::size_t scheme = name.find("://");
      scheme != std::string::npos && name.find('/') == scheme + 1)
    name.erase(0, scheme + 3);
  for (const std::string_view find : {"$(find ", "$(find-pkg-share "}) {
    const std::size_t end = name.find(')');
    if (name.starts_with(find) && end != std::string::npos)
      name = name.substr(find.size(), end - find.size()) + name.substr(end + 1);
  }
  const std::size_t drive = name.starts_with('/') ? 1 : 0;
  if (name.size() > drive + 2 && name[drive + 1] == ':' && name[drive + 2] == '/' &&
      std::isalpha(static_cast<unsigned char>(name[drive])) != 0)
    name.erase(0, drive + 2);
  return name;
}

fs::path first_file(const std::vector<fs::path>& candidates) {
  for (const fs::path& candidate : candidates)
    if (is_file(candidate)) return candidate;
  for (const fs::path& candidate : candidates)
    if (fs::path found = like(candidate); !found.empty()) return found;
  for (const fs::path& candidate : candidates)
    if (const std::string name = without_percents(candidate.string()); name != candidate)
      if (is_file(name)) return name;
  return {};
}

std::vector<fs::path> places_of_urdf_mesh(const fs::path& folder, const fs::path& mesh_folder,
                                          const std::string& name) {
  const fs::path whole(name);
  fs::path rest;  // without the package's name
  for (auto part = whole.begin(); part != whole.end(); ++part)
    if (part != whole.begin()) rest /= *part;
  std::vector<fs::path> places;
  if (!mesh_folder.empty()) places = {folder / mesh_folder / whole, folder / mesh_folder / whole.filename()};
  fs::path above = fs::absolute(folder.empty() ? "." : folder).lexically_normal();
  constexpr int most_folders = 8;
  for (int i = 0; i < most_folders && above.has_relative_path(); ++i, above = above.parent_path()) {
    places.push_back(above / whole);
    if (!rest.empty()) places.push_back(above / rest);
  }
  const fs::path end = whole.filename();
  // A path of another machine: its ends, the longest first.
  for (fs::path tail = rest; !tail.empty();) {
    places.insert(places.end(), {folder / tail, folder / ".." / tail});
    fs::path shorter;
    for (auto part = tail.begin(); part != tail.end(); ++part)
      if (part != tail.begin()) shorter /= *part;
    tail = shorter;
  }
  places.insert(places.end(), {folder / end, folder / "meshes" / end, folder / ".." / "meshes" / end});
  return places;
}

}  // namespace amble::morphology
