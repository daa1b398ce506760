#include "amble/figures/svg.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

#include "amble/core/check.hpp"
#include "amble/io/quoting.hpp"

namespace amble::figures {

namespace {

constexpr std::string_view view_box = " viewBox=\"";
constexpr std::string_view after_size = " role=";

std::string size_attributes(const Box& box) {
  return fmt::format(R"( viewBox="{0} {1} {2} {3}" width="{2}" height="{3}")", number(box.x), number(box.y),
                     number(box.width), number(box.height));
}

}  // namespace

std::string number(double value, int decimals) {
  AMBLE_CHECK(std::isfinite(value), "figures hold finite numbers");
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

Svg::Svg(double width_px, double height_px, std::string_view description) {
  out_ = R"(<svg xmlns="http://www.w3.org/2000/svg")";
  out_ += size_attributes({.x = 0.0, .y = 0.0, .width = width_px, .height = height_px});
  out_ += fmt::format("{}\"img\" aria-label=\"{}\">\n", after_size, io::escape_xml(description));
}

void Svg::begin_group(std::string_view name, std::string_view tooltip) {
  out_ += "<g";
  css_class(name);
  out_ += ">\n";
  if (!tooltip.empty()) out_ += "<title>" + io::escape_xml(tooltip) + "</title>\n";
  ++open_groups_;
}

void Svg::end_group() {
  AMBLE_CHECK(open_groups_ > 0, "no group is open");
  out_ += "</g>\n";
  --open_groups_;
}

void Svg::line(Point from, Point to, std::string_view name) {
  out_ += "<line";
  css_class(name);
  attribute("x1", from.x);
  attribute("y1", from.y);
  attribute("x2", to.x);
  attribute("y2", to.y);
  out_ += "/>\n";
}

void Svg::rect(const Box& box, std::string_view name, double corner_px) {
  out_ += "<rect";
  css_class(name);
  attribute("x", box.x);
  attribute("y", box.y);
  attribute("width", box.width);
  attribute("height", box.height);
  if (corner_px > 0.0) attribute("rx", corner_px);
  out_ += "/>\n";
}

void Svg::circle(Point centre, double radius_px, std::string_view name) {
  out_ += "<circle";
  css_class(name);
  attribute("cx", centre.x);
  attribute("cy", centre.y);
  attribute("r", radius_px);
  out_ += "/>\n";
}

void Svg::bezier(std::span<const Point> chain, std::string_view name, double width_px) {
  AMBLE_CHECK(chain.size() % 3 == 1, "each curve has two control points and an end");
  const auto pair = [](Point point) { return number(point.x, 1) + " " + number(point.y, 1); };
  out_ += "<path";
  css_class(name);
  out_ += " d=\"M" + pair(chain[0]);
  for (std::size_t i = 1; i < chain.size(); ++i) out_ += (i % 3 == 1 ? " C" : " ") + pair(chain[i]);
  out_ += '"';
  if (width_px > 0.0) attribute("stroke-width", width_px);
  out_ += "/>\n";
}

void Svg::polyline(std::span<const Point> corners, std::string_view name) {
  out_ += "<polyline";
  css_class(name);
  points(corners);
}

void Svg::polygon(std::span<const Point> corners, std::string_view name) {
  out_ += "<polygon";
  css_class(name);
  points(corners);
}

void Svg::text(Point at, Anchor anchor, std::string_view name, std::string_view text) {
  out_ += "<text";
  css_class(name);
  attribute("x", at.x);
  attribute("y", at.y);
  if (anchor == Anchor::middle) out_ += " text-anchor=\"middle\"";
  if (anchor == Anchor::end) out_ += " text-anchor=\"end\"";
  out_ += ">" + io::escape_xml(text) + "</text>\n";
}

std::string Svg::finish() {
  AMBLE_CHECK(open_groups_ == 0, "a group is still open");
  return std::move(out_) + "</svg>\n";
}

void Svg::attribute(std::string_view name, double value) {
  out_ += fmt::format(" {}=\"{}\"", name, number(value));
}

void Svg::css_class(std::string_view name) {
  if (!name.empty()) out_ += fmt::format(" class=\"{}\"", name);
}

void Svg::points(std::span<const Point> corners) {
  out_ += " points=\"";
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i > 0) out_ += ' ';
    out_ += number(corners[i].x, 1) + "," + number(corners[i].y, 1);
  }
  out_ += "\"/>\n";
}

std::string with_margin(std::string element, double margin_px) {
  const std::size_t begin = element.find(view_box), end = element.find(after_size);
  AMBLE_CHECK(begin != std::string::npos && end != std::string::npos, "an element written by Svg has a size");
  std::array<double, 4> box{};
  const char* at = element.data() + begin + view_box.size();
  for (double& value : box) at = std::from_chars(at, element.data() + end, value).ptr + 1;
  return element.replace(begin, end - begin,
                         size_attributes({.x = box[0] - margin_px,
                                          .y = box[1] - margin_px,
                                          .width = box[2] + 2.0 * margin_px,
                                          .height = box[3] + 2.0 * margin_px}));
}

}  // namespace amble::figures
