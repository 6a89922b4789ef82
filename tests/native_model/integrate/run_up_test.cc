// A run-up through the first critical speed: unbalance takes from the motor what damping takes from
// the orbit. A strong motor passes; a weak one hangs below the resonance (Sommerfeld), where its
// torque is that of the steady orbit, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kRotorMass = 2.0, kRotorStiffness = 2e5,
                 kRotorDamping = 64.0;  // resonance at 316 rad/s, 5 %
constexpr double kMoment = 6e-4;        // kg m
constexpr double kRunUpInertia = 2e-3, kRunUpTarget = 450.0, kRunUpStart = 250.0;

scene::Scene machine(double gain) {
  scene::Scene s = test::make_scene({.mass = kRotorMass,
                                     .damping = kRotorDamping,
                                     .stiffness = kRotorStiffness,
                                     .clearance = 0.1,
                                     .speed = kRunUpStart});
  s.rotor.modal->inertia = kRunUpInertia;
  s.drive.emplace();
  s.drive->kind = scene::DriveKind::kLinear;
  s.drive->gain = gain;
  s.drive->speed = kRunUpTarget;
  scene::Force unbalance;
  unbalance.kind = scene::ForceKind::kUnbalance;
  unbalance.static_moment = kMoment;
  s.forces = {unbalance};
  s.initial.steady = true;
  s.run.end = 8.0;
  s.run.output_step = 0.05;
  return s;
}

// N m: d |r|^2 Omega, what the orbit at a held speed takes.
double taken(double speed) {
  const double r = kMoment * speed * speed /
                   std::abs(std::complex<double>(kRotorStiffness - kRotorMass * speed * speed,
                                                 kRotorDamping * speed));
  return kRotorDamping * r * r * speed;
}

// Where gain (target - speed) meets that first.
double hanging(double gain) {
  double low = kRunUpStart, high = std::sqrt(kRotorStiffness / kRotorMass);
  EXPECT_GT(gain * (kRunUpTarget - low), taken(low));
  EXPECT_LT(gain * (kRunUpTarget - high), taken(high));
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (gain * (kRunUpTarget - middle) > taken(middle) ? low : high) = middle;
  }
  return low;
}

Trajectory run_up(const scene::Scene& s, scene::Integrator integrator) {
  Trajectory t = test::run_with(s, integrator, 2e-4);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  return t;
}

TEST(RunUp, AWeakMotorHangsBelowTheResonance) {
  constexpr double kGain = 1e-3;
  const double speed = hanging(kGain);
  EXPECT_LT(speed, 316.0);
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_up(machine(kGain), integrator);
    EXPECT_NEAR(t.column("spin_speed").back(), speed, 1e-3 * speed);
    EXPECT_NEAR(t.column("motor_torque").back(), taken(speed), 2e-3 * taken(speed));
    const double r = std::hypot(t.column("rotor_x").back(), t.column("rotor_y").back());
    EXPECT_NEAR(kRotorDamping * r * r * speed, taken(speed), 1e-2 * taken(speed));
  }
}

TEST(RunUp, AStrongMotorPasses) {
  const Trajectory t = run_up(machine(5e-3), scene::Integrator::kEvent);
  const double end = t.column("spin_speed").back();
  EXPECT_NEAR(5e-3 * (kRunUpTarget - end), taken(end), 1e-2 * taken(end));
  EXPECT_GT(end, 420.0);
  double largest = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    largest = std::max(largest, std::hypot(t.column("rotor_x")[k], t.column("rotor_y")[k]));
  }
  EXPECT_GT(largest, 1.5 * std::hypot(t.column("rotor_x").back(), t.column("rotor_y").back()))
      << "it was wide at the resonance, and is about m e / m beyond";
}

}  // namespace
}  // namespace rotorub
