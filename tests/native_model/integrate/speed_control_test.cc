// A motor under speed control: with a rigid rotor its loop is linear within the limit, and its
// answer to the ramp of the reference is known.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "native_model/prepare/prepare.h"
#include "native_model/stepping/step_limit.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::run_with;

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
  EXPECT_EQ(t.status, Status::kOk) << t.message;
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
    ASSERT_EQ(t.status, Status::kOk) << t.message;
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
