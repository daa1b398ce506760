#include "amble/morphology/original_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "amble/io/file.hpp"
#include "amble/morphology/robot_guess.hpp"
#include "tests/models/small_models.hpp"
#include "tests/morphology/files.hpp"

namespace amble::morphology {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* position = R"(position kp="30" forcerange="-9 9" ctrlrange="-1 1")";

/// A binary STL of a pyramid.
std::string pyramid_stl(float size_m) {
  const float a = size_m;
  const float corners[4][3] = {{a, a, -a}, {-a, a, -a}, {0, -a, -a}, {0, 0, a}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  std::string bytes(84 + 4 * 50, '\0');
  bytes[80] = 4;
  for (int f = 0; f < 4; ++f)
    for (int c = 0; c < 3; ++c)
      std::memcpy(bytes.data() + 84 + 50 * f + 12 + 12 * c, corners[faces[f][c]], 12);
  return bytes;
}

struct Loaded {
  robot::RobotSpec robot;
  ReadingNotes notes;
  std::string toml;
};

Loaded load(const Files& files, const std::string& mjcf) {
  const auto file = files.write("own.xml", mjcf);
  Loaded loaded;
  loaded.toml = guess_robot(compile_model(file), "own.xml", true).toml;
  loaded.robot = load_robot(files.write("own.toml", loaded.toml), &loaded.notes);
  return loaded;
}

ModelPointer compiled(const robot::RobotSpec& robot) {
  return compile_mjcf(robot.original->mjcf, "the test", robot.original->meshes);
}

TEST(OriginalModel, IsKeptOnlyIfTheRobotFileSaysSo) {
  const Files files;
  const auto file = files.write("own.xml", tests::model_text(tests::four_legs()));
  const std::string without = guess_robot(compile_model(file), "own.xml").toml;
  EXPECT_THAT(without, Not(HasSubstr("keep_model")));
  EXPECT_EQ(load_robot(files.write("own.toml", without)).original, nullptr);
  const Loaded with_it = load(files, tests::model_text(tests::four_legs()));
  EXPECT_THAT(with_it.toml, HasSubstr("\nkeep_model = true\n"));
  ASSERT_NE(with_it.robot.original, nullptr);
  EXPECT_THAT(with_it.notes.text(), HasSubstr("the model itself, for the engine mujoco-model"));
}

TEST(OriginalModel, HasItsPhysicsAndNamesItsParts) {
  const Files files;
  const std::string more =
      R"(<option timestep="0.003" solver="PGS" impratio="7"/><statistic meaninertia="0.3"/>
    <size nconmax="55" njmax="222"/><visual><rgba haze="0 0 0 0"/></visual>)";
  const std::string behind = tests::motors(position) +
                             R"(<contact><exclude body1="FL_thigh" body2="trunk"/></contact>
    <sensor><touch site="nowhere"/></sensor>)";
  const Loaded loaded = load(files, tests::model_text(tests::four_legs(), "<freejoint/>", "", behind, more));
  const ModelPointer model = compiled(loaded.robot);
  EXPECT_EQ(model->opt.timestep, 0.003);
  EXPECT_EQ(model->opt.solver, mjSOL_PGS);
  EXPECT_EQ(model->opt.impratio, 7.0);
  EXPECT_EQ(model->stat.meaninertia, 0.3);
  EXPECT_EQ(model->nconmax, 55);
  EXPECT_EQ(model->njmax, 222);
  EXPECT_EQ(model->nexclude, 1);
  EXPECT_EQ(model->nu, 8);
  const robot::OriginalModel& original = *loaded.robot.original;
  ASSERT_EQ(original.joints.size(), loaded.robot.joints.size());
  for (std::size_t j = 0; j < original.joints.size(); ++j)
    EXPECT_EQ(loaded.robot.joints[j].name, model->names + model->name_jntadr[original.joints[j]]);
  for (const robot::Leg& leg : loaded.robot.legs) {
    const int geom = original.geoms[static_cast<std::size_t>(leg.foot_geoms.front())];
    EXPECT_EQ(leg.name + "_foot", model->names + model->name_geomadr[geom]);
  }
}

TEST(OriginalModel, GetsAGroundWhereItHasNone) {
  const Files files;
  const std::string plane = R"(<geom type="plane" size="9 9 1"/>)";
  const std::string bare = with(tests::model_text(tests::four_legs()), plane, "");
  const Loaded loaded = load(files, bare);
  EXPECT_THAT(loaded.notes.text(), HasSubstr("the ground is the plane z = 0 with MuJoCo's own friction (1)"));
  const ModelPointer model = compiled(loaded.robot);
  EXPECT_EQ(model->ngeom, static_cast<int>(loaded.robot.geoms.size()) + 1);
  EXPECT_EQ(model->geom_type[model->ngeom - 1], mjGEOM_PLANE);
  const Loaded grounded = load(files, tests::model_text(tests::four_legs()));
  EXPECT_THAT(grounded.notes.text(), Not(HasSubstr("friction (1)")));
  EXPECT_EQ(compiled(grounded.robot)->ngeom, static_cast<int>(grounded.robot.geoms.size()) + 1);
}

TEST(OriginalModel, HasItsOwnGroundInWhateverBodyThatStands) {
  const Files files;
  const std::string plane = R"(<geom type="plane" size="9 9 1"/>)",
                    model = tests::model_text(tests::four_legs());
  for (const std::string& floor :
       {"<body name=\"floor\">" + plane + "</body>", "<frame>" + plane + "</frame>",
        "<body pos=\"0 0 -1\"><body pos=\"0 0 1\">" + plane + "</body></body>"}) {
    const Loaded loaded = load(files, with(model, plane, floor));
    EXPECT_THAT(loaded.notes.text(), Not(HasSubstr("friction (1)"))) << floor;
    EXPECT_EQ(compiled(loaded.robot)->ngeom, static_cast<int>(loaded.robot.geoms.size()) + 1) << floor;
  }
  const Loaded low = load(files, with(model, plane, "<body pos=\"0 0 -1\">" + plane + "</body>"));
  EXPECT_THAT(low.notes.text(), HasSubstr("friction (1)"));
}

TEST(OriginalModel, CarriesMeshesThatCollideOrWeighAndNoOthers) {
  const Files files;
  std::filesystem::create_directories(files.path("parts"));
  files.write("parts/foot.STL", pyramid_stl(0.03f));
  files.write("parts/shell.stl", pyramid_stl(0.2f));
  files.write("parts/ballast.stl", pyramid_stl(0.05f));
  const std::string assets =
      R"(<compiler meshdir="parts"/><asset><mesh name="foot" file="foot.STL"/><mesh file="shell.stl"/>
      <mesh file="ballast.stl" scale="1 1 .5"/></asset>)";
  const std::string trunk =
      R"(<body name="shown"><inertial pos="0 0 0" mass="0.5" diaginertia="0.01 0.01 0.01"/>
      <geom type="mesh" mesh="shell" contype="0" conaffinity="0"/></body>
      <body name="weight"><geom type="mesh" mesh="ballast" contype="0" conaffinity="0" mass="0.4"/></body>)";
  const Loaded loaded =
      load(files, tests::model_text(tests::four_legs({.foot = R"(type="mesh" mesh="foot")"}), "<freejoint/>",
                                    trunk, tests::motors(position), assets));
  const robot::OriginalModel& original = *loaded.robot.original;
  ASSERT_EQ(original.meshes.size(), 2u);
  EXPECT_EQ(original.meshes.at("mesh0.stl"), pyramid_stl(0.03f));
  EXPECT_EQ(original.meshes.at("mesh2.stl"), pyramid_stl(0.05f));
  // It moves as the whole file does, to the bit.
  std::filesystem::remove(files.path("parts/foot.STL"));
  const ModelPointer kept = compiled(loaded.robot);
  files.write("parts/foot.STL", pyramid_stl(0.03f));
  std::array<char, 500> problem{};
  std::string text = io::read_file(files.path("own.xml"));
  text.insert(text.find("<mujoco>") + 8, R"(<compiler autolimits="true"/>)");
  const ModelPointer whole(
      mj_loadXML(files.write("whole.xml", text).c_str(), nullptr, problem.data(), problem.size()));
  ASSERT_NE(whole, nullptr) << problem.data();
  const auto end_of = [](const mjModel* model) {
    mjData* data = mj_makeData(model);
    for (int step = 0; step < 1000; ++step) {
      for (int a = 0; a < model->nu; ++a) data->ctrl[a] = 0.3 * std::sin(0.01 * step + a);
      mj_step(model, data);
    }
    const std::vector<mjtNum> end(data->qpos, data->qpos + model->nq);
    EXPECT_GT(data->ncon, 0);
    mj_deleteData(data);
    return end;
  };
  EXPECT_EQ(end_of(kept.get()), end_of(whole.get()));
}

TEST(OriginalModel, KeepsWhatANewerMujocoHasAsFarAsItCan) {
  const Files files;
  tests::LegText like;
  like.hip = R"(range="-40 40" actuatorfrcrange="-6 6")";
  const std::string actuators =
      R"(<actuator><position joint="FL_hip" kp="20" kv="1.5" gear="2" inheritrange="1"/>
      <position joint="FR_hip" kp="10" kv="0.5" forcerange="-4 4"/>
      <position joint="RL_hip" kp="25" dampratio="0.5"/></actuator>)";
  const Loaded loaded = load(files, tests::model_text(tests::four_legs(like), "<freejoint/>", "", actuators,
                                                      R"(<option integrator="implicitfast"/>)"));
  const ModelPointer model = compiled(loaded.robot);
  EXPECT_EQ(model->opt.integrator, mjINT_IMPLICIT);
  EXPECT_EQ(model->actuator_gainprm[0], 20.0);
  EXPECT_EQ(model->actuator_biasprm[1], -20.0);
  EXPECT_EQ(model->actuator_biasprm[2], -1.5);
  EXPECT_EQ(model->actuator_forcelimited[0], 1);
  EXPECT_EQ(model->actuator_forcerange[1], 3.0) << "at the joint 6 N m, by a gear of 2";
  EXPECT_EQ(model->actuator_forcerange[3], 4.0);
  EXPECT_EQ(model->actuator_biasprm[mjNBIAS + 2], -0.5);
  const double inertia = model->dof_M0[model->jnt_dofadr[model->actuator_trnid[4]]];
  EXPECT_GT(inertia, 0.01);
  EXPECT_NEAR(model->actuator_biasprm[2 * mjNBIAS + 2], -0.5 * 2.0 * std::sqrt(25.0 * inertia), 1e-12);
  const std::string notes = loaded.notes.text();
  for (const char* note :
       {"the integrator is `implicit`", "position actuators with kv", "actuatorfrcrange is its"})
    EXPECT_THAT(notes, HasSubstr(note));
}

TEST(OriginalModel, RefusesWhatCannotWalkByItself) {
  const Files files;
  const auto refusal = [&](const std::string& name, const std::string& text) {
    const auto guess = guess_robot(compile_model(files.write(name, text)), name);
    const auto at = guess.toml.find("self_collision");
    return files.error_of([&] {
      load_robot(files.write("own.toml", std::string(guess.toml).insert(at, "keep_model = true\n")));
    });
  };
  EXPECT_EQ(refusal("own.urdf", tests::urdf_with_effort()),
            "own.urdf: the model cannot be kept for the engine mujoco-model (keep_model = true): a URDF has "
            "no physics "
            "of its own");
  EXPECT_EQ(refusal("own.xml", tests::model_text(tests::four_legs(), "")),
            "own.xml: the model cannot be kept for the engine mujoco-model (keep_model = true): its root "
            "'trunk' moves neither by a free joint nor by slides and hinges, and so cannot walk");
  EXPECT_EQ(refusal("own.xml", tests::model_text(tests::four_legs(), R"(<joint type="ball"/>)")),
            "own.xml: the model cannot be kept for the engine mujoco-model (keep_model = true): its root "
            "'trunk' moves neither by a free joint nor by slides and hinges, and so cannot walk");
  EXPECT_EQ(refusal("own.xml", tests::model_text(tests::four_legs(),
                                                 R"(<joint type="slide" axis="1 0 0" name="rail"/>)")),
            "accepted");
  // --init says so in the robot file and goes on.
  const auto fixed = files.write("own.xml", tests::model_text(tests::four_legs(), ""));
  const std::string toml = guess_robot(compile_model(fixed), "own.xml", true).toml;
  EXPECT_THAT(toml, HasSubstr("# Not in the engine mujoco-model: "));
  EXPECT_THAT(toml, Not(HasSubstr("\nkeep_model = true")));
}

}  // namespace
}  // namespace amble::morphology
