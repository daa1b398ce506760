#include "amble/morphology/model_file.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/missing_mass.hpp"
#include "amble/morphology/mjcf_schema.hpp"
#include "amble/morphology/model_shapes.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::morphology {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// Files in memory, from which MuJoCo reads a text and its meshes.
class MemoryFiles {
 public:
  MemoryFiles() : files_(std::make_unique<mjVFS>()) { mj_defaultVFS(files_.get()); }
  ~MemoryFiles() { mj_deleteVFS(files_.get()); }
  MemoryFiles(const MemoryFiles&) = delete;
  MemoryFiles& operator=(const MemoryFiles&) = delete;

  /// Adds a file. None is ever replaced: MuJoCo 2.2 does not come back from removing one of several. `what`:
  /// for messages.
  void add(const std::string& name, const std::string& bytes, const std::string& what) {
    const int failed = mj_makeEmptyFileVFS(files_.get(), name.c_str(), static_cast<int>(bytes.size()));
    if (failed == 1) fail(ExitCode::bad_input, "{}: more than {} meshes", what, mjMAXVFS - 1);
    if (failed != 0) fail(ExitCode::bad_input, "{}: too long a file name", what);
    std::memcpy(files_->filedata[files_->nfile - 1], bytes.data(), bytes.size());
  }

  const mjVFS* get() const { return files_.get(); }

 private:
  std::unique_ptr<mjVFS> files_;
};

/// Compiles; without a model, its message.
ModelPointer try_to_load(const std::filesystem::path& path, const mjVFS* files, std::string& problem) {
  const ScopedMujocoHandlers handlers;
  std::array<char, 1000> message{};
  ModelPointer model;
  try {
    model.reset(mj_loadXML(path.c_str(), files, message.data(), static_cast<int>(message.size())));
  } catch (const MujocoError& fatal) {
    std::snprintf(message.data(), message.size(), "%s", fatal.what());
  }
  problem = one_line(message.data());
  return model;
}

/// The text between two marks, or empty.
std::string between(const std::string& text, std::string_view before, std::string_view after) {
  const std::size_t start = text.find(before);
  if (start == std::string::npos) return {};
  const std::size_t from = start + before.size(), to = text.find(after, from);
  return text.substr(from, to == std::string::npos ? to : to - from);
}

/// Compiles a tree, and removes from it what the compiler does not know.
class Compiler {
 public:
  Compiler(ModelText& text, const std::filesystem::path& path, ReadingNotes& notes)
      : text_(text), path_(path), notes_(notes) {}

  const std::vector<RemovedAttribute>& removed() const { return removed_; }

  ModelPointer compile() {
    for (int removals = 0;; ++removals) {
      written_ = write_xml(text_.root);
      MemoryFiles files;
      files.add(path_.filename(), written_.text, path_.string());
      for (const auto& [name, bytes] : text_.meshes.files()) files.add(name, *bytes, path_.string());
      std::string problem;
      ModelPointer model = try_to_load(path_, files.get(), problem);
      if (model != nullptr) return model;
      if (removals == most_removals || !remove_unknown(problem))
        fail(ExitCode::bad_input, "{}: MuJoCo refuses the model: {}", path_.string(),
             with_line_of_file(problem));
    }
  }

 private:
  static constexpr int most_removals = 500;

  /// The element of the line that a message names, or null. `mark` stands before the number.
  XmlElement* element_of(const std::string& problem) const {
    for (const std::string_view mark : {", line ", ", line = "}) {
      const int line = std::atoi(between(problem, mark, ",").c_str());
      if (line > 0 && line <= static_cast<int>(written_.lines.size()))
        return written_.lines[to_index(line - 1)];
    }
    return nullptr;
  }

  /// A message with the file's own line in place of that of the text as it was compiled.
  std::string with_line_of_file(const std::string& problem) const {
    const XmlElement* element = element_of(problem);
    const std::size_t at = problem.rfind(", line ");
    if (element == nullptr || at == std::string::npos || element->line == 0) return problem;
    return fmt::format("{} ({}:{})", problem.substr(0, at), element->file, element->line);
  }

  /// What is wrong with masses and meshes is mended where it is known how.
  bool mend(const std::string& problem) {
    const std::string name = between(problem, "Object name = ", ",");
    if (problem.find("mass and inertia of moving bodies") != std::string::npos ||
        problem.find("inertia must have positive eigenvalues") != std::string::npos)
      return mend_mass(name, std::atoi(between(problem, ", id = ", ",").c_str()));
    return text_.mesh_files.contains(name) && simplify_mesh(name, problem);
  }

  /// Small robots have moments below what MuJoCo takes for none: before masses count as missing, moments are
  /// raised to that.
  bool mend_mass(const std::string& body, int id) {
    if (!text_.urdf) {
      if (fill_empty_inertials(text_.root, text_.missing_masses)) return true;
      XmlElement* const compiler = text_.root.child("compiler");
      if (compiler != nullptr && !compiler->attribute("boundinertia")) {
        compiler->set("boundinertia", "2e-15");
        return true;
      }
    }
    return give_small_mass(text_.root, text_.urdf, body, id, text_.missing_masses);
  }

  bool simplify_mesh(const std::string& mesh, const std::string& problem) {
    const std::string key = text_.urdf ? "filename" : "file";
    XmlElement* found = nullptr;
    text_.root.visit([&](XmlElement& element, XmlElement*) {
      const auto file = element.attribute(key);
      if (element.name != "mesh" || !file) return;
      const bool same =
          text_.urdf ? std::filesystem::path(*file).stem() == mesh : element.attribute("name") == mesh;
      if (same) found = &element;
    });
    if (found == nullptr) return false;
    const std::string old = *found->attribute(key), file = text_.meshes.simpler(old);
    if (file.empty()) return false;
    const std::string named = text_.mesh_files[mesh],
                      renamed = text_.urdf ? std::filesystem::path(file).stem().string() : mesh;
    text_.mesh_files[renamed] = named;
    text_.root.visit([&](XmlElement& element, XmlElement*) {
      if (element.name == "mesh" && element.attribute(key) == old &&
          (text_.urdf || element.attribute("name") == mesh))
        element.set(key, file);
    });
    const std::string reason = between(problem, "Error: ", " Object name");
    if (text_.meshes.is_placeholder(file))
      text_.missing_meshes[renamed] = fmt::format("{} ({})", named, reason);
    else
      notes_.add(Reading::replaced,
                 fmt::format("the mesh {}, which MuJoCo refuses ({}): its convex hull", named, reason));
    return true;
  }

  bool remove_unknown(const std::string& problem) {
    if (mend(problem)) return true;
    if (text_.urdf) return remove_visuals(problem);
    const XmlElement* named = element_of(problem);
    if (named == nullptr) return false;
    const std::string name = named->name;
    if (name == "geom" && problem.find("sizes must be positive") != std::string::npos)
      return remove_geom(*named);
    if (problem.find("unrecognized attribute") != std::string::npos) {
      remove_attributes(*named, between(problem, "attribute: '", "'"), "");
      return true;
    }
    // Settings of the solver: amble sets its own.
    const std::string keyword = between(problem, "invalid keyword: '", "'");
    if (!keyword.empty() && (name == "option" || name == "compiler" || name == "flag")) {
      std::vector<std::string> keys;
      for (const auto& [key, value] : named->attributes)
        if (value == keyword) keys.push_back(key);
      for (const std::string& key : keys) remove_attributes(*named, key, keyword);
      return !keys.empty();
    }
    return problem.find("unrecognized element") != std::string::npos && remove_elements(name);
  }

  /// A shape without size.
  bool remove_geom(const XmlElement& geom) {
    const XmlElement* body = nullptr;
    text_.root.visit([&](XmlElement& element, XmlElement* parent) {
      if (&element == &geom) body = parent;
    });
    if (body == nullptr || body->name == "default") return false;
    notes_.add(Reading::left_out, fmt::format("geom '{}' of '{}': a shape without size",
                                              geom.attribute_or("name", ""), body->attribute_or("name", "")));
    text_.root.prune([&](const XmlElement& element, const XmlElement&) { return &element == &geom; });
    return true;
  }

  /// No robot is refused for what is only to look at, such as a mesh of too many faces.
  bool remove_visuals(const std::string& problem) {
    const auto is_visual = [](const XmlElement& element) { return element.name == "visual"; };
    bool any = false;
    text_.root.visit([&](const XmlElement& element) { any = any || is_visual(element); });
    if (!any) return false;
    notes_.add(Reading::left_out,
               fmt::format("all visual shapes, as MuJoCo refuses them or something else: {}",
                           with_line_of_file(problem)));
    text_.root.prune([&](const XmlElement& element, const XmlElement&) { return is_visual(element); });
    return true;
  }

  /// All of that name that are written the same; `value` empty: whatever its value.
  void remove_attributes(const XmlElement& first, const std::string& key, const std::string& value) {
    const std::string element_name = first.name;
    static const std::map<std::string, std::string> meanings{
        {"actuatorfrcrange", "read by `amble robot --init` as the largest torque of a motor"},
        {"kv", "read by `amble robot --init` as the damping of a servo"},
        {"dampratio", "read by `amble robot --init` as the damping of a servo"},
        {"inheritrange", "the range of command is in the robot file"},
        {"gravcomp", "gravity is not compensated in amble"},
        {"actuatorgravcomp", "gravity is not compensated in amble"}};
    const auto meaning = meanings.find(key);
    const std::string meant = meaning == meanings.end() ? misspelt_attribute(element_name, key) : "";
    if (!meant.empty())
      notes_.add(Reading::left_out,
                 fmt::format("{}:{}: attribute '{}' of <{}>, which MuJoCo does not know (did you mean '{}'?)",
                             first.file, first.line, key, element_name, meant),
                 true);
    else
      notes_.add(Reading::left_out,
                 fmt::format("attribute '{}' of <{}>: {}", key, element_name,
                             meaning != meanings.end() ? meaning->second : "this MuJoCo does not know it"));
    text_.root.visit([&](XmlElement& element, XmlElement*) {
      const auto own = element.attribute(key);
      if (element.name != element_name || !own || (!value.empty() && *own != value)) return;
      removed_.push_back({element_name, key, *own});
      element.remove_attribute(key);
    });
  }

  static bool holds_bodies(const XmlElement& element) {
    bool holds = false;
    element.visit([&](const XmlElement& part) { holds = holds || part.name == "body"; });
    return holds;
  }

  /// Elements of bodies stay: without them it would be another robot.
  bool remove_elements(const std::string& name) {
    bool of_a_body = false;
    text_.root.visit([&](XmlElement& element, XmlElement* parent) {
      if (element.name == name && parent != nullptr)
        of_a_body = of_a_body || holds_bodies(element) || parent->name == "body" ||
                    parent->name == "worldbody" || parent->name == "frame";
    });
    if (of_a_body || name == text_.root.name || name == "worldbody") return false;
    if (std::ranges::count(written_.lines, name, &XmlElement::name) == 0) return false;
    notes_.add(Reading::left_out, fmt::format("<{}>: this MuJoCo does not know it", name));
    text_.root.prune([&](const XmlElement& element, const XmlElement&) { return element.name == name; });
    return true;
  }

  ModelText& text_;
  const std::filesystem::path& path_;
  ReadingNotes& notes_;
  XmlText written_;
  std::vector<RemovedAttribute> removed_;
};

}  // namespace

void DeleteModel::operator()(mjModel_* model) const {
  mj_deleteModel(model);
}

ModelFile compile_model(const std::filesystem::path& path) try {
  ModelFile compiled;
  compiled.path = path;
  ModelText text = read_model_text(path, compiled.notes);
  compiled.root_is_welded = text.urdf;
  Compiler compiler(text, path, compiled.notes);
  compiled.model = compiler.compile();
  let_visuals_collide(*compiled.model, compiled.notes);
  compiled.mended_bodies = mend_masses(*compiled.model, text, compiled.notes);
  compiled.motors = std::move(text.motors);
  compiled.motors_named = std::move(text.motors_named);
  compiled.mimics = std::move(text.mimics);
  compiled.missing_meshes = std::move(text.missing_meshes);
  compiled.text = std::move(text.root);
  compiled.aside = std::move(text.aside);
  compiled.removed = compiler.removed();
  compiled.meshes = text.meshes.files();
  return compiled;
} catch (const std::filesystem::filesystem_error& error) {
  fail(ExitCode::io, "{}: while the model was read: {}", path.string(), error.what());
} catch (const std::length_error& error) {
  fail(ExitCode::bad_input, "{}: while the model was read: {}", path.string(), error.what());
} catch (const std::out_of_range& error) {
  fail(ExitCode::bad_input, "{}: while the model was read: {}", path.string(), error.what());
}

ModelPointer compile_mjcf(const std::string& text, const std::string& what,
                          const std::map<std::string, std::string>& meshes) {
  MemoryFiles files;
  files.add("model.xml", text, what);
  for (const auto& [name, bytes] : meshes) files.add(name, bytes, what);
  std::string problem;
  ModelPointer model = try_to_load("model.xml", files.get(), problem);
  if (model == nullptr) fail(ExitCode::bad_input, "{}: MuJoCo refuses the model: {}", what, problem);
  return model;
}

}  // namespace amble::morphology
