// A ring that turns, [stator.spin], by whole runs against exact answers: momentum, closed forms of
// the spin-up, and the effect on a whip.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "native_model/oracles/annular_rub.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/turning_ring.h"
#include "tests/support/whip.h"

namespace rotorub {
namespace {

using test::run_with;

using scene::Integrator;

// All numbers differ.
constexpr double kRadius = 0.05, kClearance = 0.5e-3;           // m
constexpr double kBore = kRadius + kClearance;                  // m, R
constexpr double kSpinInertia = 1.3e-3, kRingInertia = 4.1e-4;  // kg m^2

// A rotor with a free spin thrown at a ring that turns; no damper and no load: nothing has a moment
// about the bearings' axis but what rotor and ring do to each other.
scene::Scene thrown() {
  scene::Scene s = test::make_scene({.mass = 2.0,
                                     .stiffness = 2e5,
                                     .clearance = kClearance,
                                     .radius = kRadius,
                                     .friction = 0.3,
                                     .restitution = 0.4,
                                     .speed = 200.0});
  s.rotor.modal->inertia = kSpinInertia;
  s.drive.emplace().kind = scene::DriveKind::kFree;
  test::add_ring(s, 1.1, 0.0, 1.5e5);
  s.first().stator->spin = scene::RingSpin{kRingInertia, 0.0, -15.0};
  s.initial.x = {0.2e-3};
  s.initial.y = {-0.1e-3};
  s.initial.vx = {0.6};
  s.initial.vy = {0.3};
  s.run.end = 0.1;
  s.run.output_step = 1e-3;
  return s;
}

// About the bearings' axis: orbits of both centres, both spins.
double angular_momentum(const Trajectory& t, std::size_t k, double rotor, double ring) {
  const auto orbit = [&](const std::string& body, double mass) {
    const auto of = [&](const char* what) { return t.column(body + what)[k]; };
    return mass * (of("_x") * of("_vy") - of("_y") * of("_vx"));
  };
  return orbit("rotor", rotor) + orbit("stator", ring) + kSpinInertia * t.column("spin_speed")[k] +
         kRingInertia * t.column("ring_speed")[k];
}

TEST(TurningRing, AngularMomentumIsKeptThroughImpactsAndRubs) {
  scene::Scene s = thrown();
  const Trajectory event = test::sound_event(s);
  ASSERT_GT(event.impacts.size(), 5u);
  ASSERT_GT(event.statistics.contact_time, 1e-3) << "and rubs";
  const double start = angular_momentum(event, 0, 2.0, 1.1);
  for (std::size_t k = 0; k < event.rows(); ++k) {
    ASSERT_NEAR(angular_momentum(event, k, 2.0, 1.1), start, 1e-11 * std::abs(start)) << k;
  }
}

// With a free spin friction turns the two against each other alone, whatever the bending does.
TEST(TurningRing, BothSpinsKeepTheirSum) {
  for (const Integrator integrator :
       {Integrator::kEvent, Integrator::kVerlet, Integrator::kEuler}) {
    const Trajectory t = run_with(thrown(), integrator);
    const auto &spin = t.column("spin_speed"), &ring = t.column("ring_speed");
    const auto sum = [&](std::size_t k) {
      return kBore * kSpinInertia * spin[k] + kRadius * kRingInertia * ring[k];
    };
    EXPECT_GT(std::abs(ring.back() - ring.front()), 10.0);
    for (std::size_t k = 0; k < t.rows(); ++k) ASSERT_NEAR(sum(k), sum(0), 1e-12 * sum(0)) << k;
  }
}

// A constant load presses the rotor on the ring: it ends in rolling, with a known surface speed.
TEST(TurningRing, ADeadLoadEndsInRolling) {
  scene::Scene s = thrown();
  test::add_constant_force(s, {-40.0, -300.0});
  s.rotor.modal->damping = {400.0};
  s.first().stator->damping = {300.0, 300.0};
  s.first().contact->restitution = 0.0;
  s.run.end = 1.5;
  const oracle::TurningRing ring{kRingInertia, 0.0, kBore};
  const double exact = oracle::rolling_surface_speed({kSpinInertia, kRadius, 200.0}, ring, -15.0);
  for (const Integrator integrator : {Integrator::kEvent, Integrator::kVerlet}) {
    const Trajectory t = run_with(s, integrator);
    EXPECT_EQ(t.column("mode").back(), static_cast<double>(ContactMode::kStick));
    EXPECT_NEAR(kRadius * t.column("spin_speed").back(), exact, 1e-9 * exact);
    EXPECT_NEAR(kBore * t.column("ring_speed").back(), exact, 1e-9 * exact);
  }
}

// ---------------------------------------------------------------- spin-up
// The steady rub of bench_annular_elastic, in which N is constant, on a ring that turns.
struct Rub {
  scene::Scene scene;
  double force;  // N
};
Rub annular(const scene::RingSpin& spin) {
  Rub rub{test::shipped("bench_annular_elastic"), 0.0};
  scene::Scene& s = rub.scene;
  s.first().stator->spin = spin;
  s.run.end = 0.2;
  s.run.output_step = 1e-3;
  const scene::RotorModal& m = *s.rotor.modal;
  const auto exact = oracle::annular_rub(
      {m.mass[0], m.damping[0], m.stiffness[0]},
      {s.first().stator->mass.x(), s.first().stator->damping.x(), s.first().stator->stiffness.x()},
      s.first().contact->clearance, s.first().contact->friction.coefficient, s.forces[0].amplitude,
      s.forces[0].frequency);
  rub.force = exact.value().force;
  return rub;
}

double bore(const scene::Scene& s) {
  return s.first().contact->radius + s.first().contact->clearance;
}

// Drag holds the ring well below rolling.
TEST(TurningRing, ARubUnderAConstantForceSpinsItUpAsTheClosedFormSays) {
  scene::RingSpin spin{1e-3, 0.0, 3.0};
  const Rub first = annular(spin);
  const double torque =
      first.scene.first().contact->friction.coefficient * first.force * bore(first.scene);
  spin.drag = torque / 60.0;  // ends near 60 rad/s
  const Rub rub = annular(spin);
  const oracle::TurningRing ring{spin.inertia, spin.drag, bore(rub.scene)};
  const auto miss = [&](const Trajectory& t) {
    EXPECT_GT(t.column("ring_speed").back(), 50.0);
    double most = 0.0;  // of the final speed
    for (std::size_t k = 0; k < t.rows(); ++k) {
      const double exact = oracle::ring_speed(ring, torque, 3.0, t.column("t")[k]);
      most = std::max(most, std::abs(t.column("ring_speed")[k] - exact) / 60.0);
    }
    return most;
  };
  const Trajectory event = test::run_event(rub.scene);
  EXPECT_LT(miss(event), 1e-9);
  test::expect_sound_event(rub.scene, event);
  // The ratio of the errors at two steps shows second and first order.
  const auto ratio = [&](Integrator integrator) {
    return miss(run_with(rub.scene, integrator, 1e-4)) /
           miss(run_with(rub.scene, integrator, 1e-5));
  };
  EXPECT_GT(ratio(Integrator::kVerlet), 80.0);
  EXPECT_GT(ratio(Integrator::kEuler), 8.0);
}

// Without drag the speed grows evenly until the surfaces roll, at a known time.
TEST(TurningRing, WithoutDragRollingBeginsWhenTheClosedFormSays) {
  const scene::RingSpin spin{5e-4, 0.0, 0.0};
  const Rub rub = annular(spin);
  const scene::Scene& s = rub.scene;
  const double torque = s.first().contact->friction.coefficient * rub.force * bore(s);
  const double slip = s.first().contact->radius * s.rotor.speed +
                      s.first().contact->clearance * s.forces[0].frequency;
  const double exact = slip / bore(s) * spin.inertia / torque;
  ASSERT_LT(exact, s.run.end);
  const Trajectory t = test::run_event(s);
  const auto rolls = std::find_if(t.events.begin(), t.events.end(),
                                  [](const Event& e) { return e.kind == EventKind::kStick; });
  ASSERT_NE(rolls, t.events.end());
  EXPECT_NEAR(rolls->t, exact, 1e-9 * exact);
}

// ---------------------------------------------------------------- whip
// Friction drives a whip; a ring that turns with it removes the friction.
TEST(TurningRing, TheWhipDiesOnAFreeRing) {
  scene::Scene s = test::shipped("bench_whip");
  s.first().stator->spin = scene::RingSpin{7e-4, 1e-3, 0.0};
  const Trajectory t = test::sound_event(s);
  EXPECT_EQ(t.column("normal_force").back(), 0.0);
  const std::size_t end = t.rows() - 1;
  EXPECT_LT(std::hypot(t.column("rotor_x")[end], t.column("rotor_y")[end]), 1e-5);
  EXPECT_GT(*std::max_element(t.column("ring_speed").begin(), t.column("ring_speed").end()), 200.0);
}

}  // namespace
}  // namespace rotorub
