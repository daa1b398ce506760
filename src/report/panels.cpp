#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

/// Typical advances of sans-serif fonts.
double advance_px(char c) {
  if (std::string_view("ijlt.,:;'|! fI()[]").find(c) != std::string_view::npos) return 4.3;
  if (std::string_view("mwMW%@").find(c) != std::string_view::npos) return 11.5;
  return c >= 'A' && c <= 'Z' ? 9.2 : 7.7;
}

/// Bytes after the first of a character in UTF-8.
bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

}  // namespace

double label_width_px(std::string_view label) {
  double width = 0.0;
  for (const char c : label)
    if (!continues(c)) width += advance_px(c);
  return width;
}

std::string fitted(std::string_view label, double width_px) {
  if (label_width_px(label) <= width_px) return std::string(label);
  while (!label.empty() && label_width_px(label) > width_px - 10.0) {
    while (continues(label.back()) && label.size() > 1) label.remove_suffix(1);
    label.remove_suffix(1);
  }
  while (label.ends_with(' ') || label.ends_with(',')) label.remove_suffix(1);
  return std::string(label) + "…";
}

}  // namespace amble::report
