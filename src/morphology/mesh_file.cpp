#include "amble/morphology/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/io/file.hpp"
#include "amble/morphology/collada.hpp"
#include "amble/morphology/convex_hull.hpp"
#include "amble/morphology/model_bytes.hpp"

namespace amble::morphology {
namespace {

constexpr std::size_t stl_header = 80, stl_start = 84, stl_facet = 50;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// Words between blanks of any kind.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next one; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && blank(text_[at_])) ++at_;
    const std::size_t start = at_;
    while (at_ < text_.size() && !blank(text_[at_])) ++at_;
    return text_.substr(start, at_ - start);
  }

 private:
  static bool blank(char c) { return static_cast<unsigned char>(c) <= ' '; }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// A finite number that is the whole word.
std::optional<float> number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  float value = 0.0F;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) return 0.0F;
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

MeshReading unreadable(std::string problem) {
  return {.shape = {}, .problem = std::move(problem)};
}

MeshReading checked(MeshReading reading) {
  if (reading.problem.empty() && reading.shape.triangles.empty()) reading.problem = "it has no faces";
  return reading;
}

/// A face of any number of corners as triangles around its first.
void add_fan(MeshShape& shape, const std::vector<int>& corners) {
  for (std::size_t k = 2; k < corners.size(); ++k)
    shape.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

MeshReading read_text_stl(std::string_view bytes) {
  MeshReading reading;
  std::vector<int> facet;
  Words words(bytes);
  bool in_facet = false;
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    const std::string kind = word.size() > 8 ? std::string() : lower_case(word);
    if (kind == "facet" || kind == "endloop" || kind == "endfacet") {
      add_fan(reading.shape, facet);
      facet.clear();
      in_facet = kind == "facet" || (in_facet && kind == "endloop");
    } else if (kind == "vertex" && in_facet) {
      std::array<float, 3> corner{};
      for (float& coordinate : corner) {
        const std::string_view text = words.next();
        const auto value = number(text);
        if (!value) return unreadable(fmt::format("'{}' is no coordinate", text));
        coordinate = *value;
      }
      facet.push_back(static_cast<int>(reading.shape.corners.size()));
      reading.shape.corners.push_back(corner);
    }
  }
  add_fan(reading.shape, facet);
  return checked(std::move(reading));
}

std::uint32_t count_at(std::string_view bytes, std::size_t at) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + at, sizeof count);
  return count;
}

MeshReading read_binary_stl(std::string_view bytes) {
  const std::size_t facets = count_at(bytes, stl_header);
  if (bytes.size() < stl_start + stl_facet * facets)
    return unreadable(fmt::format("{} faces are announced, and the file ends before", facets));
  MeshReading reading;
  for (std::size_t f = 0; f < facets; ++f) {
    std::array<std::array<float, 3>, 3> corners{};
    std::memcpy(corners.data(), bytes.data() + stl_start + stl_facet * f + 12, sizeof corners);
    const int first = static_cast<int>(reading.shape.corners.size());
    for (const auto& corner : corners) {
      for (const float coordinate : corner)
        if (!std::isfinite(coordinate)) return unreadable(fmt::format("face {} has no finite corners", f));
      reading.shape.corners.push_back(corner);
    }
    reading.shape.triangles.push_back({first, first + 1, first + 2});
  }
  return checked(std::move(reading));
}

/// Lines of an OBJ, those joined that end in a backslash.
class ObjLines {
 public:
  explicit ObjLines(std::string_view text) : text_(text) {}

  bool next(std::string& line) {
    line.clear();
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find_first_of("\n\r", at_), text_.size());
      line += text_.substr(at_, end - at_);
      at_ = end + 1;
      ++number_;
      const std::size_t last = line.find_last_not_of(" \t");
      if (last == std::string::npos || line[last] != '\\') return true;
      line[last] = ' ';
      if (at_ < text_.size() && text_[end] == '\r' && text_[at_] == '\n') ++at_;
    }
    return !line.empty();
  }
  int number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

class ObjReader {
 public:
  MeshReading read(std::string_view bytes) {
    ObjLines lines(bytes);
    std::string line;
    while (reading_.problem.empty() && lines.next(line)) {
      Words words(line);
      const std::string_view kind = words.next();
      if (kind == "v") add_corner(words);
      if (kind == "f") add_face(words);
      if (kind == "o" || kind == "g") starts_part_ = true;
      if (!reading_.problem.empty()) reading_.problem += fmt::format(" (line {})", lines.number());
    }
    reading_.shape.parts = std::max(parts_, 1);
    return checked(std::move(reading_));
  }

 private:
  void add_corner(Words& words) {
    std::array<float, 3> corner{};
    for (float& coordinate : corner) {
      const std::string_view text = words.next();
      const auto value = number(text);
      if (!value) reading_.problem = fmt::format("'{}' is no coordinate", text);
      coordinate = value.value_or(0.0F);
    }
    reading_.shape.corners.push_back(corner);
  }

  void add_face(Words& words) {
    std::vector<int> face;
    const auto count = static_cast<long>(reading_.shape.corners.size());
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      if (word.starts_with('#')) break;
      long index = 0;
      std::from_chars(word.data(), word.data() + word.size(), index);
      if (index < 0) index += count + 1;  // counted from the end
      if (index < 1 || index > count) {
        reading_.problem = fmt::format("a face names the corner '{}', which is not there", word);
        return;
      }
      face.push_back(static_cast<int>(index - 1));
    }
    if (starts_part_ || parts_ == 0) ++parts_;
    starts_part_ = false;
    if (face.size() > 4) reading_.shape.plain = false;
    add_fan(reading_.shape, face);
  }

  MeshReading reading_;
  int parts_ = 0;
  bool starts_part_ = false;
};

bool looks_like_text(std::string_view bytes) {
  const std::string_view start = bytes.substr(0, bytes.find_last_not_of('\0') + 1).substr(0, 512);
  return std::ranges::all_of(start, [](unsigned char c) { return c != 0 && c != 0xFF; });
}

}  // namespace

// The header of a binary file may begin with "solid" as well: its size tells.
MeshReading read_stl(std::string_view bytes) {
  const bool has_count = bytes.size() >= stl_start;
  const std::uint64_t expected =
      has_count ? stl_start + stl_facet * std::uint64_t{count_at(bytes, stl_header)} : 0;
  if (has_count && expected == bytes.size()) return read_binary_stl(bytes);
  Words words(bytes.substr(0, 4096));
  const std::string first = lower_case(words.next());
  if ((first == "solid" || first == "facet") && looks_like_text(bytes)) return read_text_stl(bytes);
  if (!has_count) return unreadable("it is too short for an STL");
  return read_binary_stl(bytes);
}

MeshReading read_obj(std::string_view bytes) {
  return ObjReader().read(bytes);
}

MeshReading read_msh(std::string_view bytes) {
  constexpr std::size_t counts = 4 * sizeof(std::uint32_t);
  if (bytes.size() < counts) return unreadable("it is too short for an MSH");
  const std::uint64_t vertices = count_at(bytes, 0), normals = count_at(bytes, 4), texts = count_at(bytes, 8),
                      faces = count_at(bytes, 12);
  if (counts + 4 * (3 * (vertices + normals + faces) + 2 * texts) != bytes.size() || vertices < 4)
    return unreadable("its size is not that of its counts");
  MeshReading reading;
  reading.shape.corners.resize(vertices);
  std::memcpy(reading.shape.corners.data(), bytes.data() + counts, 12 * vertices);
  reading.shape.triangles.resize(faces);
  std::memcpy(reading.shape.triangles.data(), bytes.data() + bytes.size() - 12 * faces, 12 * faces);
  for (const auto& corner : reading.shape.corners)
    if (!std::ranges::all_of(corner, [](float c) { return std::isfinite(c); }))
      return unreadable("it has corners that are not finite");
  const auto there = [&](int corner) { return corner >= 0 && static_cast<std::uint64_t>(corner) < vertices; };
  for (const auto& triangle : reading.shape.triangles)
    if (!std::ranges::all_of(triangle, there)) return unreadable("a face names a corner that is not there");
  return reading;
}

std::string lower_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

MeshReading read_mesh(const std::filesystem::path& path) {
  std::string bytes;
  try {
    bytes = io::read_file(path, largest_mesh_bytes);
  } catch (const UserError& error) {
    return unreadable(error.what());
  }
  if (is_lfs_pointer(bytes)) return unreadable(lfs_remark);
  const std::string ending = lower_ending(path);
  if (ending == ".stl") return read_stl(bytes);
  if (ending == ".obj") return read_obj(bytes);
  if (ending == ".msh") return read_msh(bytes);
  if (ending == ".dae") return read_collada(std::move(bytes), path.filename().string());
  return unreadable("neither STL, OBJ, COLLADA nor MSH");
}

std::string stl_bytes(const MeshShape& shape) {
  std::string bytes(stl_start + stl_facet * shape.triangles.size(), '\0');
  const auto count = static_cast<std::uint32_t>(shape.triangles.size());
  std::memcpy(bytes.data() + stl_header, &count, sizeof count);
  char* to = bytes.data() + stl_start + 12;
  for (const auto& triangle : shape.triangles) {
    for (const int corner : triangle) {
      std::memcpy(to, shape.corners[to_index(corner)].data(), 12);
      to += 12;
    }
    to += stl_facet - 36;
  }
  return bytes;
}

bool is_flat(const MeshShape& shape) {
  return hull_of(shape, 4).triangles.empty();
}

MeshShape hull_of(const MeshShape& shape, std::size_t most_corners) {
  std::vector<Vec3> points;
  auto corners = shape.corners;  // each once: an STL has all corners of all faces
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  points.reserve(corners.size());
  for (const auto& corner : corners) points.push_back({corner[0], corner[1], corner[2]});
  const ConvexHull hull = convex_hull(points, most_corners);
  MeshShape simple;
  for (const Vec3 corner : hull.vertices_m)
    simple.corners.push_back(
        {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(corner.z)});
  simple.triangles = hull.triangles;
  return simple;
}

}  // namespace amble::morphology
