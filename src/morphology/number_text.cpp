#include "amble/morphology/number_text.hpp"

#include <cmath>
#include <cstdlib>

namespace amble::morphology {

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  for (;;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) return numbers;
    numbers.push_back(number);
    at = end;
  }
}

double number_or_zero(const std::optional<std::string>& text) {
  const double number = text ? std::strtod(text->c_str(), nullptr) : 0.0;
  return std::isfinite(number) ? number : 0.0;
}

double positive_or_zero(const std::optional<std::string>& text) {
  const double number = number_or_zero(text);
  return number > 0.0 && number < 1e9 ? number : 0.0;
}

}  // namespace amble::morphology
