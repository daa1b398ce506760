#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

}  // namespace amble::morphology
