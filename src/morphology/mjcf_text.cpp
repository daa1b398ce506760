#include "amble/morphology/mjcf_text.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "amble/core/error.hpp"
#include "amble/morphology/mass_text.hpp"
#include "amble/morphology/mesh_file.hpp"
#include "amble/morphology/mesh_store.hpp"
#include "amble/morphology/mjcf_defaults.hpp"
#include "amble/morphology/mjcf_structure.hpp"
#include "amble/morphology/number_text.hpp"

namespace amble::morphology {
namespace {

namespace fs = std::filesystem;

/// Makes an MJCF tree one that MuJoCo 2.2 reads.
class MjcfCleaner {
 public:
  MjcfCleaner(ModelText& text, const fs::path& path, ReadingNotes& notes)
      : text_(text), root_(text.root), folder_(path.parent_path()), notes_(notes) {}

  void clean() {
    refuse_generators();
    resolve_frames(root_, notes_);
    wrap_fused_root(root_, notes_);
    name_parts(root_, notes_);
    mend_limits(root_, false, notes_);
    balance_inertias(root_, false, notes_);
    name_keyframes();
    drive_joints_of_tendons();
    read_motors();
    remove_unneeded();
    remove_lost_pairs();
    complete_adhesion();
    set_compiler();
    take_meshes();
    root_.visit([](XmlElement& element, XmlElement*) {
      if (element.name != "key") return;
      // Numbers of actuators and activations, which may be left out.
      for (const char* key : {"ctrl", "act", "mpos", "mquat", "qvel"}) element.remove_attribute(key);
    });
  }

 private:
  void refuse_generators() const {
    root_.visit([](const XmlElement& element) {
      for (const char* name : {"composite", "replicate", "attach", "flexcomp"})
        if (element.name == name)
          fail(ExitCode::bad_input,
               "{}:{}: <{}>: elements that make bodies when the model is compiled are not read; let "
               "MuJoCo write the model out (compile model.xml out.xml)",
               element.file, element.line, name);
    });
  }

  /// So that each can be the start.
  void name_keyframes() {
    std::set<std::string> names;
    root_.visit([&](const XmlElement& element) {
      if (element.name == "key") names.insert(element.attribute_or("name", ""));
    });
    root_.visit([&](XmlElement& element, XmlElement*) {
      if (element.name == "key" && element.attribute_or("name", "").empty())
        element.set("name", free_name(names, "key"));
    });
  }

  /// A tendon that measures one joint moves it as the joint's own actuator would.
  void drive_joints_of_tendons() {
    std::map<std::string, std::pair<std::string, double>> joints;  // by tendon: the joint and its coefficient
    for (const XmlElement& section : root_.children) {
      if (section.name != "tendon") continue;
      for (const XmlElement& tendon : section.children)
        if (tendon.name == "fixed" && tendon.children.size() == 1 && tendon.children[0].name == "joint")
          joints[tendon.attribute_or("name", "")] = {tendon.children[0].attribute_or("joint", ""),
                                                     number_or_zero(tendon.children[0].attribute("coef"))};
    }
    const MjcfDefaults defaults(root_);
    std::vector<std::string> moved;
    for (XmlElement& section : root_.children) {
      if (section.name != "actuator") continue;
      for (XmlElement& actuator : section.children) {
        const auto found = joints.find(actuator.attribute_or("tendon", ""));
        if (found == joints.end() || found->second.second == 0.0) continue;
        const std::vector<double> gear = numbers_of(defaults.attribute(actuator, "gear", "").value_or("1"));
        actuator.remove_attribute("tendon");
        actuator.set("joint", found->second.first);
        actuator.set("gear", fmt::format("{}", (gear.empty() ? 1.0 : gear[0]) * found->second.second));
        moved.push_back(fmt::format("'{}'", found->second.first));
      }
    }
    if (!moved.empty())
      notes_.add(Reading::replaced,
                 fmt::format("actuators of tendons that measure one joint, by the joint's: {}",
                             fmt::join(moved, ", ")));
  }

  void read_motors() {
    const MjcfDefaults defaults(root_);
    const auto in_bodies = [&](const auto& self, const XmlElement& element,
                               const std::string& above) -> void {
      const std::string childclass = element.attribute_or("childclass", above);
      for (const XmlElement& child : element.children) {
        if (child.name == "body") self(self, child, childclass);
        if (child.name != "joint") continue;
        const auto range = defaults.attribute(child, "actuatorfrcrange", childclass);
        if (const auto ends = numbers_of(range.value_or("")); ends.size() == 2)
          text_.motors[child.attribute_or("name", "")].max_torque_nm = weaker_side(ends[0], ends[1]);
      }
    };
    for (const XmlElement& section : root_.children) {
      if (section.name == "worldbody") in_bodies(in_bodies, section, "");
      if (section.name != "actuator") continue;
      for (const XmlElement& actuator : section.children)
        if (actuator.name == "position") {
          const std::string joint =
              actuator.attribute_or("joint", actuator.attribute_or("jointinparent", ""));
          if (const double kv = positive_or_zero(defaults.attribute(actuator, "kv", "")); kv > 0.0)
            text_.motors[joint].kv_nm_s_per_rad = kv;
          if (const double ratio = positive_or_zero(defaults.attribute(actuator, "dampratio", ""));
              ratio > 0.0)
            text_.motors[joint].damping_ratio = ratio;
        }
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
      const bool hilly = element.name == "geom" && element.attribute("hfield");
      if (hilly)
        notes_.add(Reading::left_out,
                   fmt::format("geom '{}' of {}", element.attribute_or("name", ""), height_fields));
      if (!why.empty()) notes_.add(Reading::left_out, std::string(why));
      if (&parent == &root_ && (element.name == "size" || element.name == "statistic"))
        text_.aside.push_back(element);
      return hilly || !why.empty();
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
      if (const auto folder = section.attribute("meshdir")) mesh_folder_ = plain_path(*folder);
      section.remove_attribute("meshdir");
      if (section.attribute_or("strippath", "false") == "true") strip_path_ = true;
      weigh_geoms(section);
    }
    // The default of MuJoCo 3; where a model is written for 2.2 without it, a range needs `limited` anyway.
    if (!compiler->attribute("autolimits")) compiler->set("autolimits", "true");
  }

  /// With inertiafromgeom="false" bodies without <inertial> would weigh nothing; the masses of their geoms
  /// are what is there.
  void weigh_geoms(XmlElement& compiler) {
    if (compiler.attribute_or("inertiafromgeom", "auto") != "false") return;
    bool any = false;
    root_.visit([&](const XmlElement& body) {
      any =
          any || (body.name == "body" && body.child("inertial") == nullptr && body.child("geom") != nullptr);
    });
    if (!any) return;
    compiler.set("inertiafromgeom", "auto");
    notes_.add(Reading::replaced,
               "inertiafromgeom=\"false\": bodies without <inertial> have the masses of their geoms");
  }

  /// Pairs of contacts and exclusions that name what is not there, such as the floor of another file.
  void remove_lost_pairs() {
    std::set<std::string> geoms, bodies{"world"};
    root_.visit([&](const XmlElement& element) {
      if (element.name == "geom") geoms.insert(element.attribute_or("name", ""));
      if (element.name == "body") bodies.insert(element.attribute_or("name", ""));
    });
    for (XmlElement& section : root_.children) {
      if (section.name != "contact") continue;
      std::erase_if(section.children, [&](const XmlElement& pair) {
        const bool of_geoms = pair.name == "pair";
        const std::string first = pair.attribute_or(of_geoms ? "geom1" : "body1", ""),
                          second = pair.attribute_or(of_geoms ? "geom2" : "body2", "");
        const auto& there = of_geoms ? geoms : bodies;
        const bool lost = !there.contains(first) || !there.contains(second);
        if (lost && of_geoms) touch_ground(there.contains(first) ? first : second);
        if (lost)
          notes_.add(Reading::left_out, fmt::format("contact {} of '{}' and '{}': one of them is not there",
                                                    of_geoms ? "pair" : "exclusion", first, second));
        return lost;
      });
    }
  }

  /// A geom that collided by its pair with a missing floor alone does so with amble's ground, and nothing
  /// else.
  void touch_ground(const std::string& name) {
    const MjcfDefaults defaults(root_);
    const auto look = [&](const auto& self, XmlElement& place, const std::string& above) -> void {
      const std::string childclass = place.attribute_or("childclass", above);
      for (XmlElement& child : place.children) {
        if (child.name == "body") self(self, child, childclass);
        if (child.name != "geom" || child.attribute_or("name", "") != name) continue;
        const auto bits = [&](const char* key) {
          return defaults.attribute(child, key, childclass).value_or("1");
        };
        if (bits("contype") != "0" || bits("conaffinity") != "0") continue;
        constexpr const char* of_the_ground_alone = "1073741824";  // one of the bits that the ground has
        child.set("conaffinity", of_the_ground_alone);
      }
    };
    for (XmlElement& section : root_.children)
      if (section.name == "worldbody") look(look, section, "");
  }

  /// The installed MuJoCo wants an adhesion actuator's range from the element itself.
  void complete_adhesion() {
    const MjcfDefaults defaults(root_);
    std::vector<std::string> names;
    for (XmlElement& section : root_.children) {
      if (section.name != "actuator") continue;
      for (XmlElement& actuator : section.children) {
        if (actuator.name != "adhesion") continue;
        actuator.set("ctrlrange", defaults.attribute(actuator, "ctrlrange", "").value_or("0 1"));
        names.push_back(
            fmt::format("'{}'", actuator.attribute_or("name", actuator.attribute_or("body", ""))));
      }
    }
    if (!names.empty())
      notes_.add(Reading::left_out, fmt::format("adhesion actuators, as nothing sticks to the ground: {}",
                                                fmt::join(names, ", ")));
  }

  void take_meshes() {
    root_.visit([this](XmlElement& element, XmlElement* parent) {
      const auto file = element.attribute("file");
      if (element.name != "mesh" || parent == nullptr || parent->name != "asset") return;
      if (!file) return take_listed_mesh(element);
      const fs::path plain = plain_path(*file), name = strip_path_ ? plain.filename() : plain;
      if (!element.attribute("name")) element.set("name", name.stem().string());
      const fs::path of_part = fs::path(element.file).parent_path();
      const fs::path path =
          first_file({folder_ / mesh_folder_ / name, of_part / mesh_folder_ / name, of_part / name,
                      folder_ / name, folder_ / mesh_folder_ / name.filename()});
      take_mesh(text_, element, "file", *file, path, notes_);
    });
  }

  /// A mesh whose corners the model lists.
  void take_listed_mesh(XmlElement& element) {
    const std::vector<double> numbers = numbers_of(element.attribute_or("vertex", ""));
    MeshShape shape;
    for (std::size_t at = 0; at + 3 <= numbers.size(); at += 3)
      shape.corners.push_back({static_cast<float>(numbers[at]), static_cast<float>(numbers[at + 1]),
                               static_cast<float>(numbers[at + 2])});
    if (shape.corners.size() < 4 || !is_flat(shape)) return;
    const std::string name = element.attribute_or("name", "");
    text_.missing_meshes[name] = name + " (it is flat)";
    for (const char* key : {"vertex", "face", "normal", "texcoord", "scale"}) element.remove_attribute(key);
    element.set("file", text_.meshes.placeholder());
  }

  ModelText& text_;
  XmlElement& root_;
  fs::path folder_, mesh_folder_;
  bool strip_path_ = false;
  ReadingNotes& notes_;
};

}  // namespace

void clean_mjcf(ModelText& text, const fs::path& path, ReadingNotes& notes) {
  MjcfCleaner(text, path, notes).clean();
}

}  // namespace amble::morphology
