#include "amble/morphology/side_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "amble/core/error.hpp"
#include "amble/io/file_kind.hpp"
#include "amble/io/quoting.hpp"
#include "amble/io/toml_settings.hpp"

namespace amble::morphology {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
/// Marks a number that the file does not give. No physical number has a default in the code.
constexpr double not_given = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<std::string_view, 2> servo_mode_names{"velocity", "torque"};

void visit(io::SettingsVisitor& visitor, robot::Servo& servo) {
  visitor.choice("mode", servo.mode, servo_mode_names, {"how the joint follows its target angle"});
  visitor.number("gain_per_s", servo.gain_per_s, {0.0, largest},
                 {"velocity servo: speed aimed at per angle still to go, 1/s"});
  visitor.number("max_torque_nm", servo.max_torque_nm, {0.0, largest}, {"largest torque, N m"});
  visitor.number("kp_nm_per_rad", servo.kp_nm_per_rad, {0.0, largest},
                 {"torque servo: torque per angle still to go, N m/rad"});
  visitor.number("kd_nm_s_per_rad", servo.kd_nm_s_per_rad, {0.0, largest},
                 {"torque servo: torque per speed, N m s/rad"});
  visitor.flag(
      "hold_torque", servo.hold_torque,
      {"torque servo in the engine mujoco-model: the torque is set at the beginning of a tick and held "
       "for it"});
}

void visit(io::SettingsVisitor& visitor, robot::Contact& contact) {
  visitor.number("friction", contact.friction, {0.0, unbounded},
                 {"Coulomb coefficient; inf: no sliding at all"});
  visitor.number("erp", contact.erp, {0.0, 1.0}, {"share of the penetration undone per step"});
  visitor.number("cfm_s_per_kg", contact.cfm_s_per_kg, {0.0, largest},
                 {"yielding velocity per force, m/s per N"});
  visitor.integer("sweeps", contact.sweeps, {0.0, robot::most_sweeps},
                  {"sweeps of the batch engine's solver; 0: as many as the paper's quadruped needs"});
}

/// The keys of a robot file before its tables.
struct TopKeys {
  SideFile& side;
  std::string model = {};
  std::vector<double> rpy_deg = {}, quaternion = {};

  void visit(io::SettingsVisitor& visitor) {
    visitor.text("name", side.name, {"what the robot is called in titles; left out: as its model's file"});
    visitor.text("model", model, {"its MJCF or URDF file, relative to this file"});
    visitor.texts("legs", side.legs, {"names of the legs, in control order"});
    visitor.texts("joint_types", side.joint_types, {"names of the joint types, in control order"});
    visitor.texts("held", side.held, {"joints of no leg, held at their start angle by their servo"});
    visitor.texts(
        "passive", side.passive,
        {"joints without a motor, which move freely, with the model's spring, damping and friction"});
    visitor.texts("fixed", side.fixed, {"joints that are welded at their start angle"});
    visitor.text("start", side.start, {"keyframe of the MJCF that is the start pose"});
    visitor.numbers(
        "start_rpy_deg", rpy_deg, {-360.0, 360.0},
        {"orientation of the root's frame in the start pose: roll, pitch and yaw about the world's x, "
         "y and z, in this order, degrees; left out: as the model has it"});
    visitor.numbers("start_quaternion", quaternion, {-largest, largest},
                    {"the same as a quaternion (w, x, y, z)"});
    visitor.number("start_height_m", side.root_height_m, {-largest, largest},
                   {"height of the root's frame in the start pose, also below 0; 0: as the model has it"});
    visitor.number("fall_height_m", side.fall_height_m, {-largest, largest},
                   {"the robot has fallen when the root's centre of mass is lower"});
    visitor.number("fall_above_m", side.fall_above_m, {0.0, unbounded}, {"or when it is higher; inf: never"});
    visitor.number("fall_tilt_rad", side.fall_tilt_rad, {0.0, unbounded},
                   {"or when the root tilts by more from its start pose, rad; inf: never"});
    visitor.flag("self_collision", side.self_collision,
                 {"whether bodies that no joint links collide with each other"});
    visitor.flag("keep_model", side.keep_model,
                 {"whether robot.json and champions carry the MJCF itself, for the engine mujoco-model"});
  }
};

// What tables mean, and the keys in them whose names are the robot's.
constexpr io::Doc names_doc{"what the model calls the parts of a leg"},
    joint_pattern_doc{"pattern for joints; {leg} and {type} are replaced"},
    foot_pattern_doc{"pattern for foot geoms, or a list; {leg} is replaced"},
    names_of_leg_doc{"names of this leg's parts where they do not follow the pattern"},
    foot_doc{"its foot geom, or a list of them"}, joint_doc{"its joint of this type"},
    servo_doc{"the motor of every joint"},
    servo_of_doc{"where motors differ: servo_of.TYPE for a joint type, servo_of.LEG.TYPE for one joint"},
    command_doc{
        "range of the targets that controllers give, where it is not from stop to stop: "
        "command.TYPE for a joint type, command.LEG.TYPE for one joint"},
    range_doc{"lower and upper end, rad, as the model counts the angle"},
    start_angle_doc{"start angles of single joints"}, angle_doc{"rad, as the model counts the angle"},
    contact_doc{"contacts of bodies with the ground and each other"};
const std::string default_joint_pattern = "{leg}_{type}", default_foot_pattern = "{leg}_foot";

/// `pattern` with {leg} and {type} replaced; names that contain such marks stay as they are.
std::string filled_in(std::string_view pattern, std::string_view leg, std::string_view type) {
  std::string text;
  while (!pattern.empty()) {
    std::string_view mark = pattern.substr(0, 1), name = mark;
    for (const auto& [key, value] :
         {std::pair<std::string_view, std::string_view>{"{leg}", leg}, {"{type}", type}})
      if (pattern.starts_with(key)) mark = key, name = value;
    text += name;
    pattern.remove_prefix(mark.size());
  }
  return text;
}

/// Reads one side file, table by table.
class SideFileReader {
 public:
  SideFileReader(const std::filesystem::path& path, io::TomlDocument document)
      : path_(path.string()), document_(std::move(document)), reader_(document_.reader()) {}

  SideFile read() {
    read_top();
    read_names();
    read_servos();
    read_commands();
    read_start_angles();
    reader_->begin("contact", contact_doc);
    visit(*reader_, side_.contact);
    reader_->end();
    reader_->finish();
    require_numbers();
    return std::move(side_);
  }

 private:
  [[noreturn]] void missing(std::string_view key, std::string_view expected = "a number") const {
    fail(ExitCode::bad_input, "{}: '{}' is missing: expected {}", path_, key, expected);
  }

  void require(std::string_view key, double number) const {
    if (std::isnan(number)) missing(key);
  }

  void read_top() {
    TopKeys top{side_};
    side_.fall_height_m = not_given;
    side_.contact = {not_given, not_given, not_given};
    top.visit(*reader_);
    read_start_rotation(top.rpy_deg, top.quaternion);
    if (top.model.empty()) missing("model", "the path of an MJCF or URDF file");
    side_.model = document_.folder_of("model") / top.model;
    if (side_.name.empty()) side_.name = side_.model.stem().string();
    check_names("legs", side_.legs);
    check_names("joint_types", side_.joint_types);
    for (const std::string& name : side_.held) {
      for (const auto& [key, names] : {std::pair{"legs", &side_.legs}, {"joint_types", &side_.joint_types}})
        if (std::ranges::find(*names, name) != names->end())
          fail(ExitCode::bad_input, "{}: 'held' and '{}' both name '{}'", document_.where("held"), key, name);
    }
    for (const std::string& name : side_.passive)
      if (std::ranges::find(side_.held, name) != side_.held.end())
        fail(ExitCode::bad_input, "{}: 'passive' and 'held' both name '{}'", document_.where("passive"),
             name);
    for (const std::string& leg : side_.legs) {
      if (std::find(side_.joint_types.begin(), side_.joint_types.end(), leg) != side_.joint_types.end()) {
        fail(ExitCode::bad_input, "{}: 'legs' and 'joint_types' both name '{}'", document_.where("legs"),
             leg);
      }
    }
  }

  void read_start_rotation(const std::vector<double>& rpy_deg, const std::vector<double>& quaternion) {
    const auto refuse = [this](const char* key, const char* expected) {
      fail(ExitCode::bad_input, "{}: '{}': expected {}", document_.where(key), key, expected);
    };
    if (!rpy_deg.empty() && !quaternion.empty())
      refuse("start_quaternion", "only one of it and 'start_rpy_deg'");
    if (!rpy_deg.empty()) {
      if (rpy_deg.size() != 3) refuse("start_rpy_deg", "[roll, pitch, yaw] in degrees");
      side_.start_rotation = rotation_of(rpy_deg);
    }
    if (!quaternion.empty()) {
      double squares = 0.0;
      for (const double part : quaternion) squares += part * part;
      if (quaternion.size() != 4 || !(squares > 0.0) || !std::isfinite(squares))
        refuse("start_quaternion", "[w, x, y, z], not all 0");
      const double to_unit = 1.0 / std::sqrt(squares);
      side_.start_rotation = Quat{to_unit * quaternion[0], to_unit * quaternion[1], to_unit * quaternion[2],
                                  to_unit * quaternion[3]};
    }
  }

  static Quat rotation_of(const std::vector<double>& rpy_deg) {
    constexpr double rad_per_deg = std::numbers::pi / 180.0;
    const auto turn = [&](Vec3 axis, double deg) { return axis_angle(axis, rad_per_deg * deg); };
    return turn({0.0, 0.0, 1.0}, rpy_deg[2]) * turn({0.0, 1.0, 0.0}, rpy_deg[1]) *
           turn({1.0, 0.0, 0.0}, rpy_deg[0]);
  }

  void check_names(std::string_view key, const std::vector<std::string>& names) const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const bool repeated = std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                                      names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i);
      if (repeated)
        fail(ExitCode::bad_input, "{}: '{}' names '{}' twice", document_.where(key), key, names[i]);
      if (names[i].empty() || names[i] == "foot" || names[i] == "joint") {
        fail(ExitCode::bad_input, "{}: '{}' must not use the name '{}'", document_.where(key), key, names[i]);
      }
    }
  }

  void read_names() {
    std::string joint_pattern = default_joint_pattern;
    std::vector<std::string> foot_patterns{default_foot_pattern};
    reader_->begin("names", names_doc);
    reader_->text("joint", joint_pattern, joint_pattern_doc);
    read_foot("names.foot", foot_patterns, foot_pattern_doc);
    for (const std::string& leg : side_.legs) {
      LegNames names;
      for (const std::string& pattern : foot_patterns) names.foot.push_back(filled_in(pattern, leg, ""));
      reader_->begin(leg, names_of_leg_doc);
      read_foot("names." + io::toml_key(leg) + ".foot", names.foot, foot_doc);
      for (const std::string& type : side_.joint_types) {
        std::string joint = filled_in(joint_pattern, leg, type);
        reader_->text(type, joint, joint_doc);
        names.joints.push_back(std::move(joint));
      }
      reader_->end();
      side_.names.push_back(std::move(names));
    }
    reader_->end();
  }

  /// One name or several, at the key "foot" of the table that is open.
  void read_foot(const std::string& path, std::vector<std::string>& names, io::Doc meaning) {
    if (document_.is_list(path)) {
      reader_->texts("foot", names, meaning);
      if (names.empty())
        fail(ExitCode::bad_input, "{}: '{}' = []: expected a geom, or a list of geoms", document_.where(path),
             path);
      return;
    }
    const std::string absent(1, '\0');
    std::string one = absent;
    reader_->text("foot", one, meaning);
    if (one != absent) names = {one};
  }

  void read_servos() {
    robot::Servo common{robot::ServoMode::velocity, not_given, not_given, not_given, 0.0};
    reader_->begin("servo", servo_doc);
    visit(*reader_, common);
    reader_->end();

    std::vector<robot::Servo> by_type(side_.joint_types.size(), common);
    reader_->begin("servo_of", servo_of_doc);
    for (std::size_t t = 0; t < by_type.size(); ++t) read_servo(side_.joint_types[t], by_type[t]);
    for (const std::string& leg : side_.legs) {
      reader_->begin(leg, {"motors of this leg"});
      for (std::size_t t = 0; t < by_type.size(); ++t) {
        side_.servos.push_back(by_type[t]);
        read_servo(side_.joint_types[t], side_.servos.back());
      }
      reader_->end();
    }
    for (const std::string& joint : side_.held) {
      side_.held_servos.push_back(common);
      read_servo(joint, side_.held_servos.back());
    }
    reader_->end();
  }

  /// Ranges of joint types, and of single joints.
  void read_commands() {
    std::vector<std::optional<robot::AngleRange>> by_type(side_.joint_types.size());
    reader_->begin("command", command_doc);
    for (std::size_t t = 0; t < by_type.size(); ++t) read_range("command", side_.joint_types[t], by_type[t]);
    for (const std::string& leg : side_.legs) {
      reader_->begin(leg, {"ranges of this leg"});
      for (std::size_t t = 0; t < by_type.size(); ++t) {
        side_.commands.push_back(by_type[t]);
        read_range("command." + io::toml_key(leg), side_.joint_types[t], side_.commands.back());
      }
      reader_->end();
    }
    reader_->end();
  }

  void read_range(const std::string& table, const std::string& key, std::optional<robot::AngleRange>& range) {
    std::vector<double> ends;
    reader_->numbers(key, ends, {-largest, largest}, range_doc);
    if (ends.empty()) return;
    const std::string path = table + "." + io::toml_key(key);
    if (ends.size() != 2 || !(ends[0] < ends[1]))
      fail(ExitCode::bad_input, "{}: '{}': expected [lower, upper] with lower below upper",
           document_.where(path), path);
    range = robot::AngleRange{ends[0], ends[1]};
  }

  void read_start_angles() {
    reader_->begin("start_angle", start_angle_doc);
    for (const std::string& joint : document_.keys_of("start_angle"))
      reader_->number(joint, side_.start_rad[joint], {-largest, largest}, angle_doc);
    reader_->end();
  }

  void read_servo(std::string_view key, robot::Servo& servo) {
    reader_->begin(key, {"motor of this joint type"});
    visit(*reader_, servo);
    reader_->end();
  }

  void require_numbers() {
    for (robot::Servo& servo : side_.servos) require_numbers(servo);
    for (robot::Servo& servo : side_.held_servos) require_numbers(servo);
    require("fall_height_m", side_.fall_height_m);
    require("contact.friction", side_.contact.friction);
    require("contact.erp", side_.contact.erp);
    require("contact.cfm_s_per_kg", side_.contact.cfm_s_per_kg);
  }

  void require_numbers(robot::Servo& servo) const {
    const bool velocity = servo.mode == robot::ServoMode::velocity;
    require("servo.max_torque_nm", servo.max_torque_nm);
    if (velocity && servo.hold_torque)
      fail(ExitCode::bad_input, "{}: 'servo.hold_torque' = true: expected mode = \"torque\" beside it",
           path_);
    require(velocity ? "servo.gain_per_s" : "servo.kp_nm_per_rad",
            velocity ? servo.gain_per_s : servo.kp_nm_per_rad);
    // What the mode does not use is zero.
    (velocity ? servo.kp_nm_per_rad : servo.gain_per_s) = 0.0;
    if (velocity) servo.kd_nm_s_per_rad = 0.0;
  }

  std::string path_;
  io::TomlDocument document_;
  std::unique_ptr<io::TomlDocument::Reader> reader_;
  SideFile side_;
};

}  // namespace

void describe_side_file(io::SettingsVisitor& visitor) {
  SideFile side;
  TopKeys{side}.visit(visitor);
  const auto table = [&visitor](std::string_view key, io::Doc doc, const auto& inside) {
    visitor.begin(key, doc);
    inside();
    visitor.end();
  };
  const auto motor = [&] {
    robot::Servo servo;
    visit(visitor, servo);
  };
  const auto range = [&] {
    std::vector<double> ends;
    visitor.numbers("TYPE", ends, {-largest, largest}, range_doc);
  };
  std::string joint = default_joint_pattern, type_joint;
  std::vector<std::string> feet{default_foot_pattern}, leg_feet;
  double angle_rad = 0.0;
  table("names", names_doc, [&] {
    visitor.text("joint", joint, joint_pattern_doc);
    visitor.texts("foot", feet, foot_pattern_doc);
    table("LEG", names_of_leg_doc, [&] {
      visitor.texts("foot", leg_feet, foot_doc);
      visitor.text("TYPE", type_joint, joint_doc);
    });
  });
  table("servo", servo_doc, motor);
  table("servo_of", servo_of_doc, [&] { table("TYPE", servo_of_doc, motor); });
  table("command", command_doc, [&] {
    range();
    table("LEG", command_doc, range);
  });
  table("start_angle", start_angle_doc, [&] {
    visitor.number("JOINT", angle_rad, {-largest, largest}, angle_doc);
  });
  table("contact", contact_doc, [&] { visit(visitor, side.contact); });
}

SideFile read_side_file(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    const auto of_run = path / "robot.json";
    fail(ExitCode::bad_input, "{}: a folder, and not a robot file; expected {}", path.string(),
         std::filesystem::exists(of_run, error) ? of_run.string() : "its TOML file");
  }
  io::refuse_other_kinds(path, io::FileKind::side_file,
                         "and not a robot file (TOML that names a model; robots/README.md)");
  return SideFileReader(path, io::TomlDocument::read(path)).read();
}

SideFile parse_side_file(std::string_view text, const std::filesystem::path& name) {
  return SideFileReader(name, io::TomlDocument::parse(text, name.string())).read();
}

}  // namespace amble::morphology
