// A run-up through the first critical speed: unbalance takes from the motor what damping takes from
// the orbit. A strong motor passes; a weak one hangs below the resonance (Sommerfeld), where its
// torque is that of the steady orbit, in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/stepping/step_limit.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::run_with;

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

// The intersection with gain (target - speed).
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

// Sommerfeld's effect on a rigid rotor from rest under a constant torque, with the figures of
// Exudyn's model (github.com/jgerstmayr/EXUDYN): below a watershed the resonance at 28.28 rad/s
// catches the rotor for ever.
scene::Scene driven_by(double torque, double end) {
  scene::Scene s =
      test::make_scene({.mass = 2.0, .damping = 0.45254834, .stiffness = 1600.0, .clearance = 1.0});
  s.rotor.modal->inertia = 0.5625;
  s.drive.emplace();
  s.drive->kind = scene::DriveKind::kTable;
  s.drive->table_speed = {0.0, 1000.0};
  s.drive->table_torque = {torque, torque};
  scene::Force unbalance;
  unbalance.kind = scene::ForceKind::kUnbalance;
  unbalance.static_moment = 2.0 * 1.48e-3;
  s.forces = {unbalance};
  s.run.end = end;
  s.run.output_step = 0.5;
  return s;
}

TEST(RunUp, AConstantTorqueIsCaughtBelowItsWatershed) {
  const auto speed_at = [](double torque, double end) {
    return run_up(driven_by(torque, end), scene::Integrator::kEvent).column("spin_speed").back();
  };
  EXPECT_NEAR(speed_at(0.1, 200.0), 28.088, 1e-3);
  EXPECT_NEAR(speed_at(0.19, 200.0), 28.256, 1e-3);
  EXPECT_NEAR(speed_at(0.2, 200.0), 68.471, 1e-3);
  EXPECT_LT(speed_at(0.19711, 150.0), 30.0);
  EXPECT_GT(speed_at(0.19713, 150.0), 40.0);
}

// ---------------------------------------------------------------- a motor's curve
// The asynchronous motor on its torque-speed curve (the paper's Fig. 6): run_up_kloss from
// standstill over the breakdown torque to its synchronous speed, then with a rub as its load.

// N m, the textbook's curve.
double kloss(const scene::Drive& d, double speed) {
  const double slip = 1.0 - speed / d.synchronous_speed;
  return 2.0 * d.breakdown_torque / (slip / d.breakdown_slip + d.breakdown_slip / slip);
}

TEST(MotorCurve, TheRunLiesOnItFromStandstillToItsLoad) {
  const scene::Scene s = test::shipped("run_up_kloss");
  const scene::Drive& motor = *s.drive;
  const Model model = prepare(s);
  const Trajectory t = test::run_with(s, scene::Integrator::kVerlet, 2e-5);
  const std::vector<double> time = t.column("t"), spin = t.column("spin_speed"),
                            torque = t.column("motor_torque"), twist = t.column("torsion_speed_1");

  // Every row has the speed of the motor's station.
  for (std::size_t k = 0; k < spin.size(); ++k) {
    const double speed = spin[k] + model.drive_shape[0] * twist[k];
    EXPECT_NEAR(torque[k], kloss(motor, speed), 1e-12 * motor.breakdown_torque) << time[k];
  }

  // The path along the curve: the starting torque, up to the maximum, down to 0 at synchronous
  // speed.
  const auto touch = static_cast<std::size_t>(
      std::upper_bound(time.begin(), time.end(), t.statistics.first_touch) - time.begin());
  const auto most = std::max_element(torque.begin(), torque.end());
  const double sb = motor.breakdown_slip;
  EXPECT_DOUBLE_EQ(torque.front(), 2.0 * motor.breakdown_torque * sb / (1.0 + sb * sb));
  EXPECT_NEAR(*most, motor.breakdown_torque, 1e-3 * motor.breakdown_torque);
  EXPECT_NEAR(spin[static_cast<std::size_t>(most - torque.begin())],
              (1.0 - sb) * motor.synchronous_speed, 0.01 * motor.synchronous_speed);
  EXPECT_LT(torque[touch - 1], 1e-3) << "no load yet";

  // The rub is the load: the motor's torque balances friction and the loss of spin; unbalance takes
  // a hundredth.
  double given = 0.0;
  for (std::size_t k = touch; k < time.size(); ++k) {
    given += 0.5 * (torque[k] + torque[k - 1]) * (time[k] - time[k - 1]);
  }
  const double taken = -s.first().contact->radius * t.statistics.friction_impulse;
  const double lost = model.mass[model.layout.phi()] * (spin[touch - 1] - spin.back());
  EXPECT_NEAR(given + lost, taken, 0.02 * taken);
  EXPECT_GT(spin.back(), (1.0 - sb) * motor.synchronous_speed) << "on the stable branch";
  EXPECT_GT(torque.back(), 0.2);
}

// ---------------------------------------------------------------- speed control
// A motor under speed control: with a rigid rotor its loop is linear within the limit, and its
// answer to the ramp of the reference is known.

constexpr double kInertia = 1e-2, kGain = 0.5, kIntegral = 20.0, kStart = 100.0, kTarget = 300.0;
constexpr double kAcceleration = 1000.0, kRampEnd = 0.2;

scene::Scene motor() {
  scene::Scene s =
      test::make_scene({.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .speed = kStart});
  s.rotor.modal->inertia = kInertia;
  s.initial.spin_angle = 0.7;
  s.drive.emplace();
  s.drive->kind = scene::DriveKind::kSpeedControlled;
  s.drive->gain = kGain;
  s.drive->integral_gain = kIntegral;
  s.drive->speed = kTarget;
  s.drive->acceleration = kAcceleration;
  s.run.end = 0.5;
  s.run.output_step = 0.01;
  return s;
}

// Lag e = a_ref - a of the angle: J e'' + k e' + k_i e = J ref', from rest; the answer to a step of
// ref'.
double lag(double t) {
  const double delta = 0.5 * kGain / kInertia;
  const std::complex<double> omega =
      std::sqrt(std::complex<double>(kIntegral / kInertia - delta * delta));
  const auto step = [&](double s) {
    if (s <= 0.0) return 0.0;
    const std::complex<double> decay =
        std::exp(-delta * s) * (std::cos(omega * s) + delta * std::sin(omega * s) / omega);
    return kInertia * kAcceleration / kIntegral * (1.0 - decay.real());
  };
  return step(t) - step(t - kRampEnd);
}

double reference_angle(double t) {
  const double risen = std::min(t, kRampEnd);
  return kStart * risen + 0.5 * kAcceleration * risen * risen + kTarget * (t - risen);
}

double error(const Trajectory& t) {
  double most = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double time = t.column("t")[k];
    most = std::max(most,
                    std::abs(t.column("spin_angle")[k] - 0.7 - reference_angle(time) + lag(time)));
  }
  return most;
}

TEST(SpeedControl, IsALinearLoopWithinItsLimit) {
  ASSERT_GT(lag(kRampEnd), 0.4) << "it lags by more than what is asked of the angles below";
  EXPECT_LT(error(run_with(motor(), scene::Integrator::kEvent)), 1e-10);
  const double coarse = error(run_with(motor(), scene::Integrator::kVerlet, 1e-3));
  const double fine = error(run_with(motor(), scene::Integrator::kVerlet, 2e-4));
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, coarse / 20.0);
}

// The torque's column is what turns the rotor: J Omega' of the closed form, J ref' - J e''.
TEST(SpeedControl, TorqueIsAColumn) {
  const Trajectory t = run_with(motor(), scene::Integrator::kEvent);
  const std::vector<double>&speed = t.column("spin_speed"), &torque = t.column("motor_torque");
  const double h = 1e-5;
  for (std::size_t k = 1; k < t.rows(); ++k) {
    const double time = t.column("t")[k], rate = (lag(time + h) - lag(time - h)) / (2.0 * h);
    if (std::abs(time - kRampEnd) < 2.0 * h) continue;  // a kink
    const double reference = time < kRampEnd ? kStart + kAcceleration * time : kTarget;
    EXPECT_NEAR(speed[k], reference - rate, 1e-4) << time;
    EXPECT_NEAR(torque[k], kGain * rate + kIntegral * lag(time), 1e-4) << time;
  }
  EXPECT_EQ(t.series.back().name, "motor_torque");
  EXPECT_EQ(t.series.back().unit, "N m");
  scene::Scene held = motor();
  held.drive.reset();
  EXPECT_FALSE(run_with(held, scene::Integrator::kEvent).has("motor_torque"));
}

// At its limit the speed rises by limit / J; then it makes up for the angle, by limit / gain too
// fast.
TEST(SpeedControl, GivesNoMoreThanItsLimit) {
  scene::Scene s = motor();
  s.drive->torque_limit = 4.0;
  s.run.end = 6.0;
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_with(s, integrator, 1e-4);
    const std::vector<double>& speed = t.column("spin_speed");
    EXPECT_NEAR(speed[20] - speed[10], 4.0 / kInertia * 0.1, 1e-6);
    double most = 0.0, fastest = 0.0;
    for (const double x : t.column("motor_torque")) most = std::max(most, std::abs(x));
    for (const double x : speed) fastest = std::max(fastest, x);
    EXPECT_EQ(most, 4.0);
    EXPECT_NEAR(fastest, kTarget + 4.0 / kGain, 0.1);
    EXPECT_NEAR(t.column("spin_speed").back(), kTarget, 1e-6);
    EXPECT_NEAR(t.column("motor_torque").back(), 0.0, 1e-6);
  }
}

// The integrator is a spring to a fixed step.
TEST(SpeedControl, LimitsTheStep) {
  scene::Scene s = motor();
  s.drive->integral_gain = 1e10;
  const StepLimit limit = step_limit(prepare(s));
  EXPECT_DOUBLE_EQ(limit.step, 2.0 / std::sqrt(1e10 / kInertia));
  EXPECT_NE(std::string(limit.of).find("integral_gain"), std::string::npos);
}

}  // namespace
}  // namespace rotorub
