#pragma once

#include <string>
#include <vector>

namespace amble::morphology {

/// The attributes that the installed MuJoCo knows of an MJCF's elements of that name, wherever they stand;
/// none of an element that it does not know.
std::vector<std::string> known_attributes(const std::string& element);

/// The one that was meant by an attribute of an element that has no such: at most two edits away, as slips of
/// the pen are and names of newer versions are not; empty if there is none.
std::string misspelt_attribute(const std::string& element, const std::string& attribute);

}  // namespace amble::morphology
