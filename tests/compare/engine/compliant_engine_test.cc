// Contacts that give in MuJoCo, against the native law: `coulomb`, whose force is the plugin's, and
// `cone-coulomb`, whose force and friction MuJoCo's solver finds. MuJoCo's step is of first order.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using scene::ContactModel;

const std::vector<std::vector<std::string>> kLaws{
    {"contact.compliance.stiffness=1e7"},
    {"contact.compliance.stiffness=1e7", "contact.compliance.damping=2000"},
    {"contact.compliance.stiffness=1e9", "contact.compliance.exponent=1.5"},
    {"contact.compliance.stiffness=1e9", "contact.compliance.exponent=1.5",
     "contact.compliance.hunt_crossley=0.5", "contact.friction=0"},
};

scene::Scene ring(std::vector<std::string> overrides) {
  overrides.push_back("run.end=0.012");
  return test::shipped("bench_ring", overrides);
}

TEST(CompliantInMujoco, TendsToTheNativeLawWithItsStep) {
  for (const auto& law : kLaws) {
    const scene::Scene scene = ring(law);
    const Trajectory exact = test::run_event(scene);
    ASSERT_GT(exact.statistics.contact_time, 1e-3);
    for (const ContactModel contact : {ContactModel::kCoulomb, ContactModel::kConeCoulomb}) {
      const test::Convergence c = test::convergence({4e-6, 1e-6}, [&](double step) {
        return test::trajectory_error(test::mujoco_run(scene, contact, step), exact);
      });
      const std::string who = scene::to_string(contact) + (" " + law.back());
      EXPECT_GT(c.order(), 0.85) << who << " " << c.text();
      EXPECT_LT(c.errors.back(), 1e-6) << who;  // m, of a clearance of 5e-4
    }
  }
}

TEST(CompliantInMujoco, TheFiguresAreThoseOfTheLaw) {
  const scene::Scene scene = ring({"contact.compliance.stiffness=1e7"});
  const Trajectory exact = test::run_event(scene);
  for (const ContactModel contact : {ContactModel::kCoulomb, ContactModel::kConeCoulomb}) {
    const Trajectory t = test::mujoco_run(scene, contact, 1e-6);
    EXPECT_EQ(t.impacts.size(), exact.impacts.size());
    EXPECT_NEAR(t.statistics.peak_force / exact.statistics.peak_force, 1.0, 0.01);
    EXPECT_NEAR(t.statistics.max_penetration / exact.statistics.max_penetration, 1.0, 0.01);
    EXPECT_NEAR(t.statistics.impulse_total / exact.statistics.impulse_total, 1.0, 0.003);
    EXPECT_NEAR(t.statistics.friction_work / exact.statistics.friction_work, 1.0, 0.003);
  }
}

// Two catcher bearings of a rotor: as segments, and on the modal chain by `coulomb`.
TEST(CompliantInMujoco, SeveralContacts) {
  for (const char* rotor : {"modal", "segments"}) {
    scene::Scene scene = test::shipped(
        "two_catchers",
        {std::string("mujoco.rotor=") + rotor, "run.end=0.02", "contact.compliance.stiffness=2e7"});
    const Trajectory exact = test::run_event(scene),
                     t = test::mujoco_run(scene, ContactModel::kCoulomb, 1e-6);
    ASSERT_GT(exact.statistics.contacts[1].contact_time, 1e-4);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(
          t.statistics.contacts[k].impulse_total / exact.statistics.contacts[k].impulse_total, 1.0,
          0.02)
          << rotor << k;
    }
  }
}

// A law that the scene gives ends a run where it does natively: deeper than the clearance.
TEST(CompliantInMujoco, TooSoftAContactIsOutOfRangeAsNatively) {
  const scene::Scene scene = test::shipped(
      "bench_ring", {"contact.compliance.stiffness=1", "run.end=0.1", "run.step=1e-5"});
  const Trajectory exact = test::attempt_event(scene);
  ASSERT_EQ(exact.status, Status::kOutOfRange) << exact.message;
  for (const ContactModel contact : {ContactModel::kCoulomb, ContactModel::kConeCoulomb}) {
    const Trajectory t = run_mujoco(scene, test::mujoco_options(contact, 1e-5));
    EXPECT_EQ(t.status, Status::kOutOfRange) << t.message;
    EXPECT_NE(t.message.find("deep in the ring"), std::string::npos) << t.message;
    EXPECT_NEAR(t.end, exact.end, 1e-4);
  }
}

TEST(CompliantInMujoco, OthersRefuseIt) {
  const scene::Scene scene = ring({"contact.compliance.stiffness=1e7"});
  EXPECT_EQ(scene.mujoco.contact, ContactModel::kCoulomb);
  for (const ContactModel contact : {ContactModel::kRigid, ContactModel::kCone}) {
    const auto refused =
        test::refusals([&] { run_mujoco(scene, test::mujoco_options(contact, 1e-6)); });
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_EQ(refused[0].key, "mujoco.contact");
  }
}

}  // namespace
}  // namespace rotorub
