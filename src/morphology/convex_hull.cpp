#include "amble/morphology/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "amble/core/index.hpp"

namespace amble::morphology {
namespace {

/// Points this near to a face, as a share of the hull's size, are part of it.
constexpr double flatness = 1e-7;

struct Face {
  std::array<int, 3> corners;
  Vec3 normal;  ///< unit length, outward
  double offset_m = 0.0;
  int farthest = -1;  ///< the point farthest outside of it
  double distance_m = 0.0;
};

class HullBuilder {
 public:
  HullBuilder(std::span<const Vec3> points_m, std::size_t most_vertices)
      : points_(points_m), most_vertices_(most_vertices) {}

  ConvexHull build() {
    if (!add_first_tetrahedron()) return {};
    for (std::size_t vertices = 4; vertices < most_vertices_; ++vertices) {
      const auto face = std::ranges::max_element(faces_, {}, &Face::distance_m);
      if (face->distance_m <= tolerance_m_) break;
      if (!add(face->farthest)) break;
    }
    return hull();
  }

 private:
  Vec3 point(int i) const { return points_[to_index(i)]; }

  /// The point for which `measure` is largest.
  template <typename Measure>
  int farthest(Measure measure) const {
    int best = 0;
    double most = measure(point(0));
    for (int i = 1; i < static_cast<int>(points_.size()); ++i) {
      const double value = measure(point(i));
      if (value > most) {
        most = value;
        best = i;
      }
    }
    return best;
  }

  bool add_first_tetrahedron() {
    if (points_.size() < 4) return false;
    const int a = farthest([](Vec3 p) { return p.x + 1e-3 * p.y + 1e-6 * p.z; });
    const int b = farthest([&](Vec3 p) { return norm(p - point(a)); });
    const double size_m = norm(point(b) - point(a));
    tolerance_m_ = flatness * size_m;
    if (!(size_m > 0.0) || !std::isfinite(size_m)) return false;
    const Vec3 along = (1.0 / size_m) * (point(b) - point(a));
    const auto off_line = [&](Vec3 p) { return norm(cross(along, p - point(a))); };
    const int c = farthest(off_line);
    if (!(off_line(point(c)) > tolerance_m_)) return false;
    Vec3 normal = cross(along, point(c) - point(a));
    normal = (1.0 / norm(normal)) * normal;
    const auto off_plane = [&](Vec3 p) { return std::abs(dot(normal, p - point(a))); };
    const int d = farthest(off_plane);
    if (!(off_plane(point(d)) > tolerance_m_)) return false;
    inside_ = 0.25 * (point(a) + point(b) + point(c) + point(d));
    for (const auto& corners : {std::array{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) add_face(corners);
    return true;
  }

  void add_face(std::array<int, 3> corners) {
    Vec3 normal = cross(point(corners[1]) - point(corners[0]), point(corners[2]) - point(corners[0]));
    const double length = norm(normal);
    if (length > 0.0) normal = (1.0 / length) * normal;
    if (dot(normal, inside_ - point(corners[0])) > 0.0) {
      std::swap(corners[1], corners[2]);
      normal = -normal;
    }
    Face face{corners, normal, dot(normal, point(corners[0]))};
    if (length > 0.0) {
      face.farthest = farthest([&](Vec3 p) { return dot(normal, p); });
      face.distance_m = dot(normal, point(face.farthest)) - face.offset_m;
    }
    faces_.push_back(face);
  }

  /// Replaces the faces that see the point by faces to the edges of their rim. False if rounding has left no
  /// clean rim.
  bool add(int p) {
    std::set<std::pair<int, int>> edges;
    std::vector<Face> kept;
    for (const Face& face : faces_) {
      if (dot(face.normal, point(p)) - face.offset_m <= 0.01 * tolerance_m_) {
        kept.push_back(face);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const std::pair edge{face.corners[i], face.corners[(i + 1) % 3]};
        // An edge shared by two removed faces is met in both directions.
        if (edges.erase({edge.second, edge.first}) == 0) edges.insert(edge);
      }
    }
    if (kept.empty() || edges.size() < 3) return false;
    std::set<int> starts;
    for (const auto& edge : edges)
      if (edge.first == p || edge.second == p || !starts.insert(edge.first).second) return false;
    faces_ = std::move(kept);
    for (const auto& [from, to] : edges) add_face({from, to, p});
    return true;
  }

  ConvexHull hull() const {
    ConvexHull hull;
    std::vector<int> place(points_.size(), -1);
    for (const Face& face : faces_) {
      std::array<int, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        int& at = place[to_index(face.corners[i])];
        if (at < 0) {
          at = static_cast<int>(hull.vertices_m.size());
          hull.vertices_m.push_back(point(face.corners[i]));
        }
        corners[i] = at;
      }
      hull.triangles.push_back(corners);
    }
    return hull;
  }

  std::span<const Vec3> points_;
  std::size_t most_vertices_;
  double tolerance_m_ = 0.0;
  Vec3 inside_;
  std::vector<Face> faces_;
};

}  // namespace

ConvexHull convex_hull(std::span<const Vec3> points_m, std::size_t most_vertices) {
  return HullBuilder(points_m, most_vertices).build();
}

}  // namespace amble::morphology
