#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "amble/morphology/reading_notes.hpp"

namespace amble::morphology {

/// A path as a file names it, as this system writes it: blanks around it and a drive's
/// letter dropped, "/" for "\", without package://, file:// or the like and without $(find …) around a
/// package's name.
std::string plain_path(std::string name);

/// The file that is meant, among these in their order, or else one that is the same but for capitals; empty
/// if there is none.
std::filesystem::path first_file(const std::vector<std::filesystem::path>& candidates);

/// Where a URDF's mesh may be: beside the URDF, in one of the folders above it, with or without the package's
/// name, in `mesh_folder` (which its compiler options may name), by the end of its path, as one of another
/// machine, or of that name in a folder `meshes`.
std::vector<std::filesystem::path> places_of_urdf_mesh(const std::filesystem::path& folder,
                                                       const std::filesystem::path& mesh_folder,
                                                       const std::string& name);

/// The files of a model's meshes as MuJoCo is given them: under names of their own, so that files of the same
/// name, and the same file with two scales, are two meshes; those as they are that it reads rightly, all
/// others as binary STL of all their parts.
class MeshStore {
 public:
  struct Entry {
    std::string file;     ///< its name for MuJoCo, "mesh4.stl"; never empty
    std::string problem;  ///< why it could not be read; then `file` is a placeholder
  };

  /// `kind`: what distinguishes meshes of the same file, such as their scale.
  Entry add(const std::filesystem::path& path, const std::string& kind, ReadingNotes& notes);
  /// Why it cannot be read; empty: it can.
  std::string problem(const std::filesystem::path& path, ReadingNotes& notes) {
    return read(path, notes).problem;
  }
  /// A small tetrahedron under a name of its own.
  std::string placeholder();

  /// What is tried after MuJoCo has refused a mesh, under a new name: its convex hull, or, if it was one or
  /// is flat, a placeholder; empty if it was a placeholder.
  std::string simpler(const std::string& file);
  bool is_placeholder(const std::string& file) const { return placeholders_.contains(file); }

  using Bytes = std::shared_ptr<const std::string>;
  const std::map<std::string, Bytes>& files() const { return files_; }

 private:
  struct Kept {
    Bytes bytes = {};
    std::string ending = {}, problem = {};
  };

  const Kept& read(const std::filesystem::path& path, ReadingNotes& notes);
  std::string keep(Bytes bytes, const std::string& ending);

  std::map<std::filesystem::path, Kept> read_;
  std::map<std::pair<std::filesystem::path, std::string>, std::string> names_;
  std::map<std::string, Bytes> files_;
  std::map<std::string, std::filesystem::path> paths_;  ///< of files that are neither hull nor placeholder
  std::set<std::string> placeholders_;
};

}  // namespace amble::morphology
