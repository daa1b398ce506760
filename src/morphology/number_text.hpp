#pragma once

#include <optional>
#include <string>
#include <vector>

namespace amble::morphology {

/// The numbers that an attribute's value lists, up to the first that is none.
std::vector<double> numbers_of(const std::string& text);

/// The number that a text begins with if it is finite, else 0.
double number_or_zero(const std::optional<std::string>& text);

/// The same if it is positive and below 1e9, else 0.
double positive_or_zero(const std::optional<std::string>& text);

}  // namespace amble::morphology
