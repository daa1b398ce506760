#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "amble/morphology/model_file.hpp"
#include "amble/morphology/model_parts.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "amble/morphology/xml_tree.hpp"
#include "tests/models/model_edits.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

/// What a reading of an edited model must account for: each joint, geom, actuator, equality and tendon is in
/// the robot, or the notes speak of it.
class Accounting {
 public:
  Accounting(const XmlElement& model, const ModelParts& parts) : parts_(parts), notes_(parts.notes.text()) {
    model.visit([this](const XmlElement& element) {
      for (const XmlElement& child : element.children) visit(child, element);
    });
    count_geoms(model);
  }

  const std::string& problems() const { return problems_; }

 private:
  bool noted(const std::string& word) const { return notes_.find(word) != std::string::npos; }
  template <typename T>
  static bool has(const std::vector<T>& parts, const std::string& name) {
    return std::ranges::find(parts, name, &T::name) != parts.end();
  }
  void problem(const std::string& text) { problems_ += "\n  " + text; }

  /// Shapes of the robot, whether they have names or not.
  void count_geoms(const XmlElement& model) {
    std::size_t bodies = 0, geoms = 0;
    model.visit([&](const XmlElement& element) {
      for (const XmlElement& child : element.children) {
        const bool of_body = element.name == "body" || element.name == "frame";
        const XmlElement* const geometry = child.child("geometry");
        const bool capsule = geometry != nullptr && geometry->child("capsule") != nullptr;  // in three parts
        if ((child.name == "geom" && of_body) || (child.name == "collision" && element.name == "link"))
          geoms += capsule ? 3 : 1;
        bodies += child.name == "body" && element.name == "worldbody";
      }
    });
    const auto collide =
        static_cast<std::size_t>(std::ranges::count(parts_.geoms, true, &robot::Geom::collides));
    const std::size_t kept = model.name == "robot" ? collide : parts_.geoms.size();
    if (bodies <= 1 && kept < geoms && !noted("geom ") && !noted("geoms ") && !noted("mesh cannot be read") &&
        !noted("height fields") && !noted("collision"))
      problem(fmt::format("of {} geoms {} are kept, and nothing is said", geoms, kept));
    if (kept > geoms) problem(fmt::format("of {} geoms {} came", geoms, kept));
  }

  void visit(const XmlElement& element, const XmlElement& parent) {
    const std::string name = element.attribute_or("name", "");
    const bool in_body = parent.name == "body" || parent.name == "frame" || parent.name == "robot";
    if (element.name == "joint" && in_body && element.attribute_or("type", "hinge") != "fixed" &&
        !name.empty() && !has(parts_.joints, name) && !noted("'" + name + "'") && !noted(name) &&
        !noted("it stands in the world"))
      problem(fmt::format("joint '{}' is neither kept nor named", name));
    if (element.name == "geom" && in_body && !name.empty() && !has(parts_.geoms, name) && !noted(name) &&
        !noted("left out  height fields") && !noted("mesh cannot be read") &&
        !noted("it stands in the world"))
      problem(fmt::format("geom '{}' is neither kept nor named", name));
    for (const char* section : {"actuator", "equality", "tendon"})
      if (parent.name == section && !noted(section == std::string("equality") ? "equalit" : section) &&
          !noted(element.name))
        problem(fmt::format("<{}> of <{}> is not named", element.name, section));
    for (const char* word : {"sensor", "keyframe", "mimic", "transmission"})
      if (element.name == word && !element.children.empty() && !noted(word))
        problem(fmt::format("<{}> is not named", word));
  }

  const ModelParts& parts_;
  std::string notes_, problems_;
};

/// Reads an edited model as `amble robot --init` does. Returns what is wrong with how that ended, or nothing.
class EditedModel : public testing::TestWithParam<tests::SmallModel> {
 protected:
  std::string problems_of(const XmlElement& model, const std::filesystem::path& path) {
    const std::clock_t start = std::clock();
    std::string problems;
    try {
      const ModelFile file = compile_model(path);
      const RobotGuess guess = guess_robot(file, path.filename(), true);
      problems = Accounting(model, extract_parts(file)).problems();
      const auto toml = files_.write("m.toml", guess.toml);
      ++guessed_;
      if (guess.asked.empty()) {
        load_robot(toml);
        ++loaded_;
      }
    } catch (const UserError& error) {
      const std::string line = error.what();
      if (line.find('\n') != std::string::npos) problems += "\n  more than a line: " + line;
      if (line.find("/m.") == std::string::npos && line.find("missing") == std::string::npos)
        problems += "\n  no file is named: " + line;
      if (line.find("defect") != std::string::npos) problems += "\n  called a defect: " + line;
    } catch (const std::exception& error) {
      problems += std::string("\n  not an error of amble: ") + error.what();
    }
    if (std::clock() - start > 10 * CLOCKS_PER_SEC) problems += "\n  took more than ten seconds";
    return problems;
  }

  Files files_;
  int guessed_ = 0, loaded_ = 0;
};

TEST_P(EditedModel, IsReadOrRefusedInALineAndNothingIsDroppedInSilence) {
  const char* asked = std::getenv("AMBLE_MODEL_EDITS");
#ifdef AMBLE_SANITIZED
  constexpr int usual = 50;
#else
  constexpr int usual = 150;
#endif
  const int edits = asked != nullptr ? std::atoi(asked) : usual;
  const tests::SmallModel& small = GetParam();
  for (int seed = 0; seed < edits; ++seed) {
    XmlElement model = parse_xml(small.text, small.name);
    tests::ModelEditor editor(static_cast<std::uint64_t>(seed));
    editor.edit(model);
    const auto path = files_.write("m." + small.extension, write_xml(model).text);
    EXPECT_EQ(problems_of(model, path), "") << small.name << ", seed " << seed << ": " << editor.account();
  }
  // Edits that make everything unreadable would prove nothing.
  if (small.name != "arm") {  // its slide is refused
    EXPECT_GT(guessed_, edits / 4) << small.name;
  }
  RecordProperty("guessed", guessed_);
  RecordProperty("loaded", loaded_);
}

INSTANTIATE_TEST_SUITE_P(EditedModels, EditedModel, testing::ValuesIn(tests::small_models()),
                         [](const auto& model) { return model.param.name; });

}  // namespace
}  // namespace amble::morphology
