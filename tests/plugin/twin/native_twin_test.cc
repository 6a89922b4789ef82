// The native twin of a user's own model: its numbers against the scene that says the same, and what
// has no twin. Its motion: free_motion_test.cc.
#include "plugin/twin/native_twin.h"

#include <gtest/gtest.h>

#include "native_model/model/dynamics.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/plugin/twin/twins.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using plugin::NativeTwin;

using NativeTwinTest = MujocoTest;

TEST_F(NativeTwinTest, HasTheNumbersOfTheSceneThatSaysTheSame) {
  const NativeTwin twin = twin_of(own_model_example());
  EXPECT_TRUE(twin.limits.empty()) << twin.limits.front();
  const Model model = prepare(twin.scene);
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
  EXPECT_TRUE(contains(all, {"\"a\"> is limited", "\"b\"> loses 0.1 N m to friction"}));
  const NativeTwin tilting_far = twin_of(machine(
      R"(<body name="arm" pos="0 0 0.098">
      <joint name="a" type="hinge" axis="0 1 0" stiffness="50"/>
      <joint name="b" type="hinge" axis="1 0 0" stiffness="50"/>
      <inertial pos="0 0 0.05" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
      <geom name="disc" type="cylinder" size="0.05 0.01" pos="0 0 0.002" contype="0" conaffinity="0" mass="0"/>
      </body>)"));
  const NativeTwin lifted = twin_of(machine(R"(<body name="shaft">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/><joint name="lift" type="slide" axis="0 0 1"/>
      <inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 1e-3 1e-3"/>)" +
                                            kDisc + "</body>"));
  ASSERT_EQ(lifted.limits.size(), 2u);
  EXPECT_TRUE(
      contains(lifted.limits[0], "\"lift\"> does not move rotor or ring in the contact's plane"));
  EXPECT_TRUE(contains(lifted.limits[1], "friction along the ring's axis"));
  ASSERT_FALSE(tilting_far.limits.empty());
  EXPECT_TRUE(contains(tilting_far.limits[0], "not small"));
}

// A free joint has six degrees of freedom and often no name.
TEST_F(NativeTwinTest, NamesAJointOnceAndByItsBody) {
  const NativeTwin beside = twin_of(machine(
      R"(<body name="shaft">
      <joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>
      <inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 1e-3 1e-3"/>)" +
      kDisc + R"(</body><body name="box" pos="1 0 0"><freejoint/>
      <geom type="box" size="0.1 0.1 0.1" contype="0" conaffinity="0"/></body>)"));
  ASSERT_EQ(beside.limits.size(), 1u);
  EXPECT_EQ(beside.limits[0],
            "the free joint of <body name=\"box\"> does not move rotor or ring in the contact's "
            "plane, so it is left out");
}

TEST_F(NativeTwinTest, RefusesByTheJointsName) {
  const auto joint = [](const std::string& name, const std::string& axis,
                        const std::string& type = "slide") {
    return "<joint name=\"" + name + "\" type=\"" + type + "\" axis=\"" + axis + "\"/>";
  };
  const std::string x = joint("x", "1 0 0"), y = joint("y", "0 1 0");
  const auto expect = [](const std::string& rotor, const std::string& ring, const char* named) {
    const std::string body = "<body name=\"shaft\">" + rotor +
                             R"(<inertial pos="0 0 0.1" mass="2" diaginertia="1e-3 2e-3 3e-3"/>)" +
                             kDisc + "</body>";
    EXPECT_TRUE(contains(twin_refusal(machine(body, ring)), named));
  };
  expect(x + y, joint("ring_x", "1 0 0"), "ring_x");
  expect(x + y, joint("turn", "0 0 1", "hinge"), "turn");
  expect(joint("skew", "1 1 0") + y, "", "skew");
  expect(R"(<joint name="free" type="free"/>)", "", "free");
  expect(x, "", "along y");
  expect(x + y + R"(<joint name="spin" type="hinge" axis="0 0 1" stiffness="3"/>)", "", "spin");
  // Before the slides it carries their axes round: the rotor's springs would turn with it.
  expect(joint("early", "0 0 1", "hinge") + x + y, "",
         "\"early\">: turns the axis of <joint name=\"x\">");
}

// Each contact has its own mode shapes, ring and parameters.
TEST_F(NativeTwinTest, HasEachContactAtItsStation) {
  TwoRings x;
  x.ring_mass = 3.0;
  x.clearance[1] = 4e-4;
  const NativeTwin twin = twin_of(document(x));
  const Model model = prepare(twin.scene);
  ASSERT_EQ(model.auxiliary.size(), 2U);
  ASSERT_EQ(model.layout.stator, 4);
  EXPECT_EQ(model.auxiliary[0].contact->clearance, 5e-4);
  EXPECT_EQ(model.auxiliary[1].contact->clearance, 4e-4);
  // 1/m + a b / J at stations a and b, 0.1 m on either side; at their own with the ring's 1/3 kg.
  const auto admittance = [&](std::size_t i, std::size_t j) {
    return contact_admittance(model, model.mass.data(), 0.0, model.q0.data(), i, j)(0, 0);
  };
  EXPECT_NEAR(admittance(0, 0), 0.5 + 0.01 / 0.02 + 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(admittance(1, 1), 0.5 + 0.01 / 0.02 + 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(admittance(0, 1), 0.5 - 0.01 / 0.02, 1e-12);
}

// Rings beside the line of the rotor: each contact's zero is its ring's centre.
TEST_F(NativeTwinTest, HasRingsOffTheLine) {
  const std::string text = replaced(document(TwoRings{}), R"(<body name="holder" pos="0 0 0.1">)",
                                    R"(<body name="holder" pos="1e-4 -2e-4 0.1">)");
  const Model model = prepare(twin_of(text).scene);
  const double* q = model.q0.data();
  EXPECT_NEAR(separation(model, q, 0).norm(), 0.0, 1e-15);
  EXPECT_NEAR((separation(model, q, 1) - Eigen::Vector2d(-1e-4, 2e-4)).norm(), 0.0, 1e-15);
}

TEST_F(NativeTwinTest, RefusesContactsThatHaveNoPlaceBesideTheFirst) {
  TwoRings x;
  x.ring_mass = 1.0;
  const std::string plain = document(x);
  ASSERT_EQ(twin_refusal(plain), "");
  // A ring that is turned over sees the rotor turn the other way.
  EXPECT_TRUE(contains(twin_refusal(replaced(plain, R"(<body name="holder" )",
                                             R"(<body name="holder" euler="180 0 0" )")),
                       "<geom name=\"holder\">: its z axis"));
  // One housing for both.
  const std::string housing =
      replaced(replaced(plain, R"(</body><body name="holder" pos="0 0 0.1")",
                        R"(<body name="holder" pos="0 0 0.2")"),
               "</worldbody>", "</body></worldbody>");
  EXPECT_TRUE(contains(twin_refusal(housing), "moves two rings"));
  // The scene's gravity is one.
  const std::string pushed =
      replaced(plain, R"(<body name="holder" pos="0 0 0.1"><joint )",
               R"(<body name="holder" pos="0 0 0.1"><joint stiffness="1e5" springref="1e-5" )");
  EXPECT_TRUE(contains(twin_refusal(pushed), "another load"));
  x.friction = 0.15;
  std::string cone =
      replaced(replaced(document(x), R"(name="rotorub_contact_2" data="rigid")",
                        R"(name="rotorub_contact_2" data="cone")"),
               R"(geom2="holder" condim="1" margin="5e-6" gap="1")",
               R"(geom2="holder" condim="3" friction="0.15 0.15 0 0 0" solref="-4e8 -10211.0255")");
  const std::string early = "needstage=\"vel\"";
  for (std::size_t at; (at = cone.find(early)) != cone.npos;) {
    cone.replace(at, early.size(), "needstage=\"acc\"");
  }
  EXPECT_TRUE(contains(twin_refusal(cone), "contacts by rigid and cone"));
}

}  // namespace
}  // namespace rotorub::test
