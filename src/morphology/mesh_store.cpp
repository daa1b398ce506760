#include "amble/morphology/mesh_store.hpp"

#include <fmt/format.h>

#include <utility>

#include "amble/io/file.hpp"
#include "amble/morphology/mesh_file.hpp"

namespace amble::morphology {
namespace {

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
