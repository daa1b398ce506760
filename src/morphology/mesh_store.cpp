#include "amble/morphology/mesh_store.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "amble/io/file.hpp"
#include "amble/morphology/mesh_file.hpp"

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

/// Corners of the hull that stands for a mesh which MuJoCo cannot take: more than amble leaves of any hull.
constexpr std::size_t hull_corners = 200;

MeshShape tetrahedron() {
  return {.corners = {{{0, 0, 0}, {.001F, 0, 0}, {0, .001F, 0}, {0, 0, .001F}}},
          .triangles = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}};
}

MeshStore::Bytes shared(std::string bytes) {
  return std::make_shared<const std::string>(std::move(bytes));
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

const MeshStore::Kept& MeshStore::read(const std::filesystem::path& path, ReadingNotes& notes) {
  const auto [at, is_new] = read_.try_emplace(path);
  Kept& kept = at->second;
  if (!is_new) return kept;
  MeshReading reading = read_mesh(path);
  kept.problem = reading.problem.empty() && is_flat(reading.shape) ? "it is flat" : reading.problem;
  if (!kept.problem.empty()) return kept;
  const std::string name = path.filename().string();
  for (const std::string& remark : reading.remarks)
    notes.add(Reading::left_out, fmt::format("of the mesh {}: {}", name, remark));
  if (reading.shape.parts > 1)
    notes.add(Reading::replaced,
              fmt::format("the {} objects of the mesh {}: all of them are one", reading.shape.parts, name));
  const std::string ending = lower_ending(path);
  const bool many = reading.shape.triangles.size() > most_mesh_faces;
  std::string bytes = stl_bytes(reading.shape);
  std::error_code error;
  const bool binary = std::filesystem::file_size(path, error) == bytes.size();
  const bool as_it_is = ending == ".msh" || (ending == ".stl" && binary && !many) ||
                        (ending == ".obj" && reading.shape.parts == 1 && reading.shape.plain);
  kept.ending = as_it_is ? ending : ".stl";
  if (as_it_is) {
    bytes = io::read_file(path, largest_mesh_bytes);
  } else if (many) {
    const MeshShape hull = hull_of(reading.shape, hull_corners);
    notes.add(Reading::replaced,
              fmt::format("the mesh {} of {} faces, more than MuJoCo takes: its convex hull", name,
                          reading.shape.triangles.size()));
    bytes = stl_bytes(hull);
  }
  kept.bytes = shared(std::move(bytes));
  return kept;
}

std::string MeshStore::keep(Bytes bytes, const std::string& ending) {
  std::string name = fmt::format("mesh{}{}", files_.size(), ending);
  files_[name] = std::move(bytes);
  return name;
}

MeshStore::Entry MeshStore::add(const std::filesystem::path& path, const std::string& kind,
                                ReadingNotes& notes) {
  const Kept& kept = read(path, notes);
  if (!kept.problem.empty()) return {placeholder(), kept.problem};
  std::string& name = names_[{path, kind}];
  if (name.empty()) {
    name = keep(kept.bytes, kept.ending);
    paths_[name] = path;
  }
  return {name, ""};
}

std::string MeshStore::placeholder() {
  std::string name = keep(shared(stl_bytes(tetrahedron())), ".stl");
  placeholders_.insert(name);
  return name;
}

std::string MeshStore::simpler(const std::string& file) {
  if (is_placeholder(file)) return {};
  if (const auto path = paths_.find(file); path != paths_.end()) {
    const MeshShape hull = hull_of(read_mesh(path->second).shape, hull_corners);
    if (!hull.triangles.empty()) return keep(shared(stl_bytes(hull)), ".stl");
  }
  return placeholder();
}

}  // namespace amble::morphology
