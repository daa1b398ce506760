#include "amble/morphology/model_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/io/file.hpp"
#include "amble/io/shell.hpp"
#include "amble/morphology/urdf_text.hpp"

namespace amble::morphology {
namespace {

namespace fs = std::filesystem;

constexpr int most_includes = 32;

std::string place(const XmlElement& element) {
  return fmt::format("{}:{}", element.file, element.line);
}

/// Reads MJCF files into one tree.
class Includer {
 public:
  explicit Includer(const fs::path& path) : folder_(path.parent_path()) {}

  XmlElement read(const fs::path& path) {
    XmlElement root = parse_xml(io::read_file(path, largest_file_bytes), path.string());
    open_.push_back(path.lexically_normal());
    include_into(root);
    open_.pop_back();
    return root;
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
    const fs::path name = element.attribute_or("file", "");
    if (name.empty()) fail(ExitCode::bad_input, "{}: <include> names no file", place(element));
    const bool outside = name.is_absolute() || std::ranges::find(name, fs::path("..")) != name.end();
    if (outside)
      fail(ExitCode::bad_input, "{}: <include file=\"{}\">: only files in the model's folder are read",
           place(element), name.string());
    if (++includes_ > most_includes)
      fail(ExitCode::bad_input, "{}: more than {} includes", place(element), most_includes);
    fs::path path = folder_ / name;
    const fs::path beside = fs::path(element.file).parent_path() / name;
    if (std::error_code error; !fs::exists(path, error) && fs::exists(beside, error)) path = beside;
    if (std::ranges::find(open_, path.lexically_normal()) != open_.end())
      fail(ExitCode::bad_input, "{}: <include file=\"{}\">: the file includes itself", place(element),
           name.string());
    // A link inside the folder may lead out of it.
    std::error_code error;
    const fs::path real = fs::canonical(path, error), home = fs::canonical(folder_.empty() ? "." : folder_);
    if (!error && std::mismatch(home.begin(), home.end(), real.begin(), real.end()).first != home.end())
      fail(ExitCode::bad_input, "{}: <include file=\"{}\">: only files in the model's folder are read",
           place(element), name.string());
    return read(path);
  }

  fs::path folder_;
  std::vector<fs::path> open_;
  int includes_ = 0;
};

/// Attributes of MJCF elements with those of their default classes. All sections <default> are one class at
/// the top, whatever they call it: a later one changes it for all that comes after, and the last is that of
/// elements without a class.
class Defaults {
 public:
  explicit Defaults(const XmlElement& root) {
    for (const XmlElement& child : root.children) {
      if (child.name != "default") continue;
      tops_.push_back({&child, tops_.empty() ? nullptr : &tops_.back()});
      top_names_.insert(child.attribute_or("class", "main"));
      add_within(child, tops_.back());
    }
  }

  /// `childclass`: of elements that name no class; empty: that at the top.
  std::optional<std::string> attribute(const XmlElement& element, std::string_view key,
                                       const std::string& childclass) const {
    if (auto own = element.attribute(key)) return own;
    for (const Class* at = find(element.attribute_or("class", childclass)); at != nullptr; at = at->parent) {
      const auto& settings = at->settings->children;
      for (auto its = settings.rbegin(); its != settings.rend(); ++its)
        if (its->name == element.name)
          if (auto value = its->attribute(key)) return value;
    }
    return std::nullopt;
  }

 private:
  struct Class {
    const XmlElement* settings;
    const Class* parent;
  };

  const Class* find(const std::string& name) const {
    if (name.empty() || top_names_.contains(name)) return tops_.empty() ? nullptr : &tops_.back();
    const auto found = classes_.find(name);
    return found == classes_.end() ? nullptr : &found->second;
  }

  void add_within(const XmlElement& element, const Class& parent) {
    for (const XmlElement& child : element.children) {
      const auto name = child.attribute("class");
      if (child.name != "default" || !name) continue;
      const auto [added, is_new] = classes_.try_emplace(*name, Class{&child, &parent});
      if (is_new) add_within(child, added->second);
    }
  }

  std::deque<Class> tops_;
  std::set<std::string> top_names_;
  std::map<std::string, Class> classes_;
};

/// Makes an MJCF tree one that MuJoCo 2.2 reads.
class MjcfCleaner {
 public:
  MjcfCleaner(ModelText& text, const fs::path& path, ReadingNotes& notes)
      : text_(text), root_(text.root), folder_(path.parent_path()), notes_(notes) {}

  void clean() {
    refuse_generators();
    read_motors();
    remove_unneeded();
    set_compiler();
    replace_missing_meshes();
    root_.visit([](XmlElement& element, XmlElement*) {
      if (element.name != "key") return;
      // Numbers of actuators and activations, which may be left out.
      for (const char* key : {"ctrl", "act", "mpos", "mquat", "qvel"}) element.remove_attribute(key);
    });
  }

 private:
  void refuse_generators() const {
    root_.visit([](const XmlElement& element) {
      for (const char* name : {"composite", "replicate", "attach", "frame", "flexcomp"})
        if (element.name == name)
          fail(ExitCode::bad_input,
               "{}: <{}>: elements that make or move bodies when the model is compiled are not read; let "
               "MuJoCo write the model out (compile model.xml out.xml)",
               place(element), name);
    });
  }

  void read_motors() {
    const Defaults defaults(root_);
    const auto in_bodies = [&](const auto& self, const XmlElement& element,
                               const std::string& above) -> void {
      const std::string childclass = element.attribute_or("childclass", above);
      for (const XmlElement& child : element.children) {
        if (child.name == "body") self(self, child, childclass);
        if (child.name != "joint") continue;
        const auto range = defaults.attribute(child, "actuatorfrcrange", childclass);
        const std::size_t blank = range ? range->find_last_of(" \t\n") : std::string::npos;
        if (blank != std::string::npos)
          text_.motors[child.attribute_or("name", "")].max_torque_nm =
              positive_or_zero(range->substr(blank + 1));
      }
    };
    for (const XmlElement& section : root_.children) {
      if (section.name == "worldbody") in_bodies(in_bodies, section, "");
      if (section.name != "actuator") continue;
      for (const XmlElement& actuator : section.children)
        if (actuator.name == "position")
          if (const double kv = positive_or_zero(defaults.attribute(actuator, "kv", "")); kv > 0.0)
            text_.motors[actuator.attribute_or("joint", "")].kv_nm_s_per_rad = kv;
    }
  }

  void remove_unneeded() {
    struct Unneeded {
      std::string_view name, why;
      bool anywhere = false;  ///< else only among sections and assets
    };
    static constexpr std::string_view height_fields = "height fields: the ground is the experiment's";
    static constexpr std::array<Unneeded, 11> all{
        {{"sensor", "sensors: controllers read feet, joint angles and the root's attitude"},
         {"visual", "settings of MuJoCo's viewer"},
         {"statistic", "settings of MuJoCo's viewer"},
         {"size", "sizes of MuJoCo's memory"},
         {"custom", "custom numbers and texts"},
         {"extension", "plugins"},
         {"plugin", "plugins", true},
         {"deformable", "deformable parts"},
         {"skin", "skins", true},
         {"texture", "textures: geoms have one colour each"},
         {"hfield", height_fields}}};
    const auto unwanted = [&](const XmlElement& element, const XmlElement& parent) {
      const bool of_section = &parent == &root_ || parent.name == "asset";
      const auto found = std::ranges::find(all, element.name, &Unneeded::name);
      std::string_view why;
      if (found != all.end() && (found->anywhere || of_section)) why = found->why;
      if (element.name == "geom" && element.attribute("hfield")) why = height_fields;
      if (!why.empty()) notes_.add(Reading::left_out, std::string(why));
      return !why.empty();
    };
    root_.prune(unwanted);
    root_.visit([](XmlElement& element, XmlElement*) {
      if (element.name == "material") element.remove_attribute("texture");
    });
  }

  void set_compiler() {
    XmlElement* compiler = root_.child("compiler");
    if (compiler == nullptr) {
      root_.children.insert(root_.children.begin(), XmlElement{.name = "compiler", .file = root_.file});
      compiler = &root_.children.front();
    }
    for (XmlElement& section : root_.children) {
      if (section.name != "compiler") continue;
      if (const auto folder = section.attribute("assetdir"); folder && !section.attribute("meshdir"))
        section.set("meshdir", *folder);
      section.remove_attribute("assetdir");
      section.remove_attribute("texturedir");
      if (section.attribute("meshdir")) mesh_folder_ = *section.attribute("meshdir");
      if (section.attribute_or("strippath", "false") == "true") strip_path_ = true;
    }
    // The default of MuJoCo 3; where a model is written for 2.2 without it, a range needs `limited` anyway.
    if (!compiler->attribute("autolimits")) compiler->set("autolimits", "true");
  }

  void replace_missing_meshes() {
    root_.visit([this](XmlElement& element, XmlElement* parent) {
      if (element.name != "mesh" || parent == nullptr || parent->name != "asset") return;
      const auto file = element.attribute("file");
      if (!file) return;
      const fs::path name = strip_path_ ? fs::path(*file).filename() : fs::path(*file);
      if (!element.attribute("name")) element.set("name", name.stem().string());
      const fs::path path = folder_ / mesh_folder_ / name;
      if (is_readable_mesh(path)) return;
      text_.missing_meshes[*element.attribute("name")] = *file + (is_text_stl(path) ? text_stl_remark : "");
      for (const char* key : {"file", "vertex", "face", "normal", "texcoord", "scale", "content_type"})
        element.remove_attribute(key);
      element.set("vertex", "0 0 0 .001 0 0 0 .001 0 0 0 .001");
    });
  }

  ModelText& text_;
  XmlElement& root_;
  fs::path folder_, mesh_folder_;
  bool strip_path_ = false;
  ReadingNotes& notes_;
};

bool has_ending(const fs::path& path, std::string_view ending) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension == ending;
}

/// A URDF with macros, which a program of ROS expands. Expanded files still declare its names.
void refuse_xacro(const XmlElement& root, const fs::path& path) {
  bool macros = path.extension() == ".xacro";
  root.visit([&](const XmlElement& element) {
    macros = macros || element.name.starts_with("xacro:");
    for (const auto& [key, value] : element.attributes)
      macros = macros || value.find("${") != std::string::npos || value.find("$(") != std::string::npos;
  });
  if (root.name != "robot" || !macros) return;
  const std::string file = path.string(), stem = path.stem().string();
  const std::string expanded = path.extension() == ".urdf" ? stem + "_expanded.urdf"
                               : stem.ends_with(".urdf")   ? stem
                                                           : stem + ".urdf";
  fail(ExitCode::bad_input, "{}: a xacro file, a URDF with macros; expand it first: xacro {} > {}", file,
       io::shell_word(file), io::shell_word((path.parent_path() / expanded).string()));
}

/// Numbers that are none: MuJoCo takes some of them for no limit, others spread through the whole model.
void refuse_nan(const XmlElement& root) {
  root.visit([](const XmlElement& element) {
    for (const auto& [key, value] : element.attributes) {
      std::istringstream words(value);
      bool numbers = true, nan = false;
      for (std::string word; words >> word;) {
        char* end = nullptr;
        nan = std::isnan(std::strtod(word.c_str(), &end)) || nan;
        numbers = numbers && *end == '\0';
      }
      if (nan && numbers && key != "name")
        fail(ExitCode::bad_input, "{}: <{}> has {} = '{}': expected numbers", place(element), element.name,
             key, value);
    }
  });
}

}  // namespace

double positive_or_zero(const std::optional<std::string>& text) {
  const double number = text ? std::strtod(text->c_str(), nullptr) : 0.0;
  return number > 0.0 && number < 1e9 ? number : 0.0;
}

// It begins with "solid", as the header of a binary file may, and has not the size that a binary file has.
bool is_text_stl(const fs::path& path) {
  constexpr std::size_t header = 80, count = 4, facet = 50;
  std::error_code error;
  if (!has_ending(path, ".stl") || !fs::is_regular_file(path, error)) return false;
  const std::string start = io::InputFile(path).read(header + count);
  if (!start.starts_with("solid")) return false;
  if (start.size() < header + count) return true;
  std::uint32_t facets = 0;
  std::memcpy(&facets, start.data() + header, sizeof facets);
  return fs::file_size(path) != header + count + facet * std::uint64_t{facets};
}

bool is_readable_mesh(const fs::path& path) {
  std::error_code error;
  return (has_ending(path, ".stl") || has_ending(path, ".obj") || has_ending(path, ".msh")) &&
         fs::is_regular_file(path, error) && fs::file_size(path, error) <= largest_file_bytes &&
         !is_text_stl(path);
}

ModelText read_model_text(const fs::path& path, ReadingNotes& notes) {
  ModelText text;
  text.urdf = path.extension() == ".urdf";
  if (text.urdf) {
    text.root = parse_xml(io::read_file(path, largest_file_bytes), path.string());
    refuse_xacro(text.root, path);
    clean_urdf(text, path, notes);
  } else {
    text.root = Includer(path).read(path);
    refuse_xacro(text.root, path);
    // An unknown root is left to the compiler, as unknown elements are.
    MjcfCleaner(text, path, notes).clean();
  }
  refuse_nan(text.root);
  return text;
}

}  // namespace amble::morphology
