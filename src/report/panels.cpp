#include "amble/report/panels.hpp"

namespace amble::report {
namespace {

/// Typical advances of sans-serif fonts.
double advance_px(char c) {
  if (std::string_view("ijlt.,:;'|! fI()[]").find(c) != std::string_view::npos) return 5.0;
  if (std::string_view("mwMW%@").find(c) != std::string_view::npos) return 13.0;
  return c >= 'A' && c <= 'Z' ? 10.2 : 8.7;
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
  // Titles of a study often differ at their end, so both ends are kept, of the end a third.
  constexpr double ellipsis_px = 10.0;
  const double room_px = width_px - ellipsis_px;
  std::string_view back = label, front = label;
  while (!back.empty() && label_width_px(back) > room_px / 3.0) {
    back.remove_prefix(1);
    while (!back.empty() && continues(back.front())) back.remove_prefix(1);
  }
  while (back.starts_with(' ') || back.starts_with(',')) back.remove_prefix(1);
  while (!front.empty() && label_width_px(front) > room_px - label_width_px(back)) {
    while (continues(front.back()) && front.size() > 1) front.remove_suffix(1);
    front.remove_suffix(1);
  }
  while (front.ends_with(' ') || front.ends_with(',')) front.remove_suffix(1);
  return std::string(front) + "…" + std::string(back);
}

void draw_panel_title(figures::Svg& svg, const PanelGrid& grid, const figures::Box& plot,
                      std::string_view label, std::string_view value, double value_px) {
  const double left = plot.x - grid.left_px + 8.0;
  const auto lines = two_lines(label, plot.right() - left - value_px);
  for (std::size_t i = 0; i < lines.size(); ++i)
    svg.text({left, plot.y - 10 - 15.0 * static_cast<double>(lines.size() - 1 - i)}, figures::Anchor::start,
             "label", lines[i]);
  svg.text({plot.right(), plot.y - 10}, figures::Anchor::end, "value", value);
}

std::vector<std::string> two_lines(std::string_view label, double width_px) {
  if (label_width_px(label) <= width_px) return {std::string(label)};
  std::size_t cut = 0;
  for (std::size_t at = label.find(' '); at != label.npos; at = label.find(' ', at + 1))
    if (label_width_px(label.substr(0, at)) <= width_px) cut = at;
  if (cut == 0) return {fitted(label, width_px)};
  return {std::string(label.substr(0, cut)), fitted(label.substr(cut + 1), width_px)};
}

}  // namespace amble::report
