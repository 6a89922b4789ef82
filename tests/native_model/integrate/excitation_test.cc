// Excitations of a rotor: locked to the spin, swept, a blow, a lost blade. The response of one mode
// is the integral of its response to a blow (Duhamel), here by quadrature of the force as the scene
// states it.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "native_model/model/dynamics.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/jeffcott.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;
using scene::ForceKind;

constexpr double kMass = 2.0, kDamping = 40.0, kStiffness = 2e5;
constexpr double kSpeed = 250.0, kAngle = 0.3;  // rad/s, rad, at t = 0
constexpr double kEnd = 0.1;

scene::Scene oscillator() {
  scene::Scene s = test::make_scene({.mass = kMass,
                                     .damping = kDamping,
                                     .stiffness = kStiffness,
                                     .clearance = 0.1,
                                     .speed = kSpeed});
  s.rotor.modal->inertia = 1e-3;
  s.initial.spin_angle = kAngle;
  s.run.end = kEnd;
  s.run.output_step = 0.01;
  return s;
}

// x + i y at t under `force`, smooth from on to off.
Complex answer(const std::function<Complex(double)>& force, double on, double off, double t) {
  const double delta = 0.5 * kDamping / kMass;
  const double omega = std::sqrt(kStiffness / kMass - delta * delta), end = std::min(t, off);
  if (end <= on) return 0.0;
  constexpr int kPieces = 40000;  // Simpson: to 1e-14 of what turns by 500 rad/s
  const double h = (end - on) / kPieces;
  Complex sum = 0.0;
  for (int k = 0; k <= kPieces; ++k) {
    const double at = on + k * h, rest = t - at;
    const double weight = k == 0 || k == kPieces ? 1.0 : k % 2 ? 4.0 : 2.0;
    sum += weight * std::exp(-delta * rest) * std::sin(omega * rest) * force(at);
  }
  return sum * h / (3.0 * kMass * omega);
}

Trajectory run(const scene::Scene& s, scene::Integrator integrator, double step = 1e-5) {
  Trajectory t = test::run_with(s, integrator, step);
  return t;
}

// `event` to round-off, fixed steps with the square of the step although the force begins within
// one.
void expect_answer(const scene::Scene& s, const std::function<Complex(double)>& force) {
  const scene::Force& f = s.forces.front();
  const double off = f.kind == ForceKind::kUnbalance ? scene::kNever : f.off;
  const auto exact = [&](double t) { return answer(force, f.on, off, t); };
  double size = 0.0;
  for (double t = 0.0; t <= kEnd; t += 0.01) size = std::max(size, std::abs(exact(t)));
  ASSERT_GT(size, 1e-6);
  EXPECT_LT(test::orbit_error(run(s, scene::Integrator::kEvent), exact), 1e-11 * size);
  test::expect_order_of_steps(
      s, {1e-4, 5e-5, 2e-5, 1e-5}, 1.85,
      [&](const Trajectory& t) { return test::orbit_error(t, exact); }, 3e-5 * size);
}

scene::Force force_of(ForceKind kind, double on, double off) {
  scene::Force f;
  f.kind = kind;
  f.amplitude = 30.0;
  f.phase = 0.7;
  f.frequency = 150.0;
  f.frequency_end = -450.0;
  f.static_moment = 4e-4;
  f.vector = {200.0, -120.0};
  f.on = on;
  f.off = off;
  return f;
}

TEST(Excitation, LockedToASpinThatIsHeld) {
  scene::Scene s = oscillator();
  s.forces = {force_of(ForceKind::kSynchronous, 0.0123456, 0.0712345)};
  expect_answer(s, [](double t) { return std::polar(30.0, kAngle + kSpeed * t + 0.7); });
}

// A constant torque: phi is known, and the force, an outer one, does not act on it.
TEST(Excitation, LockedToASpinThatRunsUp) {
  scene::Scene s = oscillator();
  s.drive.emplace();
  s.drive->kind = scene::DriveKind::kTable;
  s.drive->table_speed = {0.0, 1.0};
  s.drive->table_torque = {0.8, 0.8};
  s.forces = {force_of(ForceKind::kSynchronous, 0.0123456, scene::kNever)};
  expect_answer(s, [](double t) {
    return std::polar(30.0, kAngle + kSpeed * t + 0.5 * (0.8 / 1e-3) * t * t + 0.7);
  });
  const Trajectory t = run(s, scene::Integrator::kEvent);
  EXPECT_NEAR(t.column("spin_speed").back(), kSpeed + 0.8 / 1e-3 * kEnd, 1e-11 * kSpeed);
}

// Forward, through 0, backward.
TEST(Excitation, Chirp) {
  scene::Scene s = oscillator();
  s.forces = {force_of(ForceKind::kChirp, 0.0123456, 0.0812345)};
  expect_answer(s, [](double t) {
    const double passed = t - 0.0123456, rate = (-450.0 - 150.0) / (0.0812345 - 0.0123456);
    return std::polar(30.0, 0.7 + 150.0 * passed + 0.5 * rate * passed * passed);
  });
}

TEST(Excitation, Pulse) {
  scene::Scene s = oscillator();
  s.forces = {force_of(ForceKind::kPulse, 0.0123456, 0.0223456)};
  expect_answer(s, [](double t) {
    return std::sin(std::numbers::pi * (t - 0.0123456) / 0.01) * Complex(200.0, -120.0);
  });
}

// Shorter than any step: its momentum is all that is left of it.
TEST(Excitation, APulseWithinAStepHasItsMomentum) {
  scene::Scene s = oscillator();
  s.forces = {force_of(ForceKind::kPulse, 0.0123456, 0.0123456 + 1e-6)};
  s.forces[0].vector *= 1e4;
  const double momentum = 2.0 / std::numbers::pi * 1e-6 * 2e6;
  scene::Scene brief = s;
  brief.run.end = 0.0125;
  const Trajectory t = run(brief, scene::Integrator::kVerlet, 1e-4);
  EXPECT_NEAR(t.column("rotor_vx").back(), momentum / kMass, 0.03 * momentum / kMass);
}

TEST(Excitation, LostBladeAtAHeldSpeed) {
  scene::Scene s = oscillator();
  s.forces = {force_of(ForceKind::kUnbalance, 0.0123456, scene::kNever)};
  expect_answer(
      s, [](double t) { return std::polar(4e-4 * kSpeed * kSpeed, kAngle + kSpeed * t + 0.7); });
}

// ---------------------------------------------------------------- a lost blade with a free spin
// Coupled so tightly that (m e)^2 / m is 4 % of the spin's inertia.
scene::Scene free_rotor(double on) {
  scene::Scene s =
      test::make_scene({.mass = kMass, .stiffness = kStiffness, .clearance = 0.1, .speed = kSpeed});
  s.rotor.modal->inertia = 1e-3;
  s.drive.emplace();
  s.initial.x = {1e-3};
  s.initial.vx = {0.4};
  s.initial.vy = {-0.3};
  s.initial.spin_angle = kAngle;
  s.run.end = kEnd;
  s.run.output_step = 1e-3;
  scene::Force blade = force_of(ForceKind::kUnbalance, on, scene::kNever);
  blade.static_moment = 9e-3;
  s.forces = {blade};
  return s;
}

struct Constants {
  double energy, momentum;
};

// J Omega + m (x y' - y x') + m e (x cos a + y sin a) Omega + m e (-sin a x' ... ): the moment
// about the axis of all that moves, written from the place of the centre of mass.
Constants constants(const Trajectory& t, std::size_t k, bool lost) {
  const double x = t.column("rotor_x")[k], y = t.column("rotor_y")[k];
  const double vx = t.column("rotor_vx")[k], vy = t.column("rotor_vy")[k];
  const double spin = t.column("spin_speed")[k], a = t.column("spin_angle")[k] + 0.7;
  const double u = lost ? 9e-3 : 0.0, c = u * std::cos(a), s = u * std::sin(a);
  const double energy = 0.5 * kMass * (vx * vx + vy * vy) + 0.5 * 1e-3 * spin * spin +
                        spin * (c * vy - s * vx) + 0.5 * kStiffness * (x * x + y * y);
  const double momentum =
      1e-3 * spin + kMass * (x * vy - y * vx) + (c * vy - s * vx) + spin * (x * c + y * s);
  return {energy, momentum};
}

// No external loads act before and after, so energy and angular momentum are constant. No velocity
// jumps.
TEST(LostBlade, KeepsEnergyAndMomentumBeforeAndAfter) {
  constexpr double kOn = 0.0123456;
  scene::Scene s = free_rotor(kOn);
  s.run.output_times = {std::nextafter(kOn, 0.0), kOn};
  const Trajectory t = run(s, scene::Integrator::kEvent);
  const auto& time = t.column("t");
  std::size_t on = 0;
  while (time[on] < kOn) ++on;
  const Constants before = constants(t, 0, false), after = constants(t, on, true);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const Constants now = constants(t, k, k >= on), same = k >= on ? after : before;
    EXPECT_NEAR(now.energy, same.energy, 1e-11 * same.energy) << time[k];
    EXPECT_NEAR(now.momentum, same.momentum, 1e-11 * same.momentum) << time[k];
  }
  for (const char* name : {"rotor_x", "rotor_vx", "rotor_vy", "spin_speed"}) {
    EXPECT_NEAR(t.column(name)[on], t.column(name)[on - 1],
                1e-11 * std::abs(t.column(name)[on]) + 1e-15);
  }
  // Then the load does much work: the spin gives energy to bending and takes it back.
  double low = kSpeed, high = kSpeed;
  for (const double speed : t.column("spin_speed")) {
    low = std::min(low, speed);
    high = std::max(high, speed);
  }
  EXPECT_GT(high - low, 0.02 * kSpeed);
  EXPECT_GT(std::abs(after.energy - before.energy), 1e-3 * before.energy);
  EXPECT_LT(t.statistics.energy_residual(), 1e-11) << "what went with the blade is in the balance";
}

// In the step of the loss the mass matrix is between the two.
TEST(LostBlade, FixedStepsConverge) {
  const scene::Scene s = free_rotor(0.0123456);
  const Trajectory exact = run(s, scene::Integrator::kEvent);
  test::expect_order_of_steps(s, {1e-4, 5e-5, 2e-5, 1e-5}, 1.85, [&](const Trajectory& t) {
    EXPECT_LT(t.statistics.energy_residual(), 300.0 * t.step);
    return test::trajectory_error(t, exact, 0.02);
  });
}

// `event` follows each turn: if that would take days, the force is refused beforehand.
TEST(Excitation, MoreTurnsThanCanBeFollowedAreRefused) {
  scene::Scene s = oscillator();
  s.forces.resize(2);
  s.forces[0].kind = ForceKind::kConstant;
  s.forces[1].kind = ForceKind::kRotating;
  s.forces[1].frequency = -1e17;
  EXPECT_TRUE(test::contains(
      test::message_of<scene::SceneError>([&] { run(s, scene::Integrator::kEvent); }),
      {"force[1].frequency", "turns"}));
  run(s, scene::Integrator::kVerlet);
}

}  // namespace
}  // namespace rotorub
