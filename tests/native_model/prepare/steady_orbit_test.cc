// [initial] steady: a start on the orbit that repeats, against closed forms of one mode.
#include "native_model/linear/steady_orbit.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "native_model/bearing/actuator.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/run/run_native.h"
#include "tests/native_model/prepare/steady_scenes.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::magnetic_ring;
using test::steady;
using Complex = std::complex<double>;

// x + i y and its rate, of the first mode.
Complex place(const Model& m) { return {m.q0[0], m.q0[m.layout.modes]}; }
Complex rate(const Model& m) { return {m.v0[0], m.v0[m.layout.modes]}; }

void expect_near(Complex a, Complex b, double error) {
  EXPECT_NEAR(a.real(), b.real(), error);
  EXPECT_NEAR(a.imag(), b.imag(), error);
}

// m e Omega^2 e^{i (phi_0 + phase)} / (k - m Omega^2 + i d Omega), below and beyond the resonance.
TEST(SteadyOrbit, IsJeffcottsUnderUnbalance) {
  for (const double speed : {100.0, 300.0, 316.0, 700.0, -250.0}) {
    scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = speed});
    s.initial.spin_angle = 0.3;
    scene::Force blade;
    blade.kind = scene::ForceKind::kUnbalance;
    blade.static_moment = 4e-5;
    blade.phase = 0.8;
    s.forces = {blade};
    const Model m = prepare(s);
    const Complex exact =
        std::polar(4e-5 * speed * speed, 1.1) / Complex(2e5 - 2.0 * speed * speed, 40.0 * speed);
    expect_near(place(m), exact, 1e-15 * 0.5e-3);
    expect_near(rate(m), Complex(0.0, speed) * exact, 1e-15 * 0.2);
  }
}

// The analysis predicts the smallest gap that a run reaches with each integrator, over the steps as
// a whole.
TEST(SteadyOrbit, TheLeastGapIsThatOfTheRun) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = 250.0});
  s.run.end = 0.1;
  s.run.output_step = 1e-4;
  scene::Force blade;
  blade.kind = scene::ForceKind::kUnbalance;
  blade.static_moment = 4e-5;
  s.forces = {blade};
  s.first().contact = scene::Contact{.radius = 0.02, .clearance = 0.5e-3, .offset = {1e-5, 0.0}};
  const Model model = prepare(s);
  const FreeOrbit orbit = free_response(s, model, 250.0).orbits.front();
  ASSERT_TRUE(orbit.largest);
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const double gap = test::run_with(s, integrator, 1e-6).statistics.least_gap;
    // Between two rows of a run by `event`, whose steps are a radian or so, the rotor comes nearer
    // by orbit (nu dt)^2 / 8 at most.
    EXPECT_GT(gap, 0.5e-3 - *orbit.largest - 1e-10);
    EXPECT_LT(gap,
              0.5e-3 - *orbit.largest + *orbit.largest * std::pow(250.0 * 1e-4, 2) / 8.0 + 1e-10);
  }
}

// A force that begins later counts with its full value, and two that follow each other are never
// added.
TEST(SteadyOrbit, TheResponseKnowsWhatComesOnLater) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = 250.0});
  s.initial = {};
  scene::Force turning;
  turning.kind = scene::ForceKind::kRotating;
  turning.frequency = 200.0;
  turning.amplitude = 30.0;
  turning.on = 0.1;
  turning.ramp = 0.02;
  turning.off = 0.3;
  scene::Force after = turning;
  after.amplitude = 20.0;
  after.on = 0.3;
  after.off = scene::kNever;
  s.forces = {turning, after};
  const double exact = 30.0 / std::abs(Complex(2e5 - 2.0 * 200.0 * 200.0, 40.0 * 200.0));
  const FreeOrbit orbit = free_response(s, prepare(s), 250.0).orbits.front();
  ASSERT_TRUE(orbit.largest) << orbit.refused;
  EXPECT_NEAR(*orbit.largest, exact, 1e-9 * exact);
}

// The response at other speeds, to round-off; the ring hangs beside the middle under its weight.
TEST(SteadyOrbit, AtAnotherSpeed) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = 100.0});
  scene::Force blade;
  blade.kind = scene::ForceKind::kUnbalance;
  blade.static_moment = 4e-5;
  scene::Force turning;
  turning.kind = scene::ForceKind::kSynchronous;
  turning.amplitude = 3.0;
  turning.phase = 1.0;
  s.forces = {blade, turning};
  s.initial = {};
  const Model model = prepare(s);
  for (const double speed : {100.0, -250.0, 316.0, 700.0}) {
    const Complex load = 4e-5 * speed * speed + 3.0 * std::polar(1.0, 1.0);
    const double exact = std::abs(load / Complex(2e5 - 2.0 * speed * speed, 40.0 * speed));
    const FreeOrbit orbit = free_response(s, model, speed).orbits.front();
    ASSERT_TRUE(orbit.largest) << orbit.refused;
    EXPECT_NEAR(*orbit.largest, exact, 1e-6 * exact) << speed;
  }
  scene::Scene unstable = s;
  unstable.rotor.modal->internal_damping = {200.0};
  const FreeOrbit none = free_response(unstable, prepare(unstable), 2000.0).orbits.front();
  EXPECT_FALSE(none.largest);
  EXPECT_NE(none.refused.find("unstable"), std::string::npos) << none.refused;
  EXPECT_EQ(none.refused.find(';'), std::string::npos);
}

// One round mode with everything round: D(nu) = k + nu Omega g - m nu^2 + i nu d + i (nu - Omega)
// d_i, and the magnetic bearing's -k_m.
TEST(SteadyOrbit, OfARoundRotorAtAnyFrequency) {
  const double speed = 500.0;
  for (const double nu : {500.0, -500.0, 120.0, -77.0}) {
    scene::Scene s = steady({.mass = 2.0, .damping = 60.0, .stiffness = 3e5, .speed = speed});
    s.rotor.modal->gyroscopic = {0.4};
    s.rotor.modal->internal_damping = {25.0};
    s.magnetic_bearings = {scene::MagneticBearing{0.0, {}, 4e4}};
    test::add_rotating_force(s, 30.0, nu, 0.7);
    const Model m = prepare(s);
    const Complex d(2.6e5 + nu * speed * 0.4 - 2.0 * nu * nu, nu * 60.0 + (nu - speed) * 25.0);
    const Complex exact = std::polar(30.0, 0.7) / d;
    expect_near(place(m), exact, 1e-14 * std::abs(exact));
    expect_near(rate(m), Complex(0.0, nu) * exact, 1e-14 * std::abs(nu * exact));
  }
}

TEST(SteadyOrbit, StaticLoadsAndWhatDoesNotActYet) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  s.gravity = scene::Gravity{{0.0, -9.81}, {}};
  test::add_constant_force(s, {20.0, 0.0});
  test::add_constant_force(s, {900.0, 0.0});
  s.forces[1].on = 1e-9;
  test::add_constant_force(s, {900.0, 0.0});
  s.forces[2].ramp = 0.1;  // begins to rise at 0
  test::add_constant_force(s, {900.0, 0.0});
  s.forces[3].on = -2.0;
  s.forces[3].off = 0.0;
  test::add_constant_force(s, {0.0, 10.0});
  s.forces[4].on = -0.2;
  s.forces[4].ramp = 0.2;  // has risen
  const Model m = prepare(s);
  expect_near(place(m), {20.0 / 2e5, (10.0 - 2.0 * 9.81) / 2e5}, 1e-18);
  EXPECT_EQ(rate(m), Complex());
}

// The bias pulls where the weight has brought the ring: F(s, 0) is not linear there.
TEST(SteadyOrbit, RingBetweenItsMagnetsIsAtRest) {
  scene::Scene s = magnetic_ring();
  s.first().stator->stiffness *= 100.0;
  s.gravity = scene::Gravity{{20.0, -98.1}, {}};
  const Model m = prepare(s);
  const int ring = m.layout.ring();
  Eigen::VectorXd f(m.nq());
  smooth_force(m, 0.0, m.q0.data(), m.v0.data(), {0.0, 0.0}, f.data());
  EXPECT_NEAR(f[ring], 0.0, 1e-12 * 150.0);
  EXPECT_NEAR(f[ring + 1], 0.0, 1e-12 * 150.0);
  const double linear = 20.0 / s.first().stator->stiffness.x();
  EXPECT_GT(std::abs(m.q0[ring] - linear), 0.01 * linear) << "the magnets count";
}

// T(Omega) winds the free-free shaft: none of its modes accelerates.
TEST(SteadyOrbit, TorsionAtRestUnderTheMotorsTorque) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = 300.0});
  s.rotor.modal->inertia = 1e-3;
  s.rotor.torsion = scene::Torsion{0, 0.0, {4e-4, 1e-4}, {60.0, 90.0}, {0.01, 0.02}, {0.3, -0.5}};
  s.drive.emplace();
  s.drive->kind = scene::DriveKind::kLinear;
  s.drive->gain = 0.05;
  s.drive->speed = 330.0;
  const Model m = prepare(s);
  Eigen::VectorXd f(m.nq());
  smooth_force(m, 0.0, m.q0.data(), m.v0.data(), {0.0, 0.0}, f.data());
  EXPECT_NEAR(m.q0[m.layout.theta()], 0.05 * 30.0 * 0.3 / 60.0, 1e-17);
  EXPECT_NEAR(f[m.layout.theta()], 0.0, 1e-15);
  EXPECT_NEAR(f[m.layout.theta() + 1], 0.0, 1e-15);
  EXPECT_EQ(m.v0[m.layout.phi()], 300.0);
  s.initial.torsion = {1e-3, 0.0};
  EXPECT_EQ(prepare(s).q0[m.layout.theta()], 1e-3) << "a torsion that is given stays";
}

// A chirp counts with its frequency of t = 0; a pulse begins at 0.
TEST(SteadyOrbit, ChirpAndPulse) {
  scene::Scene s = steady({.mass = 2.0, .damping = 40.0, .stiffness = 2e5});
  scene::Force f;
  f.kind = scene::ForceKind::kChirp;
  f.amplitude = 10.0;
  f.frequency = 100.0;
  f.frequency_end = 300.0;
  f.on = -1.0;
  f.off = 3.0;
  f.phase = 0.4;
  scene::Force g;
  g.kind = scene::ForceKind::kPulse;
  g.vector = {500.0, 0.0};
  g.off = 0.01;
  s.forces = {f, g};
  const Model m = prepare(s);
  // After a quarter of 4 s: 150 rad/s, turned by 125 rad.
  const Complex exact =
      std::polar(10.0, 0.4 + 125.0) / Complex(2e5 - 2.0 * 150.0 * 150.0, 40.0 * 150.0);
  expect_near(place(m), exact, 1e-13 * std::abs(exact));
}

}  // namespace
}  // namespace rotorub
