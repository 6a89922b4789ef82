// The eigenvalues of forced rubs against whole runs of `event`: started a little off a rub, how
// fast does the normal force come back to it, or leave?
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "native_model/linear/rub_stability.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/exponents.h"
#include "tests/native_model/linear/rubs.h"

namespace rotorub::rub {
namespace {

struct Case {
  scene::Scene scene;
  std::size_t root = 0;              // of the two rubs that may exist, by falling force
  double end = 0.05, step = 2.5e-4;  // s
  double off = 1e-4;                 // of the load
};

// Off the rub by what a slightly larger load does: in contact, and too little to be anything but
// linear.
void expect_measured(Case c, bool stable) {
  c.scene.run.end = c.end;
  c.scene.run.output_step = c.step;
  const RubSystem system = rub_system(c.scene);
  RotatingLoad load = rotating_loads(system).front();
  const auto rubs = forced_rubs(system, load);
  ASSERT_GT(rubs.size(), c.root);
  const SteadyRub& rub = rubs[c.root];
  const std::vector<Complex> expected = rub_eigenvalues(system, rub);
  ASSERT_EQ(stability_of(expected).stable, stable) << expected.front();

  load.load *= 1.0 + c.off;
  const auto beside = forced_rubs(system, load);
  ASSERT_GT(beside.size(), c.root);
  const Trajectory t = test::run_event(test::started_on(c.scene, beside[c.root]));
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  EXPECT_NEAR(t.statistics.contact_time, c.end, 1e-12) << "never lifts off";
  std::vector<double> off = t.column("normal_force");
  for (double& force : off) force -= rub.normal_force;
  ASSERT_GT(test::largest(off), 1e-5 * rub.normal_force) << "it was off";

  const auto count = static_cast<Eigen::Index>(expected.size());
  const std::vector<Complex> measured = test::exponents(off, c.step, count);
  // 1 % of the rate, and 0.01 rad/s for what the fit of a few periods leaves.
  double nearest = 1e300;
  Complex found;
  for (const Complex& s : measured) {
    if (std::abs(s - expected.front()) < nearest) {
      nearest = std::abs(s - expected.front());
      found = s;
    }
  }
  const Complex first = expected.front();
  EXPECT_NEAR(found.real(), first.real(), 0.01 * std::abs(first.real()) + 0.01);
  EXPECT_NEAR(found.imag(), first.imag(), 1e-3 * std::abs(first.imag()) + 0.01);
}

// The rig with its spin held, as the eigenvalues have it, and its force always on.
scene::Scene held_rig(double mu) {
  scene::Scene s = test::shipped("paper_passive");
  s.drive.reset();
  s.rotor.torsion.reset();
  s.forces[0].on = 0.0;
  s.initial.steady = false;
  s.first().contact->friction = mu;
  return s;
}

TEST(MeasuredGrowth, ShippedRubOnARigidRingDecays) {
  // On a fixed ring a start beside the rub differs in its direction alone, and that little.
  expect_measured({test::shipped("bench_annular_rigid"), 0, 0.05, 2.5e-4, 1e-2}, true);
}
TEST(MeasuredGrowth, ShippedRubOnAnElasticRingDecays) {
  expect_measured({test::shipped("bench_annular_elastic")}, true);
}
TEST(MeasuredGrowth, TheRigsRubDecaysAtLittleFriction) { expect_measured({held_rig(0.1)}, true); }
// Friction feeds the second bending mode: the rig of the paper cannot rub steadily.
TEST(MeasuredGrowth, TheRigsRubGrowsAtItsOwnFriction) { expect_measured({held_rig(0.3)}, false); }

// Of one mode on a fixed ring the rub's angle eps alone can move, and what friction loses with the
// slip drives it:
//   m eps'' + (d + 2 tau nu m + lambda dmu/dv) eps' + k eps = 0,
//   k = k_r - m nu^2 + tau d nu + lambda (1 + tau^2) / delta_0
// so that the rub is left from lambda dmu/dv = -(d + 2 tau nu m) on.
struct OneMode {
  scene::Scene scene;
  RubSystem system;
  SteadyRub rub;
  double damping, stiffness;  // N s/m, N/m, as above

  // The surface creeps by the whirl at 0.06 m/s, where friction falls steeply.
  explicit OneMode(double excess) : scene(test::shipped("bench_annular_rigid")) {
    scene::Contact& c = *scene.first().contact;
    const double nu = scene.forces[0].frequency;
    scene.rotor.speed = (0.06 - c.clearance * nu) / c.radius;
    c.friction.excess = excess;
    c.friction.stribeck_speed = 0.05;
    system = rub_system(scene);
    rub = forced_rubs(system, rotating_loads(system).front()).at(0);
    const scene::RotorModal& r = *scene.rotor.modal;
    const double tau = rub.friction, m = r.mass[0], d = r.damping[0];
    damping = d + 2.0 * tau * nu * m + rub.normal_force * c.friction.slope(rub.slip);
    stiffness = r.stiffness[0] - m * nu * nu + tau * d * nu +
                rub.normal_force * (1.0 + tau * tau) / c.clearance;
  }
};

double border() {
  double stays = 0.0, goes = 1.0;  // of the excess
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (stays + goes);
    (OneMode(middle).damping > 0.0 ? stays : goes) = middle;
  }
  return stays;
}

TEST(MeasuredGrowth, FallingFrictionIsADamperAlongTheSlip) {
  for (const double excess : {0.0, 0.05, 0.2}) {
    const OneMode one(excess);
    EXPECT_NEAR(one.rub.slip, 0.06, 1e-12);
    const double m = one.system.mass[0], half = 0.5 * one.damping / m;
    const std::vector<Complex> found = rub_eigenvalues(one.system, one.rub);
    ASSERT_EQ(found.size(), 2U);
    for (const Complex& s : found) {
      EXPECT_NEAR(s.real(), -half, 1e-9 * std::abs(s)) << excess;
      EXPECT_NEAR(std::abs(s.imag()), std::sqrt(one.stiffness / m - half * half),
                  1e-9 * std::abs(s));
    }
  }
}

// A hair to both sides of the border, by whole runs.
TEST(MeasuredGrowth, FallingFrictionLeavesTheRubBeyondItsBorder) {
  const double there = border();
  EXPECT_GT(there, 0.01);
  EXPECT_LT(there, 0.5);
  for (const double part : {0.97, 1.03}) {
    const OneMode one(part * there);
    expect_measured({one.scene, 0, 0.05, 2.5e-4, 1e-3}, part < 1.0);
  }
}

// Beyond resonance a second rub stands between the first and the free orbit: it is a watershed.
TEST(MeasuredGrowth, TheWeakerOfTwoRubsIsLeft) {
  scene::Scene s = test::shipped("bench_annular_rigid");
  s.forces[0].frequency = s.rotor.speed = 2.0 * std::numbers::pi * 90.0;
  expect_measured({s, 1, 0.02, 1e-4}, false);
}

}  // namespace
}  // namespace rotorub::rub
