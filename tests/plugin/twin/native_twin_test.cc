// The native twin of a user's own model: its numbers against the scene that says the same, its free
// motion against MuJoCo's, and what has no twin.
#include "plugin/twin/native_twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "native_model/dynamics/dynamics.h"
#include "native_model/run/run_native.h"
#include "native_model/system/model.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/plugin/twin/twins.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

using plugin::NativeTwin;

// A rotor that can bend and tilt in a ring; `rotor` and `ring` are what a test says of their
// bodies.
std::string machine(const std::string& rotor, const std::string& ring = "",
                    const std::string& more = "", const std::string& option = "gravity=\"0 0 0\"") {
  return R"(<mujoco><option timestep="1e-5" )" + option + R"(/>
  <size nuserdata="32"/>
  <worldbody>
    )" + rotor +
         R"(
    <body name="ring" pos="0 0 0.1">)" +
         ring + R"(<geom name="bore" type="box" size="0.06 0.06 0.01"
      mass="1" contype="0" conaffinity="0"/></body>
  </worldbody>
  <contact><pair geom1="disc" geom2="bore" condim="1" margin="5e-6" gap="1"/></contact>
  <custom>
    <text name="rotorub_rotor_geom" data="disc"/>
    <text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data="rigid"/>
    <numeric name="rotorub_clearance" data="5e-4"/>
    <numeric name="rotorub_friction" data="0.15"/>
    <numeric name="rotorub_restitution" data="0.5"/>
  </custom>
  )" + more +
         "</mujoco>";
}

const std::string kDisc =
    R"(<geom name="disc" type="cylinder" size="0.05 0.01" pos="0 0 0.1" contype="0" conaffinity="0" mass="0"/>)";

// A rigid rotor that tilts in its bearings: a shaft of 3 kg whose centre of mass lies below the
// contact.
std::string tilting(const std::string& spin, const std::string& more = "") {
  return machine(R"(<body name="shaft">
      <joint name="x" type="slide" axis="1 0 0" stiffness="3e5" damping="30"/>
      <joint name="y" type="slide" axis="0 1 0" stiffness="4e5" damping="40"/>
      <joint name="tilt_x" type="hinge" axis="1 0 0" stiffness="2e3" damping="0.3"/>
      <joint name="tilt_y" type="hinge" axis="0 1 0" stiffness="3e3" damping="0.2"/>
      <inertial pos="0 0 0.02" mass="1" diaginertia="4e-3 4e-3 1e-3"/>
      <body name="wheel">
        <joint name="spin" type="hinge" axis=")" +
                     spin + R"("/>
        <inertial pos="0 0 0.05" mass="2" diaginertia="6e-3 6e-3 1e-2"/>
        )" + kDisc + R"(
      </body>
    </body>)",
                 "", more);
}

using NativeTwinTest = MujocoTest;

TEST_F(NativeTwinTest, HasTheNumbersOfTheSceneThatSaysTheSame) {
  std::ifstream in(std::string(ROTORUB_MJCF_DIR) + "/examples/own_model.xml");
  std::ostringstream text;
  text << in.rdbuf();
  const NativeTwin twin = twin_of(text.str());
  EXPECT_TRUE(twin.limits.empty()) << twin.limits.front();
  const Model model = make_model(twin.scene);
  ASSERT_EQ(model.layout.modes, 1);
  ASSERT_EQ(model.nq(), 5);
  const double inertia = 2.2e-3 + 1.8 * 2e-4 * 2e-4;
  const double mass[] = {2.0, 2.0, inertia, 1.0, 1.0};
  const double stiffness[] = {2e5, 2e5, 0.0, 1e5, 1e5}, damping[] = {40.0, 40.0, 0.0, 200.0, 200.0};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(model.mass[i], mass[i], 1e-12 * mass[i]) << i;
    EXPECT_NEAR(model.stiffness[i], stiffness[i], 1e-9 * 2e5) << i;
    EXPECT_NEAR(model.damping[i], damping[i], 1e-9 * 200.0) << i;
  }
  ASSERT_EQ(model.unbalances.size(), 1U);
  EXPECT_NEAR(model.unbalances[0].static_moment, 1.8 * 2e-4, 1e-15);
  EXPECT_NEAR(model.unbalances[0].phase, 0.0, 1e-12);
  ASSERT_TRUE(twin.scene.drive);
  EXPECT_NEAR(twin.scene.drive->gain, 0.0501, 1e-10);
  EXPECT_NEAR(twin.scene.drive->speed, 16.0 / 0.0501, 1e-6);
  EXPECT_EQ(twin.scene.rotor.speed, 300.0);
  EXPECT_EQ(twin.scene.first().contact->clearance, 5e-4);
  EXPECT_EQ(twin.scene.run.step, 1e-5);
}

// Gyroscopics, anisotropic bearings, tilt that moves the contact: against MuJoCo's own free motion,
// whose error falls with its step.
TEST_F(NativeTwinTest, MovesAsMujocoWithoutContact) {
  for (const char* axis : {"0 0 1", "0 0 -1"}) {
    const std::string document = tilting(
        axis,
        R"(<keyframe><key name="start" qpos="1e-5 2e-5 1e-4 -2e-4 0" qvel="1e-3 0 0.01 0.02 400"/></keyframe>)");
    const ModelPointer m = load(document);
    double error[2];
    for (int k = 0; k < 2; ++k) {
      m->opt.timestep = k == 0 ? 1e-5 : 5e-6;
      const NativeTwin twin = twin_of(m.get());
      NativeOptions options;
      options.integrator = scene::Integrator::kEvent;
      scene::Scene scene = twin.scene;
      scene.run.end = 0.02;
      scene.run.output_times = {0.02};
      const Model model = make_model(scene);
      const Trajectory native = run_native(scene, options);
      ASSERT_EQ(native.status, Status::kOk) << native.message;
      const DataPointer d = start(m.get());
      const int steps = k == 0 ? 2000 : 4000;
      for (int i = 0; i < steps; ++i) mj_step(m.get(), d.get());
      Eigen::VectorXd q(model.nq()), v(model.nq());
      twin.read(m.get(), d.get(), q.data(), v.data());
      const Eigen::Vector2d there = rotor_point(model, q.data());
      const Eigen::Vector2d here(native.column("rotor_x").back(), native.column("rotor_y").back());
      error[k] = (there - here).norm();
    }
    EXPECT_LT(error[0], 3e-7) << axis;
    EXPECT_NEAR(error[0] / error[1], 2.0, 0.1) << axis;
  }
}

// A rotor that stands beside the ring's centre, in gravity: its rest is where its springs hold it.
TEST_F(NativeTwinTest, StandsWhereTheSpringsHoldIt) {
  const std::string document = machine(
      R"(<body name="shaft" pos="1e-4 -5e-5 0">
      <joint name="x" type="slide" axis="1 0 0" stiffness="3e5" damping="3000"/>
      <joint name="y" type="slide" axis="0 1 0" stiffness="4e5" damping="3000"/>
      <inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 1e-3 1e-3"/>)" +
          kDisc + "</body>",
      R"(<joint name="ring_x" type="slide" axis="1 0 0" stiffness="1e5" damping="800"/>
      <joint name="ring_y" type="slide" axis="0 -1 0" stiffness="1e5" damping="800"/>)",
      "", "gravity=\"9 -6 0\"");
  const NativeTwin twin = twin_of(document);
  scene::Scene scene = twin.scene;
  scene.run.end = 0.5;
  const Trajectory t = run_native(scene, {});
  ASSERT_EQ(t.status, Status::kOk);
  EXPECT_NEAR(t.column("rotor_x").back(), 1e-4 + 18.0 / 3e5, 1e-12);
  EXPECT_NEAR(t.column("rotor_y").back(), -5e-5 - 12.0 / 4e5, 1e-12);
  EXPECT_NEAR(t.column("stator_x").back(), 9.0 / 1e5, 1e-12);
  EXPECT_NEAR(t.column("stator_y").back(), -6.0 / 1e5, 1e-12);
}

TEST_F(NativeTwinTest, SaysWhatItLeavesOut) {
  // A pendulum: what swings by a clearance turns by a hundredth.
  const NativeTwin swinging = twin_of(machine(
      R"(<body name="arm" pos="0 0 0.05">
      <joint name="a" type="hinge" axis="0 1 0" stiffness="50" limited="true" range="-10 10"/>
      <joint name="b" type="hinge" axis="1 0 0" stiffness="50" frictionloss="0.1"/>
      <inertial pos="0 0 0.05" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
      <geom name="disc" type="cylinder" size="0.05 0.01" pos="0 0 0.05" contype="0" conaffinity="0" mass="0"/>
      </body>)"));
  std::string all;
  for (const std::string& limit : swinging.limits) all += limit + "\n";
  EXPECT_NE(all.find("\"a\"> is limited"), std::string::npos) << all;
  EXPECT_NE(all.find("\"b\"> loses 0.1"), std::string::npos) << all;
  const NativeTwin tilting_far = twin_of(machine(
      R"(<body name="arm" pos="0 0 0.098">
      <joint name="a" type="hinge" axis="0 1 0" stiffness="50"/>
      <joint name="b" type="hinge" axis="1 0 0" stiffness="50"/>
      <inertial pos="0 0 0.05" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
      <geom name="disc" type="cylinder" size="0.05 0.01" pos="0 0 0.002" contype="0" conaffinity="0" mass="0"/>
      </body>)"));
  const std::string friction = R"(<numeric name="rotorub_friction" data="0.15"/>)";
  const NativeTwin lifted = twin_of(machine(R"(<body name="shaft">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint name="lift" type="slide" axis="0 0 1"/>
      <inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 1e-3 1e-3"/>)" +
                                            kDisc + "</body>"));
  ASSERT_EQ(lifted.limits.size(), 2u);
  EXPECT_NE(lifted.limits[0].find("\"lift\"> moves nothing in the contact's plane"),
            std::string::npos);
  EXPECT_NE(lifted.limits[1].find("friction along the ring's axis"), std::string::npos);
  ASSERT_FALSE(tilting_far.limits.empty());
  EXPECT_NE(tilting_far.limits[0].find("not small"), std::string::npos) << tilting_far.limits[0];
}

TEST_F(NativeTwinTest, RefusesByTheJointsName) {
  const std::string slides =
      R"(<joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/>)";
  const auto body = [&](const std::string& joints) {
    return "<body name=\"shaft\">" + joints +
           R"(<inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 2e-3 3e-3"/>)" + kDisc + "</body>";
  };
  const std::string ring = R"(<joint name="ring_x" type="slide" axis="1 0 0"/>)";
  EXPECT_NE(twin_refusal(machine(body(slides), ring)).find("ring_x"), std::string::npos);
  EXPECT_NE(
      twin_refusal(
          machine(body(
              R"(<joint name="skew" type="slide" axis="1 1 0"/><joint name="y" type="slide" axis="0 1 0"/>)")))
          .find("skew"),
      std::string::npos);
  EXPECT_NE(twin_refusal(machine(body(R"(<joint name="free" type="free"/>)"))).find("free"),
            std::string::npos);
  EXPECT_NE(twin_refusal(machine(body(slides), R"(<joint name="turn" type="hinge" axis="0 0 1"/>)"))
                .find("turn"),
            std::string::npos);
  EXPECT_NE(
      twin_refusal(machine(body(R"(<joint name="x" type="slide" axis="1 0 0"/>)"))).find("along y"),
      std::string::npos);
  EXPECT_NE(
      twin_refusal(
          machine(body(slides + R"(<joint name="spin" type="hinge" axis="0 0 1" stiffness="3"/>)")))
          .find("spin"),
      std::string::npos);
  // Before the slides it carries their axes round: the rotor's springs would turn with it.
  const std::string early =
      twin_refusal(machine(body(R"(<joint name="early" type="hinge" axis="0 0 1"/>)" + slides)));
  EXPECT_NE(early.find("\"early\">: turns the axis of <joint name=\"x\">"), std::string::npos)
      << early;
}

// The native model has one contact plane.
TEST_F(NativeTwinTest, RefusesSeveralContacts) {
  const std::string said = twin_refusal(document(TwoRings{}));
  EXPECT_NE(said.find("2 contacts"), std::string::npos) << said;
  EXPECT_NE(said.find("accepted for a twin: one contact"), std::string::npos) << said;
}

}  // namespace
}  // namespace rotorub::test
