#pragma once

#include <span>
#include <string>
#include <string_view>

namespace amble::analysis {

/// A place in a picture: px from the left, px from the top, unless its name ends in another unit.
struct Point {
  double x = 0.0, y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

/// A rectangle in a picture, px.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

enum class Anchor { start, middle, end };

/// At most `decimals` decimals, trailing zeros cut, a point whatever the locale, never "-0". `value` must be
/// finite.
std::string number(double value, int decimals = 2);

/// The text with <, >, &, " and ' as XML entities; control characters, which XML forbids, become U+FFFD.
std::string escape(std::string_view text);

/// Writes one picture as an <svg> element for inline use in a page. Says what things are by CSS classes; how
/// they look is the page's style sheet (page_style.hpp). An element without a class inherits from its group.
class Svg {
 public:
  /// `description` is what a screen reader says.
  Svg(double width_px, double height_px, std::string_view description);

  /// What a reader points at in the group is named by the tooltip.
  void begin_group(std::string_view css_class, std::string_view tooltip = {});
  void end_group();
  void line(Point from, Point to, std::string_view css_class = {});
  void rect(const Box& box, std::string_view css_class = {}, double corner_px = 0.0);
  void circle(Point centre, double radius_px, std::string_view css_class = {});
  /// A chain of cubic Bézier curves: where it begins, then two control points and an end for each. Without a
  /// width that of its class.
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

}  // namespace amble::analysis
