#include "amble/morphology/model_file.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/core/index.hpp"
#include "amble/morphology/mujoco_handlers.hpp"

namespace amble::morphology {
namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

/// A one-file file system in memory, from which MuJoCo reads a text.
class MemoryFile {
 public:
  MemoryFile(const std::filesystem::path& path, const std::string& text) : files_(std::make_unique<mjVFS>()) {
    mj_defaultVFS(files_.get());
    if (mj_makeEmptyFileVFS(files_.get(), path.filename().c_str(), static_cast<int>(text.size())) != 0) {
      fail(ExitCode::bad_input, "{}: too long a file name", path.string());
    }
    std::memcpy(files_->filedata[0], text.data(), text.size());
  }
  ~MemoryFile() { mj_deleteVFS(files_.get()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

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

  ModelPointer compile() {
    for (int removals = 0;; ++removals) {
      written_ = write_xml(text_.root);
      const MemoryFile file(path_, written_.text);
      std::string problem;
      ModelPointer model = try_to_load(path_, file.get(), problem);
      if (model != nullptr) return model;
      if (removals == most_removals || !remove_unknown(problem))
        fail(ExitCode::bad_input, "{}: MuJoCo refuses the model: {}", path_.string(),
             with_line_of_file(problem));
    }
  }

 private:
  static constexpr int most_removals = 200;

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

  bool remove_unknown(const std::string& problem) {
    if (text_.urdf) return remove_visuals(problem);
    const XmlElement* named = element_of(problem);
    if (named == nullptr) return false;
    const std::string name = named->name;
    if (problem.find("unrecognized attribute") != std::string::npos) {
      remove_attributes(name, between(problem, "attribute: '", "'"), "");
      return true;
    }
    // Settings of the solver, which amble has its own of.
    const std::string keyword = between(problem, "invalid keyword: '", "'");
    if (!keyword.empty() && (name == "option" || name == "compiler" || name == "flag")) {
      std::vector<std::string> keys;
      for (const auto& [key, value] : named->attributes)
        if (value == keyword) keys.push_back(key);
      for (const std::string& key : keys) remove_attributes(name, key, keyword);
      return !keys.empty();
    }
    return problem.find("unrecognized element") != std::string::npos && remove_elements(name);
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
  void remove_attributes(const std::string& element_name, const std::string& key, const std::string& value) {
    static const std::map<std::string, std::string> meanings{
        {"actuatorfrcrange", "read by `amble robot --init` as the largest torque of a motor"},
        {"kv", "read by `amble robot --init` as the damping of a servo"},
        {"inheritrange", "the range of command is in the robot file"},
        {"gravcomp", "gravity is not compensated in amble"},
        {"actuatorgravcomp", "gravity is not compensated in amble"}};
    const auto meaning = meanings.find(key);
    notes_.add(Reading::left_out,
               fmt::format("attribute '{}' of <{}>: {}", key, element_name,
                           meaning != meanings.end() ? meaning->second : "this MuJoCo does not know it"));
    text_.root.visit([&](XmlElement& element, XmlElement*) {
      if (element.name == element_name && (value.empty() || element.attribute_or(key, "") == value))
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
};

}  // namespace

void DeleteModel::operator()(mjModel_* model) const {
  mj_deleteModel(model);
}

ModelFile compile_model(const std::filesystem::path& path) {
  ModelFile compiled;
  compiled.path = path;
  ModelText text = read_model_text(path, compiled.notes);
  compiled.root_is_welded = text.urdf;
  compiled.model = Compiler(text, path, compiled.notes).compile();
  compiled.motors = std::move(text.motors);
  compiled.missing_meshes = std::move(text.missing_meshes);
  return compiled;
}

ModelPointer compile_mjcf(const std::string& text, const std::string& what) {
  const MemoryFile file("model.xml", text);
  std::string problem;
  ModelPointer model = try_to_load("model.xml", file.get(), problem);
  if (model == nullptr) fail(ExitCode::bad_input, "{}: MuJoCo refuses the model: {}", what, problem);
  return model;
}

}  // namespace amble::morphology
