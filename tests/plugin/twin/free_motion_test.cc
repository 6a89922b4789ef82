// The free motion of the native twin of a user's own model against MuJoCo's.
#include "plugin/twin/native_twin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "native_model/model/dynamics.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/plugin/twin/twins.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/turning_ring.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using plugin::NativeTwin;

using TwinMotionTest = MujocoTest;
using TwinOfATurningRing = MujocoTest;

// A spindle of one body that tilts: all its unbalance is a mass of 10 g at the tool's end, 0.14 m
// from the centre of mass of the body, which is a couple besides a force. `more`: other masses.
std::string spindle(const std::string& speed, const std::string& more = "",
                    const std::string& frame = "", const std::string& option = "gravity=\"0 0 0\"",
                    const std::string& ring = "") {
  return machine("<body name=\"shaft\" " + frame + R"(>
      <joint name="x" type="slide" axis="1 0 0" stiffness="3e5" damping="30"/>
      <joint name="y" type="slide" axis="0 1 0" stiffness="4e5" damping="40"/>
      <joint name="tilt_x" type="hinge" axis="1 0 0" stiffness="2e3" damping="0.3"/>
      <joint name="tilt_y" type="hinge" axis="0 1 0" stiffness="3e3" damping="0.2"/>
      <inertial pos="0 0 0" mass="0.1" diaginertia="1e-4 1e-4 1e-4"/>
      <body name="spindle">
        <joint name="spin" type="hinge" axis="0 0 1"/>
        <geom type="cylinder" size="0.03 0.05" mass="2" contype="0" conaffinity="0"/>
        <geom type="sphere" size="0.002" pos="0.003 0.001 0.14" mass="0.01" contype="0"
          conaffinity="0"/>)" +
                     more + kDisc + "</body></body>",
                 ring,
                 "<keyframe><key name=\"start\" qvel=\"0 0 0 0 " + speed +
                     (ring.empty() ? "" : " 0 0") + "\"/></keyframe>",
                 option);
}

struct FreeMotion {
  double error;      // m, largest distance of the two in the contact's plane
  double amplitude;  // m, largest of MuJoCo's
};

// Of the twin by `event` against MuJoCo's own, over 0.02 s.
FreeMotion free_motion(const std::string& document, double step) {
  const ModelPointer m = load(document);
  m->opt.timestep = step;
  const NativeTwin twin = twin_of(m.get());
  const int rows = 40, each = static_cast<int>(std::lround(5e-4 / step));
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  scene::Scene scene = twin.scene;
  scene.run.end = 0.02;
  scene.run.output_step = scene.run.end / rows;
  const Model model = prepare(scene);
  const Trajectory native = complete(run_native(scene, options));
  EXPECT_TRUE(native.impacts.empty()) << "it must not touch";
  const DataPointer d = start(m.get());
  const int disc = mj_name2id(m.get(), mjOBJ_GEOM, "disc");
  const int bore = mj_name2id(m.get(), mjOBJ_GEOM, "bore");
  FreeMotion all{0.0, 0.0};
  for (int row = 1; row <= rows; ++row) {
    for (int i = 0; i < each; ++i) mj_step(m.get(), d.get());
    mj_kinematics(m.get(), d.get());
    mjtNum apart[3], here[3];
    mju_sub3(apart, d->geom_xpos + 3 * disc, d->geom_xpos + 3 * bore);
    mju_mulMatTVec(here, d->geom_xmat + 9 * bore, apart, 3, 3);
    const auto at = [&](const char* column) {
      return native.column(column)[static_cast<std::size_t>(row)];
    };
    const double x = at("rotor_x") - at("stator_x"), y = at("rotor_y") - at("stator_y");
    all.error = std::max(all.error, std::hypot(x - here[0], y - here[1]));
    all.amplitude = std::max(all.amplitude, std::hypot(here[0], here[1]));
  }
  return all;
}

// Against MuJoCo's own free motion, whose error falls with its step.
void expect_free_motion(const std::string& document, double share = 0.02) {
  const FreeMotion coarse = free_motion(document, 1e-5), fine = free_motion(document, 5e-6);
  EXPECT_LT(coarse.error, share * coarse.amplitude);
  EXPECT_GT(coarse.amplitude, 1e-6);
  EXPECT_NEAR(coarse.error / fine.error, 2.0, 0.2);
}

// Gyroscopics, anisotropic bearings, tilt that moves the contact.
TEST_F(TwinMotionTest, MovesAsMujocoWithoutContact) {
  for (const char* axis : {"0 0 1", "0 0 -1"}) {
    SCOPED_TRACE(axis);
    expect_free_motion(tilting(
        axis,
        R"(<keyframe><key name="start" qpos="1e-5 2e-5 1e-4 -2e-4 0" qvel="1e-3 0 0.01 0.02 400"/></keyframe>)"));
  }
}

// Unbalance beside the centre of mass is a moment as well, by the body's products of inertia.
TEST_F(TwinMotionTest, KnowsDynamicUnbalance) {
  {
    SCOPED_TRACE("at the tool's end");
    expect_free_motion(spindle("400"));
  }
  {
    SCOPED_TRACE("spinning the other way");
    expect_free_motion(spindle("-400"));
  }
  {
    SCOPED_TRACE("in two planes, a quarter turn apart");
    expect_free_motion(spindle("400", R"(<geom type="sphere" size="0.002" pos="-0.001 0.004 -0.05"
      mass="0.01" contype="0" conaffinity="0"/>)"));
  }
  {
    SCOPED_TRACE("a couple alone");
    expect_free_motion(spindle("400", R"(<geom type="sphere" size="0.002" pos="-0.003 -0.001 -0.14"
      mass="0.01" contype="0" conaffinity="0"/>)"));
  }
}

// A rotor that stands beside the ring's centre, in gravity: its rest is where its springs hold it.
TEST_F(TwinMotionTest, StandsWhereTheSpringsHoldIt) {
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
  const Trajectory t = complete(run_native(scene, {}));
  EXPECT_NEAR(t.column("rotor_x").back(), 1e-4 + 18.0 / 3e5, 1e-12);
  EXPECT_NEAR(t.column("rotor_y").back(), -5e-5 - 12.0 / 4e5, 1e-12);
  EXPECT_NEAR(t.column("stator_x").back(), 9.0 / 1e5, 1e-12);
  EXPECT_NEAR(t.column("stator_y").back(), -6.0 / 1e5, 1e-12);
}

// ---------------------------------------------------------------- turning rings
// The native twin of a user's own machine whose ring turns, an auxiliary ball bearing: its numbers,
// its free turning against the closed form, and what has no twin. (Its rub: tests/compare/own.)

constexpr double kInertia = 1e-3, kArmature = 3e-4, kDrag = 2e-3;  // kg m^2, N m s
constexpr double kSpeed = 50.0;                                    // rad/s, about the hinge's axis

// `turn`: what a test says of the hinge beside its name and axis.
Machine turning(const std::string& turn, const std::string& axis = "0 0 1") {
  Machine x;
  x.ring_geoms = "<joint name=\"turn\" type=\"hinge\" axis=\"" + axis + "\" " + turn + "/>";
  x.constraints = R"(<keyframe><key name="start" qvel="0 0 100 0 0 50"/></keyframe>)";
  return x;
}
const std::string kDragged = R"(damping="2e-3" armature="3e-4")";

TEST_F(TwinOfATurningRing, HasItsInertiaDragAndSpeed) {
  for (const double sense : {1.0, -1.0}) {
    const auto twin = twin_of(document(turning(kDragged, sense > 0.0 ? "0 0 1" : "0 0 -1")));
    EXPECT_TRUE(twin.limits.empty()) << twin.limits.front();
    const Model model = prepare(twin.scene);
    ASSERT_EQ(model.layout.ring_spin, 1);
    ASSERT_EQ(model.nq(), 6);
    const int turn = model.layout.ring_angle();
    EXPECT_NEAR(model.mass[turn], kInertia + kArmature, 1e-15);
    EXPECT_NEAR(model.damping[turn], kDrag, 1e-12);
    EXPECT_EQ(model.v0[turn], sense * kSpeed);
    EXPECT_NEAR(model.mass[model.layout.ring()], 1.0, 1e-12) << "the slides are what they were";
  }
}

TEST_F(TwinOfATurningRing, SpinsDownAsTheClosedFormAndAsMujoco) {
  const ModelPointer m = load(document(turning(kDragged, "0 0 -1")));
  const auto twin = twin_of(m.get());
  scene::Scene scene = twin.scene;
  scene.run.end = 0.5;
  scene.run.output_step = 0.02;
  const Trajectory t = run_event(scene);
  const oracle::TurningRing ring{kInertia + kArmature, kDrag, 0.0505};
  const auto exact = [&](double time) { return oracle::ring_speed(ring, 0.0, -kSpeed, time); };
  ASSERT_GT(t.rows(), 20U);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    EXPECT_NEAR(t.column("ring_speed")[k], exact(t.column("t")[k]), 1e-9 * kSpeed);
  }
  EXPECT_LT(std::abs(t.column("ring_speed").back()), 0.5 * kSpeed) << "it has slowed down";

  // MuJoCo's damping is implicit, c^2 h t / (2 J^2) = 2.4e-7 of the speed too much is left; its
  // angle goes with the speeds of the steps' ends, h / 2 of what the speed changes by too far.
  const DataPointer d = start(m.get());
  for (int k = 0; k < 2000; ++k) mj_step(m.get(), d.get());
  const Model model = prepare(twin.scene);
  Eigen::VectorXd q(model.nq()), v(model.nq());
  twin.read(m.get(), d.get(), q.data(), v.data());
  const int turn = model.layout.ring_angle();
  EXPECT_NEAR(v[turn], exact(d->time), 3e-7 * kSpeed);
  const double change = exact(d->time) + kSpeed, angle = -(kInertia + kArmature) / kDrag * change;
  EXPECT_NEAR(q[turn], angle + 0.5 * m->opt.timestep * change, 3e-7 * kSpeed * d->time);
}

// The refusal names the hinge and has the reason.
void expect_no_twin(const std::string& document, std::string_view reason) {
  EXPECT_TRUE(contains(twin_refusal(document), {"<joint name=\"turn\">", reason}));
}

TEST_F(TwinOfATurningRing, WhatItCannotTakeIsRefusedByName) {
  ASSERT_EQ(twin_refusal(document(turning(kDragged))), "");
  expect_no_twin(document(turning(R"(stiffness="3")")), "against a spring");
  expect_no_twin(document(turning(R"(frictionloss="0.1")")), "loses 0.1 N m to dry friction");
  expect_no_twin(document(turning(R"(pos="0.01 0 0")")), "another axis");
  expect_no_twin(document(turning("", "1 0 1")), "another axis");

  const std::string plain = document(turning("")), ring = "<body name=\"ring\">";
  const std::string centred = "<inertial pos=\"0 0 0\"";
  std::string eccentric = plain;
  eccentric.replace(eccentric.find(centred, eccentric.find(ring)), centred.size(),
                    "<inertial pos=\"1e-3 0 0\"");
  expect_no_twin(eccentric, "<joint name=\"ring_y\">: acts on <joint name=\"turn\">");
  Machine geared = turning("");
  geared.constraints += R"(<tendon><fixed stiffness="1"><joint joint="turn" coef="1"/>
    <joint joint="spin" coef="-1"/></fixed></tendon>)";
  expect_no_twin(document(geared), "<joint name=\"turn\">: acts on <joint name=\"spin\">");

  Machine motor = turning("");
  motor.constraints = R"(<actuator><motor joint="turn"/></actuator>
    <keyframe><key name="start" ctrl="0.1"/></keyframe>)";
  expect_no_twin(document(motor), "0.1 N m at rest");
  std::vector<std::string> drags{
      R"(biasprm="0 0 -0.01" forcelimited="true" forcerange="-0.1 0.1")"};
  // Later releases read a positive number there as a damping ratio, of a stiffness that is not
  // there.
  if (mj_version() < 300) drags.push_back(R"(biasprm="0 0 0.01")");
  for (const std::string& drag : drags) {
    Machine fed = turning("");
    fed.constraints +=
        std::string(R"(<actuator><general joint="turn" biastype="affine" gainprm="0" )") + drag +
        "/></actuator>";
    expect_no_twin(document(fed), "drag");
  }

  Machine two = turning("");
  two.ring_geoms =
      R"(<joint name="first" type="hinge" axis="0 0 1" armature="1e-3"/>)" + two.ring_geoms;
  two.constraints = "";
  expect_no_twin(document(two), "second joint about the ring's axis");

  // Before the slides it carries their axes round.
  const std::string hinge = R"(<joint name="turn" type="hinge" axis="0 0 1" />)";
  const std::string before = replaced(replaced(plain, hinge, ""), ring, ring + hinge);
  expect_no_twin(before, "turns the axis of <joint name=\"ring_x\">");

  // scene::Stator: what turns has a mass to move.
  Machine held = turning("");
  held.ring_moves = false;
  held.constraints = "";
  expect_no_twin(document(held), "a ring that does not move");
}

}  // namespace
}  // namespace rotorub::test
