// The eigenvalues of forced rubs against whole runs of `event`: started slightly off a rub, how
// fast does the normal force return to its value, or leave it?
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/linear/driven_rub.h"
#include "native_model/linear/rub_map.h"
#include "native_model/linear/rub_stability.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/rubs.h"
#include "tests/support/refusal.h"
#include "tests/support/whip.h"

namespace rotorub::rub {
namespace {

struct Case {
  scene::Scene scene;
  std::size_t root = 0;              // of the two rubs that may exist, by falling force
  double end = 0.05, step = 2.5e-4;  // s
  double off = 1e-4;                 // of the load
};

// The start is off the rub by the effect of a slightly larger load: in contact, and small enough to
// be linear.
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
  EXPECT_NEAR(t.statistics.contact_time, c.end, 1e-12) << "never lifts off";
  std::vector<double> off = t.column("normal_force");
  for (double& force : off) force -= rub.normal_force;
  ASSERT_GT(test::largest(off), 1e-5 * rub.normal_force) << "it was off";

  const auto count = static_cast<Eigen::Index>(expected.size());
  const std::vector<Complex> measured = test::exponents(off, c.step, count);
  // 1 % of the rate, and 0.01 rad/s for the error of the fit of a few periods.
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
// Friction feeds the second bending mode, so the rig of the paper has no steady rub.
TEST(MeasuredGrowth, TheRigsRubGrowsAtItsOwnFriction) { expect_measured({held_rig(0.3)}, false); }

// With one mode on a fixed ring only the rub's angle eps can move, and friction that falls with the
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

// Slightly to both sides of the border, in whole runs.
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

// ---------------------------------------------------------------- turning rings
// Lasting rubs on a ring that turns, as an auxiliary ball bearing does: the speed that friction and
// drag keep it at, sliding or rolling, against whole runs.

scene::Scene turning(const std::string& name, const std::string& drag,
                     std::vector<std::string> further = {}) {
  further.push_back("stator.spin={inertia=1e-3,drag=" + drag + "}");
  return test::shipped(name, further);
}

// The run ends in the rub, to `share` of each figure.
void expect_ends_in(const Trajectory& t, const SteadyRub& rub, double share) {
  const auto near = [&](const char* column, double value, double whole) {
    EXPECT_NEAR(t.column(column).back(), value, share * std::abs(whole)) << column;
  };
  near("normal_force", rub.normal_force, rub.normal_force);
  near("friction_force", -rub.friction * rub.normal_force, rub.normal_force);  // may be 0
  near("ring_speed", rub.ring_speed, rub.ring_speed);
  EXPECT_NEAR(t.column("slip").back(), rub.slip, share * 20.0);
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), rub.whirl, share * std::abs(rub.whirl));
}

struct OnRing {
  const char *scene, *drag;  // N m s
  RubKind kind;
  bool rolls;
};
// Starts with the ring at rest: it is dragged up to where its drag holds it, or up to rolling.
constexpr OnRing kOnRings[] = {{"bench_annular_elastic", "0.015", RubKind::kForced, false},
                               {"bench_annular_elastic", "1e-3", RubKind::kForced, true},
                               {"bench_annular_elastic", "0", RubKind::kForced, true},
                               {"bench_whip", "0.025", RubKind::kWhip, false},
                               {"bench_whip", "0.006", RubKind::kRolling, true}};

TEST(TurningRingRub, IsWhatARunOfVerletSettlesOn) {
  for (const OnRing& c : kOnRings) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.drag);
    const scene::Scene s = turning(c.scene, c.drag, {"run.end=3"});
    const RubSystem system = rub_system(s);
    const RubPoint point = RubStudy(system).at(system.friction);
    const StandingRub* found = point.leading(c.kind);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->stability.stable) << found->stability.growth;
    EXPECT_EQ(found->rub.rolls(), c.rolls);
    expect_ends_in(test::run_with(s, scene::Integrator::kVerlet, 2e-5), found->rub, 1e-4);
  }
}

// [initial] rub: the ring turns from the start, and all stays as it is.
TEST(TurningRingRub, IsAStartThatARunOfEventStaysOn) {
  const char* const words[] = {"synchronous", "whip", "rolling"};
  for (const OnRing& c : kOnRings) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.drag);
    const std::string rub = words[static_cast<int>(c.kind)];
    const scene::Scene s = turning(c.scene, c.drag, {"run.end=0.5", "initial={rub='" + rub + "'}"});
    const RubSystem system = rub_system(s);
    const SteadyRub found = RubStudy(system).at(system.friction).leading(c.kind)->rub;
    const Trajectory t = test::run_event(s);
    EXPECT_NEAR(t.column("ring_speed")[0], found.ring_speed, 1e-12 * std::abs(found.ring_speed));
    expect_ends_in(t, found, 1e-6);
    EXPECT_NEAR(t.statistics.contact_time, 0.5, 1e-12);
  }
  const scene::Scene spun = test::shipped(
      "bench_whip", {"stator.spin={inertia=1e-3,drag=0.025,speed=3}", "initial={rub='whip'}"});
  EXPECT_EQ(test::refusal(spun).key, "stator.spin.speed");
}

// Rolling couples the ring's turning to the whirl: how fast a run comes back.
TEST(TurningRingRub, RollingDecaysAsItsEigenvaluesSay) {
  scene::Scene s = turning("bench_annular_elastic", "1e-3", {"run.end=0.1"});
  constexpr double kStep = 2.5e-4;
  s.run.output_step = kStep;
  const RubSystem system = rub_system(s);
  RotatingLoad load = rotating_loads(system).front();
  const SteadyRub rub = forced_rubs(system, load).front();
  ASSERT_TRUE(rub.rolls());
  const std::vector<Complex> expected = driven_eigenvalues(system, {}, rub);
  ASSERT_EQ(expected.size(), 6U) << "4 of rotor and ring, 2 of the turning";
  load.load *= 1.0 + 1e-4;
  const SteadyRub beside = forced_rubs(system, load).front();
  s.first().stator->spin->speed = beside.ring_speed;
  const Trajectory t = test::run_event(test::started_on(s, beside));
  std::vector<double> off = t.column("normal_force");
  for (double& force : off) force -= rub.normal_force;
  Complex found(1e300, 0.0);
  for (const Complex& e : test::exponents(off, kStep, 6)) {
    if (std::abs(e - expected.front()) < std::abs(found - expected.front())) found = e;
  }
  const Complex first = expected.front();
  EXPECT_NEAR(found.real(), first.real(), 0.01 * std::abs(first.real()) + 0.01);
  EXPECT_NEAR(found.imag(), first.imag(), 1e-3 * std::abs(first.imag()) + 0.01);
}

// Without drag nothing slows the ring: it has no lasting tangential force, and no whip lasts.
TEST(TurningRingRub, WithoutDragNoWhipLasts) {
  const RubSystem free = rub_system(turning("bench_whip", "0"));
  EXPECT_TRUE(RubStudy(free).at(free.friction).rubs.empty());
  const RubSystem forced = rub_system(turning("bench_annular_elastic", "0"));
  const auto rubs = forced_rubs(forced, rotating_loads(forced).front());
  ASSERT_EQ(rubs.size(), 1U);
  EXPECT_EQ(rubs[0].friction, 0.0);
  EXPECT_NEAR(rubs[0].ring_speed, forced.speed, 1e-12 * forced.speed) << "with the shaft";
}

}  // namespace
}  // namespace rotorub::rub
