#include "amble/morphology/collada.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/core/math.hpp"
#include "amble/morphology/model_bytes.hpp"
#include "amble/morphology/xml_tree.hpp"

namespace amble::morphology {
namespace {

/// So that no file takes unbounded time or memory.
constexpr std::size_t deepest_node = 64, most_shown = 10'000, most_triangles = 4'000'000,
                      most_text = 500'000'000;

/// An affine map, row by row.
using Affine = std::array<double, 12>;
constexpr Affine unmoved{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

Affine operator*(const Affine& a, const Affine& b) {
  Affine product{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) {
      double sum = c == 3 ? a[4 * r + 3] : 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += a[4 * r + k] * b[4 * k + c];
      product[4 * r + c] = sum;
    }
  return product;
}

Vec3 moved(const Affine& by, Vec3 p) {
  return {by[0] * p.x + by[1] * p.y + by[2] * p.z + by[3], by[4] * p.x + by[5] * p.y + by[6] * p.z + by[7],
          by[8] * p.x + by[9] * p.y + by[10] * p.z + by[11]};
}

bool mirrors(const Affine& m) {
  return dot({m[0], m[4], m[8]}, cross({m[1], m[5], m[9]}, {m[2], m[6], m[10]})) < 0.0;
}

template <typename Number>
std::vector<Number> numbers_in(std::string_view text) {
  std::vector<Number> numbers;
  const char *at = text.data(), *const end = text.data() + text.size();
  for (;;) {
    while (at < end && (static_cast<unsigned char>(*at) <= ' ' || *at == '+')) ++at;
    if (at == end) return numbers;
    Number number{};
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error == std::errc::invalid_argument)
      throw UserError("'" + std::string(at, std::min(at + 20, end)) + "' is no number");
    numbers.push_back(number);
    at = stop;
  }
}

Affine rotation(Vec3 axis, double degrees) {
  const double length = norm(axis);
  if (!(length > 0.0)) return unmoved;
  const Vec3 u = (1.0 / length) * axis;
  const double angle = degrees * std::numbers::pi / 180.0, c = std::cos(angle), s = std::sin(angle),
               d = 1.0 - c;
  return {c + u.x * u.x * d,       u.x * u.y * d - u.z * s, u.x * u.z * d + u.y * s, 0,
          u.y * u.x * d + u.z * s, c + u.y * u.y * d,       u.y * u.z * d - u.x * s, 0,
          u.z * u.x * d - u.y * s, u.z * u.y * d + u.x * s, c + u.z * u.z * d,       0};
}

class ColladaReader {
 public:
  explicit ColladaReader(const XmlElement& root) : root_(root) {
    root.visit([&](const XmlElement& element) {
      if (const auto id = element.attribute("id")) by_id_.emplace(*id, &element);
    });
  }

  MeshReading read() {
    const double metre = unit_m();
    const Affine scale{metre, 0, 0, 0, 0, metre, 0, 0, 0, 0, metre, 0};
    if (const XmlElement* scene = visual_scene()) {
      for (const XmlElement& child : scene->children)
        if (child.name == "node") show_node(child, scale, 1);
    } else {
      root_.visit([&](const XmlElement& element) {
        if (element.name == "geometry") show_geometry(element, scale);
      });
    }
    if (reading_.shape.triangles.empty()) throw UserError("its scene has no faces");
    for (const auto& corner : reading_.shape.corners)
      for (const float coordinate : corner)
        if (!std::isfinite(coordinate)) throw UserError("it has corners that are not finite");
    return std::move(reading_);
  }

 private:
  double unit_m() {
    const XmlElement* asset = root_.child("asset");
    if (asset == nullptr) return 1.0;
    if (const XmlElement* up = asset->child("up_axis");
        up != nullptr && up->text.find("Z_UP") == std::string::npos)
      reading_.remarks.emplace_back("its up axis, which is not turned, as in ROS");
    const XmlElement* unit = asset->child("unit");
    const double metre = unit != nullptr ? std::atof(unit->attribute_or("meter", "1").c_str()) : 1.0;
    return metre > 0.0 && std::isfinite(metre) ? metre : 1.0;
  }

  /// What an attribute refers to: "#id".
  const XmlElement* find(const XmlElement& element, std::string_view key) const {
    const std::string name = element.attribute_or(key, "");
    const auto found = by_id_.find(name.starts_with('#') ? name.substr(1) : name);
    return found == by_id_.end() ? nullptr : found->second;
  }

  const XmlElement* visual_scene() const {
    const XmlElement* scene = root_.child("scene");
    const XmlElement* shown = scene != nullptr ? scene->child("instance_visual_scene") : nullptr;
    if (shown != nullptr)
      if (const XmlElement* found = find(*shown, "url")) return found;
    const XmlElement* library = root_.child("library_visual_scenes");
    return library != nullptr ? library->child("visual_scene") : nullptr;
  }

  Affine transform(const XmlElement& element) const {
    if (element.name == "instance_node") return unmoved;
    const std::vector<double> n = numbers_in<double>(element.text);
    const auto needs = [&](std::size_t count) {
      if (n.size() < count) throw UserError("<" + element.name + "> has too few numbers");
    };
    if (element.name == "matrix") {
      needs(16);
      Affine matrix{};
      std::copy_n(n.begin(), 12, matrix.begin());
      return matrix;
    }
    if (element.name == "translate") {
      needs(3);
      return {1, 0, 0, n[0], 0, 1, 0, n[1], 0, 0, 1, n[2]};
    }
    if (element.name == "scale") {
      needs(3);
      return {n[0], 0, 0, 0, 0, n[1], 0, 0, 0, 0, n[2], 0};
    }
    needs(4);
    return rotation({n[0], n[1], n[2]}, n[3]);
  }

  void show_node(const XmlElement& node, Affine at, std::size_t depth) {
    if (depth > deepest_node || ++shown_ > most_shown) throw UserError("its scene is too deep or too large");
    for (const XmlElement& child : node.children) {
      if (child.name == "matrix" || child.name == "translate" || child.name == "scale" ||
          child.name == "rotate")
        at = at * transform(child);
      if (child.name == "skew" || child.name == "lookat")
        reading_.remarks.push_back("<" + child.name + "> of a node");
    }
    for (const XmlElement& child : node.children) {
      if (child.name == "node") show_node(child, at, depth + 1);
      if (child.name == "instance_node")
        if (const XmlElement* other = find(child, "url")) show_node(*other, at, depth + 1);
      if (child.name == "instance_geometry")
        if (const XmlElement* geometry = find(child, "url")) show_geometry(*geometry, at);
      if (child.name == "instance_controller")
        if (const XmlElement* controller = find(child, "url")) show_skin(*controller, at);
    }
  }

  /// A skin in the pose in which it was bound.
  void show_skin(const XmlElement& controller, const Affine& at) {
    const XmlElement* skin = controller.child("skin");
    const XmlElement* geometry = skin != nullptr ? find(*skin, "source") : nullptr;
    if (geometry == nullptr) return;
    const XmlElement* bound = skin->child("bind_shape_matrix");
    if (bound == nullptr) return show_geometry(*geometry, at);
    const std::vector<double> n = numbers_in<double>(bound->text);
    if (n.size() < 16) throw UserError("<bind_shape_matrix> has too few numbers");
    Affine matrix{};
    std::copy_n(n.begin(), 12, matrix.begin());
    show_geometry(*geometry, at * matrix);
  }

  void show_geometry(const XmlElement& geometry, const Affine& at) {
    const XmlElement* mesh = geometry.child("mesh");
    if (mesh == nullptr) mesh = geometry.child("convex_mesh");
    if (mesh == nullptr || ++shown_ > most_shown) return;
    for (const XmlElement& faces : mesh->children) {
      const bool known = faces.name == "triangles" || faces.name == "polylist" || faces.name == "polygons" ||
                         faces.name == "trifans" || faces.name == "tristrips";
      if (known) add_faces(faces, at);
    }
  }

  /// The corners that faces mean by their numbers.
  struct Corners {
    std::size_t offset = 0, stride = 1;  ///< of the number of the corner in a face's list
    std::vector<Vec3> positions;
  };

  std::vector<Vec3> positions(const XmlElement& source) {
    const XmlElement* array = source.child("float_array");
    if (array == nullptr) throw UserError("a source of positions has no numbers");
    count_text(array->text);
    const std::vector<double> n = numbers_in<double>(array->text);
    std::size_t first = 0, stride = 3;
    if (const XmlElement* technique = source.child("technique_common"))
      if (const XmlElement* accessor = technique->child("accessor")) {
        first = std::strtoul(accessor->attribute_or("offset", "0").c_str(), nullptr, 10);
        stride = std::strtoul(accessor->attribute_or("stride", "3").c_str(), nullptr, 10);
      }
    if (stride < 3 || stride > 64) throw UserError("a source of positions has not three numbers each");
    std::vector<Vec3> all;
    for (std::size_t at = first; at < n.size() && n.size() - at >= 3; at += stride)
      all.push_back({n[at], n[at + 1], n[at + 2]});
    return all;
  }

  /// A scene may show the same numbers again and again.
  void count_text(const std::string& text) {
    text_ += text.size();
    if (text_ > most_text) throw UserError("its scene is too large");
  }

  Corners corners_of(const XmlElement& faces) {
    Corners corners;
    const XmlElement* source = nullptr;
    for (const XmlElement& input : faces.children) {
      if (input.name != "input") continue;
      const std::size_t offset = std::strtoul(input.attribute_or("offset", "0").c_str(), nullptr, 10);
      if (offset > 64) throw UserError("faces with too many numbers per corner");
      corners.stride = std::max(corners.stride, offset + 1);
      const std::string semantic = input.attribute_or("semantic", "");
      if (semantic != "VERTEX" && semantic != "POSITION") continue;
      corners.offset = offset;
      source = find(input, "source");
    }
    if (source != nullptr && source->name == "vertices") {
      const XmlElement* vertices = source;
      source = nullptr;
      for (const XmlElement& input : vertices->children)
        if (input.attribute_or("semantic", "") == "POSITION") source = find(input, "source");
    }
    if (source == nullptr) throw UserError("faces whose corners are not there");
    corners.positions = positions(*source);
    return corners;
  }

  void add_faces(const XmlElement& faces, const Affine& at) {
    const Corners corners = corners_of(faces);
    const int base = static_cast<int>(reading_.shape.corners.size());
    for (const Vec3 position : corners.positions) {
      const Vec3 place = moved(at, position);
      reading_.shape.corners.push_back(
          {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)});
    }
    const bool turned = mirrors(at);
    std::vector<std::size_t> sizes;
    if (const XmlElement* counts = faces.child("vcount"); counts != nullptr)
      sizes = numbers_in<std::size_t>(counts->text);
    for (const XmlElement& list : faces.children) {
      const XmlElement* p = list.name == "p" ? &list : list.name == "ph" ? list.child("p") : nullptr;
      if (p == nullptr) continue;
      count_text(p->text);
      const std::vector<std::size_t> numbers = numbers_in<std::size_t>(p->text);
      std::vector<int> all;
      for (std::size_t k = corners.offset; k < numbers.size(); k += corners.stride) {
        if (numbers[k] >= corners.positions.size())
          throw UserError("a face names a corner that is not there");
        all.push_back(base + static_cast<int>(numbers[k]));
      }
      add_polygons(faces.name, all, sizes, turned);
    }
  }

  void add_polygons(const std::string& kind, const std::vector<int>& all,
                    const std::vector<std::size_t>& sizes, bool turned) {
    const auto triangle = [&](int a, int b, int c) {
      if (reading_.shape.triangles.size() >= most_triangles) throw UserError("it has too many faces");
      reading_.shape.triangles.push_back(turned ? std::array{a, c, b} : std::array{a, b, c});
    };
    const auto fan = [&](std::size_t from, std::size_t count) {
      if (from + count > all.size()) throw UserError("a face has fewer corners than announced");
      for (std::size_t k = 2; k < count; ++k) triangle(all[from], all[from + k - 1], all[from + k]);
    };
    if (kind == "triangles") {
      for (std::size_t k = 2; k < all.size(); k += 3) triangle(all[k - 2], all[k - 1], all[k]);
    } else if (kind == "polylist") {
      std::size_t from = 0;
      for (const std::size_t count : sizes) {
        if (count > all.size()) throw UserError("a face has fewer corners than announced");
        fan(from, count);
        from += count;
      }
    } else if (kind == "tristrips") {
      for (std::size_t k = 2; k < all.size(); ++k)
        k % 2 == 0 ? triangle(all[k - 2], all[k - 1], all[k]) : triangle(all[k - 1], all[k - 2], all[k]);
    } else {
      fan(0, all.size());
    }
  }

  const XmlElement& root_;
  std::map<std::string, const XmlElement*> by_id_;
  MeshReading reading_;
  std::size_t shown_ = 0, text_ = 0;
};

}  // namespace

MeshReading read_collada(std::string bytes, const std::string& file) {
  try {
    const XmlElement root = parse_xml(as_utf8(std::move(bytes)), file, {.keep_text = true});
    if (root.name != "COLLADA") return {.shape = {}, .problem = "it is no COLLADA file"};
    return ColladaReader(root).read();
  } catch (const UserError& error) {
    return {.shape = {}, .problem = error.what()};
  }
}

}  // namespace amble::morphology
