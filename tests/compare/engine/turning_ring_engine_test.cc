// A ring that turns, [stator.spin], in MuJoCo: spun up by a rub whose force is known, on the modal
// chain and under the segment rotor, and beside its shadow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/engine/mujoco_engine.h"
#include "native_model/oracles/annular_rub.h"
#include "native_model/run/run_native.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/oracles/turning_ring.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

constexpr double kInertia = 2e-3, kStart = 3.0;  // kg m^2, rad/s

struct Rub {
  scene::Scene scene;
  double torque;  // N m, of friction on the ring
};
// bench_annular_elastic, in which the normal force is constant; drag holds the ring near 60 rad/s,
// well below rolling.
Rub rub() {
  const scene::Scene plain = shipped("bench_annular_elastic");
  const scene::RotorModal& m = *plain.rotor.modal;
  const scene::Stator& ring = *plain.first().stator;
  const auto exact = oracle::annular_rub({m.mass[0], m.damping[0], m.stiffness[0]},
                                         {ring.mass.x(), ring.damping.x(), ring.stiffness.x()},
                                         plain.first().contact->clearance,
                                         plain.first().contact->friction.coefficient,
                                         plain.forces[0].amplitude, plain.forces[0].frequency);
  const double torque = plain.first().contact->friction.coefficient * exact.value().force *
                        (plain.first().contact->radius + plain.first().contact->clearance);
  const std::string spin = "stator.spin={inertia=" + std::to_string(kInertia) +
                           ",drag=" + std::to_string(torque / 60.0) +
                           ",speed=" + std::to_string(kStart) + "}";
  Rub out{shipped("bench_annular_elastic", {spin, "run.end=0.1"}), torque};
  return out;
}

double largest_miss(const Rub& r, const Trajectory& t) {
  const oracle::TurningRing ring{
      kInertia, r.scene.first().stator->spin->drag,
      r.scene.first().contact->radius + r.scene.first().contact->clearance};
  double most = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double exact = oracle::ring_speed(ring, r.torque, kStart, t.column("t")[k]);
    most = std::max(most, std::abs(t.column("ring_speed")[k] - exact));
  }
  return most;
}

TEST(TurningRingEngine, TheRubSpinsItUpAsTheClosedFormSays) {
  const Rub r = rub();
  const auto expect = [&](scene::ContactModel contact, double gain) {
    const Trajectory coarse = mujoco_run(r.scene, contact, 1e-4),
                     fine = mujoco_run(r.scene, contact, 1e-5);
    EXPECT_GT(fine.column("ring_speed").back(), 20.0);
    EXPECT_GT(largest_miss(r, coarse) / largest_miss(r, fine), gain) << fine.contact_model;
    EXPECT_LT(largest_miss(r, fine), 1e-3 * 60.0) << fine.contact_model;
  };
  expect(scene::ContactModel::kRigid, 80.0);  // of second order
  expect(scene::ContactModel::kCoulomb, 8.0);
}

// The lever of the cone's contact is also the ring's bore: its mean friction spins the ring up.
TEST(TurningRingEngine, TheConeSpinsItUpToo) {
  const Rub r = rub();
  const Trajectory t = mujoco_run(r.scene, scene::ContactModel::kCone, 1e-5);
  EXPECT_LT(largest_miss(r, t), 0.2 * 60.0);
}

// Impacts and a lasting rub on the rig cut into segments, against the native beam.
TEST(TurningRingEngine, TheSegmentRotorTurnsItAsTheNativeBeamDoes) {
  const scene::Scene scene =
      shipped("paper_passive",
              {"mujoco={rotor=\"segments\", segments=12}", "run.step=1e-5", "run.end=0.02",
               "force[0].on=0.0", "initial.steady=false", "contact.friction=0.1", "rotor.modes=5",
               "rotor.torsion.modes=3", "stator.spin={inertia=2e-4,drag=1e-4}"});
  const Trajectory native = run_native(scene);
  const double exact = native.column("ring_speed").back();
  ASSERT_GT(exact, 5.0);
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    EXPECT_NEAR(mujoco_run(scene, contact, 1e-5).column("ring_speed").back(), exact, 0.05 * exact);
  }
}

}  // namespace
}  // namespace rotorub::test
