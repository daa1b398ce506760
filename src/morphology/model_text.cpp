#include "amble/morphology/model_text.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/text.hpp"
#include "amble/morphology/mesh_store.hpp"
#include "amble/morphology/mjcf_text.hpp"
#include "amble/morphology/model_bytes.hpp"
#include "amble/morphology/urdf_text.hpp"

namespace amble::morphology {
namespace {

namespace fs = std::filesystem;

constexpr int most_includes = 32;

std::string place(const XmlElement& element) {
  return fmt::format("{}:{}", element.file, element.line);
}

/// The folder whose files a model may include: the repository or ROS package that it is in, else the folder
/// above its own, so that neighbouring folders count.
fs::path tree_of(const fs::path& folder) {
  std::error_code error;
  const fs::path home = fs::weakly_canonical(folder.empty() ? "." : folder, error);
  fs::path above = home;
  constexpr int most_folders = 8;
  for (int i = 0; i < most_folders && above.has_relative_path(); ++i, above = above.parent_path())
    for (const char* mark : {".git", ".hg", "package.xml"})
      if (fs::exists(above / mark, error)) return i == 0 ? above.parent_path() : above;
  return home.parent_path().has_relative_path() ? home.parent_path() : home;
}

/// Reads MJCF files into one tree.
class Includer {
 public:
  Includer(const fs::path& path, ReadingNotes& notes) : folder_(path.parent_path()), notes_(notes) {}

  /// `root`: of the model's file.
  void include_all(XmlElement& root, const fs::path& path) {
    open_.push_back(path.lexically_normal());
    include_into(root);
    open_.pop_back();
  }

 private:
  void include_into(XmlElement& element) {
    std::vector<XmlElement> children;
    for (XmlElement& child : element.children) {
      if (child.name != "include") {
        include_into(child);
        children.push_back(std::move(child));
        continue;
      }
      for (XmlElement& part : included(child).children) children.push_back(std::move(part));
    }
    element.children = std::move(children);
  }

  XmlElement included(const XmlElement& element) {
    const fs::path name = plain_path(element.attribute_or("file", ""));
    const auto refuse = [&](std::string_view why) {
      fail(ExitCode::bad_input, "{}: <include file=\"{}\">: {}", place(element), name.string(), why);
    };
    if (name.empty()) fail(ExitCode::bad_input, "{}: <include> names no file", place(element));
    if (++includes_ > most_includes)
      fail(ExitCode::bad_input, "{}: more than {} includes", place(element), most_includes);
    const fs::path first = folder_ / name, beside = fs::path(element.file).parent_path() / name;
    // A link inside the tree may lead out of it.
    const fs::path tree = tree_of(folder_);
    const auto is_inside = [&](const fs::path& path) {
      std::error_code error;
      // A relative path of which nothing exists would stay relative.
      const fs::path real = fs::weakly_canonical(fs::absolute(path), error);
      return !error && std::mismatch(tree.begin(), tree.end(), real.begin(), real.end()).first == tree.end();
    };
    if (!is_inside(first) || !is_inside(beside))
      refuse("only files in the model's folder, in its neighbours and in its repository are read");
    const fs::path path = first_file({first, beside});
    if (path.empty()) refuse("there is no such file");
    if (!is_inside(path)) refuse("only files in the model's repository are read");
    if (std::ranges::find(open_, path.lexically_normal()) != open_.end()) refuse("the file includes itself");
    if (path != first && path != beside)
      notes_.add(Reading::replaced, fmt::format("the path of an include, by what is there: {} ({})",
                                                name.string(), path.string()));
    XmlElement root = parse_xml(read_xml_file(path, notes_), path.string());
    include_all(root, path);
    return root;
  }

  fs::path folder_;
  std::vector<fs::path> open_;
  int includes_ = 0;
  ReadingNotes& notes_;
};

/// Prefixes of names that stand for xacro's elements: "xacro:", or what a declaration says.
std::set<std::string> xacro_prefixes(const XmlElement& root) {
  std::set<std::string> prefixes{"xacro:"};
  root.visit([&](const XmlElement& element) {
    for (const auto& [key, value] : element.attributes)
      if (key.starts_with("xmlns:") && value.find("xacro") != std::string::npos)
        prefixes.insert(key.substr(6) + ":");
  });
  return prefixes;
}

/// Whether something in it is left to xacro to fill in. A mesh's package may be looked for without.
bool has_macros(const XmlElement& root) {
  const std::set<std::string> prefixes = xacro_prefixes(root);
  bool macros = false;
  root.visit([&](const XmlElement& element) {
    for (const std::string& prefix : prefixes) macros = macros || element.name.starts_with(prefix);
    for (const auto& [key, value] : element.attributes) {
      const bool package = element.name == "mesh" && key == "filename" && value.starts_with("$(find");
      macros = macros || value.find("${") != std::string::npos ||
               (!package && value.find("$(") != std::string::npos);
    }
  });
  return macros;
}

/// A URDF with macros, which a program of ROS expands. Expanded files still declare its names.
void refuse_xacro(const XmlElement& root, const fs::path& path) {
  if (!has_macros(root)) return;
  const std::string file = path.string(), stem = path.stem().string();
  const std::string expanded = path.extension() == ".urdf" ? stem + "_expanded.urdf"
                               : stem.ends_with(".urdf")   ? stem
                                                           : stem + ".urdf";
  fail(ExitCode::bad_input, "{}: a xacro file, a URDF with macros; expand it first: xacro {} > {}", file,
       io::shell_word(file), io::shell_word(free_path(path.parent_path() / expanded).string()));
}

/// A URDF has no includes of its own: what another program would have put there is never left out silently.
void refuse_includes(const XmlElement& root) {
  root.visit([](const XmlElement& element) {
    const std::size_t colon = element.name.find(':');
    const std::string name = element.name.substr(colon == std::string::npos ? 0 : colon + 1);
    if (name == "include")
      fail(ExitCode::bad_input,
           "{}: <{}>: an include, which URDF does not have: name the file that it is resolved in, or let the "
           "program that knows it write that file",
           place(element), element.name);
  });
}

/// What of bodies and shapes must be finite; limits need not.
bool must_be_finite(const XmlElement& element, std::string_view key) {
  static constexpr std::array<std::string_view, 23> keys{
      "mass",   "density", "diaginertia", "fullinertia", "ixx",  "iyy",    "izz",   "ixy",
      "ixz",    "iyz",     "pos",         "xyz",         "rpy",  "quat",   "euler", "axisangle",
      "xyaxes", "zaxis",   "axis",        "fromto",      "size", "radius", "length"};
  if (key == "size" && element.attribute_or("type", "") == "plane") return false;
  return (element.name == "mass" && key == "value") || std::ranges::find(keys, key) != keys.end();
}

/// Numbers that are none: MuJoCo takes some of them for no limit, others spread through the whole model.
void refuse_nan(const XmlElement& root) {
  root.visit([](const XmlElement& element) {
    for (const auto& [key, value] : element.attributes) {
      std::istringstream words(value);
      bool numbers = true, nan = false, infinite = false;
      for (std::string word; words >> word;) {
        char* end = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        nan = std::isnan(number) || nan;
        infinite = std::isinf(number) || infinite;
        numbers = numbers && *end == '\0';
      }
      infinite = infinite && must_be_finite(element, key);
      if ((nan || infinite) && numbers && key != "name")
        fail(ExitCode::bad_input, "{}: <{}> has {} = '{}': expected {}numbers", place(element), element.name,
             key, value, nan ? "" : "finite ");
    }
  });
}

void refuse_other_formats(const XmlElement& root, const fs::path& path) {
  const std::string file = path.string();
  if (root.name == "sdf" || root.name == "gazebo") {
    const std::string made = path.stem().string() + (path.extension() == ".xml" ? "_mjcf.xml" : ".xml");
    fail(ExitCode::bad_input,
         "{}: an SDF file, Gazebo's; amble reads MJCF and URDF; convert it first: sdf2mjcf {} {} (of the "
         "Python package sdformat-mjcf), or take the URDF that it was made from",
         file, io::shell_word(file), io::shell_word(free_path(path.parent_path() / made).string()));
  }
  if (root.name != "robot" && root.name != "mujoco" && root.name != "mujocoinclude")
    fail(ExitCode::bad_input, "{}: its first element is <{}>: expected MJCF, <mujoco>, or URDF, <robot>",
         file, root.name);
}

std::string file_and_line(const XmlElement& element) {
  return fmt::format("{}:{}", element.file, element.line);
}

std::string in_quotes(const std::string& name) {
  return fmt::format("'{}'", io::printable(name));
}

/// Elements by kind and name, each once.
class NamesOfKinds {
 public:
  void add(const XmlElement& element, std::string_view kind) {
    const std::string name = element.attribute_or("name", "");
    if (name.empty()) return;
    const auto [other, is_new] = first_.try_emplace({std::string(kind), name}, &element);
    if (!is_new)
      fail(ExitCode::bad_input,
           "{}: a second {} is called {}, as that of {} is: each needs a name of its own",
           file_and_line(element), kind, in_quotes(name), file_and_line(*other->second));
  }

 private:
  std::map<std::pair<std::string, std::string>, const XmlElement*> first_;
};

/// A joint of a URDF and the links that it joins.
struct UrdfJoint {
  const XmlElement* element = nullptr;
  std::string name, parent, child;
};

std::string link_of(const XmlElement& joint, const char* end) {
  const XmlElement* named = joint.child(end);
  std::string link = named == nullptr ? "" : named->attribute_or("link", "");
  if (link.empty())
    fail(ExitCode::bad_input, "{}: joint {} has no <{} link=\"…\"/>", file_and_line(joint),
         in_quotes(joint.attribute_or("name", "")), end);
  return link;
}

/// Joints by the link behind them.
std::map<std::string, UrdfJoint> joints_by_child(const XmlElement& root) {
  std::map<std::string, UrdfJoint> joints;
  std::set<std::string> links;
  for (const XmlElement& element : root.children)
    if (element.name == "link") links.insert(element.attribute_or("name", ""));
  for (const XmlElement& element : root.children) {
    if (element.name != "joint") continue;
    UrdfJoint joint{&element, element.attribute_or("name", ""), link_of(element, "parent"),
                    link_of(element, "child")};
    for (const std::string& link : {joint.parent, joint.child})
      if (!links.contains(link))
        fail(ExitCode::bad_input, "{}: joint {} names the link {}, which is not there",
             file_and_line(element), in_quotes(joint.name), in_quotes(link));
    const auto [other, is_new] = joints.try_emplace(joint.child, joint);
    if (!is_new)
      fail(ExitCode::bad_input,
           "{}: link {} is the child of two joints, {} and {} of {}: closed loops are not supported",
           file_and_line(element), in_quotes(joint.child), in_quotes(joint.name),
           in_quotes(other->second.name), file_and_line(*other->second.element));
  }
  return joints;
}

}  // namespace

void take_mesh(ModelText& text, XmlElement& element, const std::string& key, const std::string& named,
               const fs::path& path, ReadingNotes& notes) {
  MeshStore::Entry entry;
  if (path.empty())
    entry = {text.meshes.placeholder(), "not found"};
  else
    entry = text.meshes.add(path, element.attribute_or("scale", ""), notes);
  element.set(key, entry.file);
  const std::string mesh =
      text.urdf ? fs::path(entry.file).stem().string() : element.attribute_or("name", "");
  text.mesh_files[mesh] = named;
  if (entry.problem.empty()) return;
  text.missing_meshes[mesh] = fmt::format("{} ({})", named, entry.problem);
  for (const char* other :
       {"vertex", "face", "normal", "texcoord", "scale", "content_type", "refpos", "refquat"})
    element.remove_attribute(other);
}

ModelText read_model_text(const fs::path& path, ReadingNotes& notes) {
  ModelText text;
  text.root = parse_xml(read_xml_file(path, notes), path.string());
  refuse_other_formats(text.root, path);
  text.urdf = text.root.name == "robot";
  if (text.urdf) {
    refuse_xacro(text.root, path);
    refuse_includes(text.root);
    refuse_nan(text.root);
    refuse_repeated_names(text.root, true);
    refuse_odd_tree(text.root);
    clean_urdf(text, path, notes);
  } else {
    Includer(path, notes).include_all(text.root, path);
    refuse_nan(text.root);
    refuse_repeated_names(text.root, false);
    clean_mjcf(text, path, notes);
  }
  return text;
}

void refuse_repeated_names(const XmlElement& root, bool urdf) {
  NamesOfKinds names;
  for (const XmlElement& section : root.children) {
    if (urdf && (section.name == "link" || section.name == "joint")) names.add(section, section.name);
    if (urdf || (section.name != "worldbody" && section.name != "asset")) continue;
    section.visit([&](const XmlElement& element) {
      static constexpr std::array<std::string_view, 5> kinds{"body", "joint", "geom", "site", "mesh"};
      const std::string_view kind = element.name == "freejoint" ? "joint" : std::string_view(element.name);
      if (std::ranges::find(kinds, kind) != kinds.end()) names.add(element, kind);
    });
  }
}

void refuse_odd_tree(const XmlElement& root) {
  const std::map<std::string, UrdfJoint> joints = joints_by_child(root);
  for (const auto& [start, first] : joints) {
    std::vector<std::string> links{in_quotes(start)}, by;
    const UrdfJoint* joint = &first;
    // Upwards, for as many links as there are at most.
    for (std::size_t i = 0; i < joints.size(); ++i) {
      links.push_back(in_quotes(joint->parent));
      by.push_back(in_quotes(joint->name));
      if (joint->parent == start)
        fail(ExitCode::bad_input,
             "{}: links hang on each other in a loop: {}, by the joints {}: a robot's links are a tree, with "
             "one link that no joint has as its child",
             file_and_line(*first.element), fmt::join(links, " on "), fmt::join(by, ", "));
      const auto above = joints.find(joint->parent);
      if (above == joints.end()) break;
      joint = &above->second;
    }
  }
}

}  // namespace amble::morphology
