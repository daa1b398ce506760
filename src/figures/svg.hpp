#pragma once

#include <span>
#include <string>
#include <string_view>

/// SVG elements, axes and colours: what all figures and pages are made of.
///
///   svg.hpp           the Svg writer with its points, boxes and numbers
///   axis.hpp          data intervals, ticks, scales, drawn axes
///   figure_size.hpp   widths of figures (wide and narrow), CSS classes of legs
///   style_sheet.hpp   what the CSS classes look like
namespace amble::figures {

/// A point in a figure: px from the left, px from the top, unless its name ends in another unit.
struct Point {
  double x = 0.0, y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

/// A rectangle in a figure, px.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

enum class Anchor { start, middle, end };

/// At most `decimals` decimals, no trailing zeros, a decimal point in every locale, never "-0". `value` must
/// be finite.
std::string number(double value, int decimals = 2);

/// Writes one figure as an <svg> element for inline use in a page. Elements carry CSS classes; their look is
/// in the style sheet (style_sheet.hpp). An element without a class inherits from its group.
class Svg {
 public:
  /// `description` is for screen readers.
  Svg(double width_px, double height_px, std::string_view description);

  /// The tooltip is shown while the pointer is over an element of the group.
  void begin_group(std::string_view css_class, std::string_view tooltip = {});
  void end_group();
  void line(Point from, Point to, std::string_view css_class = {});
  void rect(const Box& box, std::string_view css_class = {}, double corner_px = 0.0);
  void circle(Point centre, double radius_px, std::string_view css_class = {});
  /// A chain of cubic Bézier curves: the start, then two control points and an end for each. Width 0: that of
  /// its class.
  void bezier(std::span<const Point> points, std::string_view css_class = {}, double width_px = 0.0);
  void polyline(std::span<const Point> points, std::string_view css_class = {});
  void polygon(std::span<const Point> points, std::string_view css_class = {});
  void text(Point at, Anchor anchor, std::string_view css_class, std::string_view text);

  /// The whole element. Every group must have been ended.
  std::string finish();

 private:
  void attribute(std::string_view name, double value);
  void css_class(std::string_view name);
  void points(std::span<const Point> points);

  std::string out_;
  int open_groups_ = 0;
};

/// An element written by Svg with that much empty space on each side. (Padding by CSS would do in a page, but
/// cuts a file that an <img> shows.)
std::string with_margin(std::string element, double margin_px);

}  // namespace amble::figures
