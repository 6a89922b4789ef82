// The native twin of a user's own machine whose ring turns, an auxiliary ball bearing: its numbers,
// its free turning against the closed form, and what has no twin. (Its rub: tests/compare/own.)
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/twin/twins.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/oracles/turning_ring.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using TwinOfATurningRing = MujocoTest;

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
  ASSERT_EQ(t.status, Status::kOk) << t.message;
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

// The refusal names the hinge and says the reason.
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
