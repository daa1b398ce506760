#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace amble::morphology {

/// The largest mesh file that is read.
inline constexpr std::uint64_t largest_mesh_bytes = 200'000'000;
/// MuJoCo takes no more faces of an STL.
inline constexpr std::size_t most_mesh_faces = 200'000;

/// All parts of a mesh file as one list of triangles, in the file's own unit; of COLLADA in metres.
struct MeshShape {
  std::vector<std::array<float, 3>> corners;
  std::vector<std::array<int, 3>> triangles;
  int parts = 1;      ///< objects or groups with faces of their own
  bool plain = true;  ///< triangles and quads only
};

/// What came out of reading one: the shape, or why there is none.
struct MeshReading {
  MeshShape shape;
  std::string problem = {};               ///< empty: it was read
  std::vector<std::string> remarks = {};  ///< what of the file was not followed
};

/// Reads STL (binary or text), OBJ, MuJoCo's MSH and COLLADA (.dae), told by their contents where names lie.
MeshReading read_mesh(const std::filesystem::path& path);

/// The end of a file's name, ".stl", in small letters.
std::string lower_ending(const std::filesystem::path& path);

/// Each reader by itself. `bytes`: the file's.
MeshReading read_stl(std::string_view bytes);
MeshReading read_obj(std::string_view bytes);
MeshReading read_msh(std::string_view bytes);

/// As binary STL.
std::string stl_bytes(const MeshShape& shape);

/// Whether all of its corners lie in a plane. MuJoCo 2.2 never comes back from the hull of such a mesh.
bool is_flat(const MeshShape& shape);

/// Its convex hull, with at most so many corners; without triangles if it is flat.
MeshShape hull_of(const MeshShape& shape, std::size_t most_corners);

}  // namespace amble::morphology
