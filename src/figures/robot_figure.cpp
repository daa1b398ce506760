#include "amble/figures/robot_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "amble/core/index.hpp"
#include "amble/figures/axis.hpp"
#include "amble/figures/figure_size.hpp"
#include "amble/figures/side_view.hpp"
#include "amble/robot/legs.hpp"
#include "amble/robot/pose.hpp"

namespace amble::figures {
namespace {

constexpr double between_px = 48.0, heading_room_px = 26.0, name_room_px = 40.0, bar_room_px = 30.0,
                 tallest_px = 340.0;

/// What one camera sees, in metres to the right and up.
struct View {
  std::string_view title;
  Camera camera;
  bool stands = true;  ///< on the ground, which is seen from its edge
  std::vector<Silhouette> outlines = {};
  Interval x = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}, y = x;
};

void include(View& view, Point at, double around_m) {
  view.x = {std::min(view.x.lower, at.x - around_m), std::max(view.x.upper, at.x + around_m)};
  view.y = {std::min(view.y.lower, at.y - around_m), std::max(view.y.upper, at.y + around_m)};
}

std::vector<View> views_of(const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses) {
  constexpr Vec3 up{0.0, 0.0, 1.0};
  // Whoever looks at its front has its left on the right.
  std::vector<View> views{{"from its right", side_camera({1.0, 0.0, 0.0})},
                          {"from the front", {{0.0, 1.0, 0.0}, up, {-1.0, 0.0, 0.0}}},
                          {"from above", top_camera(false), false}};
  for (View& view : views) {
    view.outlines = silhouettes(robot, poses, view.camera);
    if (view.stands) include(view, {0.0, 0.0}, 0.0);
    for (const Silhouette& outline : view.outlines) {
      include(view, outline.centre_m, outline.radius_m);
      for (const Point corner : outline.corners_m) include(view, corner, 0.0);
    }
  }
  return views;
}

/// From metres to px: the view's lower left corner is at this place.
struct Place {
  const View& view;
  double left_px, bottom_px, px_per_m;

  Point operator()(Point at) const {
    return {left_px + (at.x - view.x.lower) * px_per_m, bottom_px - (at.y - view.y.lower) * px_per_m};
  }
  double right_px() const { return left_px + view.x.length() * px_per_m; }
};

void draw_outlines(Svg& svg, const robot::RobotSpec& robot, const Place& place) {
  for (const Silhouette& outline : place.view.outlines) {
    const int leg = robot.leg_of_body(robot.geoms[to_index(outline.geom)].body);
    const bool foot = leg >= 0 && robot.legs[to_index(leg)].has_foot_geom(outline.geom);
    svg.begin_group(leg < 0 ? "trunk" : leg_class(leg));
    const char* const css_class = leg < 0 ? "trunk" : foot ? "foot-down" : "limb";
    if (outline.corners_m.empty()) {
      svg.circle(place(outline.centre_m), outline.radius_m * place.px_per_m, css_class);
    } else {
      std::vector<Point> corners;
      for (const Point corner : outline.corners_m) corners.push_back(place(corner));
      svg.polygon(corners, css_class);
    }
    svg.end_group();
  }
}

/// Beside the feet, outside.
void name_legs(Svg& svg, const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses,
               const Place& place) {
  constexpr double off_px = 12.0;
  double middle_m = 0.0;
  for (const robot::Leg& leg : robot.legs)
    middle_m += robot::foot_m(robot, leg, poses).y / static_cast<double>(robot.legs.size());
  for (const robot::Leg& leg : robot.legs) {
    const Vec3 foot_m = robot::foot_m(robot, leg, poses);
    const Point at = place({foot_m.x, foot_m.y >= middle_m ? place.view.y.upper : place.view.y.lower});
    svg.text({at.x, foot_m.y >= middle_m ? at.y - off_px + 4.0 : at.y + off_px + 4.0}, Anchor::middle, "tiny",
             leg.name);
  }
}

void draw_view(Svg& svg, const robot::RobotSpec& robot, const std::vector<robot::Pose>& poses,
               const Place& place) {
  const double middle_px = 0.5 * (place.left_px + place.right_px());
  svg.text({middle_px, heading_room_px - 10.0}, Anchor::middle, "tiny", place.view.title);
  if (place.view.stands) {
    const double ground_px = place({0.0, 0.0}).y;
    svg.line({place.left_px - 8.0, ground_px}, {place.right_px() + 8.0, ground_px}, "ground-line");
  }
  draw_outlines(svg, robot, place);
  if (!place.view.stands) name_legs(svg, robot, poses, place);
}

/// A length of one, two or five tens, of about a sixth of the picture.
void draw_scale(Svg& svg, Point at, double width_px, double px_per_m) {
  const Ticks ticks = nice_ticks({0.0, width_px / px_per_m}, 6);
  const double length_px = ticks.step * px_per_m;
  svg.line(at, {at.x + length_px, at.y}, "scale-bar");
  svg.text({at.x + length_px + 8.0, at.y + 4.0}, Anchor::start, "tiny",
           label(ticks.step, ticks.decimals) + " m");
}

}  // namespace

std::string robot_figure(const robot::RobotSpec& robot) {
  const std::vector<robot::Pose> poses = robot::start_poses(robot);
  const std::vector<View> views = views_of(robot, poses);
  double wide_m = 0.0, high_m = 0.0;
  for (const View& view : views) {
    wide_m += view.x.length();
    high_m = std::max(high_m, view.y.length());
  }
  const double room_px = width_px(FigureSize::wide) - between_px * static_cast<double>(views.size());
  const double px_per_m = std::min(room_px / wide_m, tallest_px / high_m);
  const double bottom_px = heading_room_px + name_room_px + high_m * px_per_m;
  Svg svg(width_px(FigureSize::wide), bottom_px + name_room_px + bar_room_px,
          fmt::format("{} in its start pose, from its right, from the front and from above", robot.name));
  double left_px = 0.5 * (width_px(FigureSize::wide) - wide_m * px_per_m - between_px * 2.0);
  for (const View& view : views) {
    const Place place{view, left_px, bottom_px, px_per_m};
    draw_view(svg, robot, poses, place);
    left_px = place.right_px() + between_px;
  }
  draw_scale(svg, {between_px, bottom_px + name_room_px + 10.0}, room_px, px_per_m);
  const double right_px = width_px(FigureSize::wide) - between_px, y_px = bottom_px + name_room_px + 10.0;
  svg.text({right_px, y_px + 4.0}, Anchor::end, "tiny", "It faces right in the first and the last picture.");
  return svg.finish();
}

}  // namespace amble::figures
