// The force of two opposed magnets, against exact answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "native_model/model/model.h"
#include "tests/support/jeffcott.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

constexpr double kMagnetsHold = 2.0, kMagnetsCarry = kMagnetsHold * 9.81;  // kg, N
constexpr double kRateLag = 1e-4, kCoilBandwidth = 9000.0;                 // s, rad/s
constexpr double kConstant = 2e-6, kBias = 2.5, kGap = 6e-4;               // N m^2/A^2, A, m

scene::Scene opposed(double stiffness) {
  scene::Scene s =
      test::make_scene({.mass = kMagnetsHold, .stiffness = stiffness, .clearance = 5e-4});
  scene::MagneticBearing magnets;
  magnets.shape = {1.0};
  magnets.kind = scene::MagnetKind::kElectromagnet;
  magnets.force_constant = kConstant;
  magnets.bias_current = kBias;
  magnets.air_gap = kGap;
  s.magnetic_bearings = {magnets};
  s.run.end = 0.05;
  s.run.output_step = 1e-3;
  return s;
}

double force(double r, double i) {
  const double near = (kBias + i) / (kGap - r), far = (kBias - i) / (kGap + r);
  return kConstant * (near * near - far * far);
}

// Without a current its force has the potential -k_m i_0^2 (1/(s_0 - r) + 1/(s_0 + r)).
TEST(OpposedMagnets, HaveAPotentialAtTheirBias) {
  constexpr double kSpring = 6e5, kStart = 3e-4;
  scene::Scene s = opposed(kSpring);
  s.magnetic_bearings[0].control = scene::BearingControl{};
  s.first().contact.reset();
  s.initial.x = {kStart};
  const auto potential = [](double r) {
    return 0.5 * kSpring * r * r -
           kConstant * kBias * kBias * (1.0 / (kGap - r) + 1.0 / (kGap + r));
  };
  const Trajectory t = run_event(s);
  const double all = potential(kStart), size = 0.5 * kSpring * kStart * kStart;
  double least = kStart;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double r = t.column("rotor_x")[k], rate = t.column("rotor_vx")[k];
    EXPECT_NEAR(0.5 * kMagnetsHold * rate * rate + potential(r), all, 1e-10 * size) << k;
    least = std::min(least, r);
  }
  EXPECT_LT(least, -0.9 * kStart);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  test::expect_order_of_steps(s, {4e-5, 2e-5, 1e-5, 5e-6}, 1.95,
                              [&](const Trajectory& run) { return test::rotor_error(run, t); });
}

// About the middle it is k_s r + k_i i, k_i = 4 k_m i_0 / s_0^2, k_s = k_i i_0 / s_0, to the third
// order.
TEST(OpposedMagnets, AreLinearAboutTheMiddle) {
  const double gain = 4.0 * kConstant * kBias / (kGap * kGap), pull = gain * kBias / kGap;
  const scene::BearingControl control{
      .proportional = 2.0 * pull / gain, .derivative = 1.5, .derivative_lag = kRateLag};
  const auto error = [&](double size) {
    scene::Scene nonlinear = opposed(0.0), linear = nonlinear;
    nonlinear.magnetic_bearings[0].control = control;
    linear.magnetic_bearings[0] = {.shape = {1.0}, .negative_stiffness = pull, .control = control};
    linear.magnetic_bearings[0].control->force_per_current = gain;
    for (scene::Scene* s : {&nonlinear, &linear}) {
      s->magnetic_bearings[0].amplifier = scene::Amplifier{.bandwidth = kCoilBandwidth};
      s->initial.x = {size};
    }
    return test::rotor_error(run_event(nonlinear), run_event(linear)) / size;
  };
  const double small = error(1e-6), larger = error(1e-5);
  EXPECT_LT(small, 1e-4);
  EXPECT_NEAR(larger / small, 100.0, 5.0);
}

// Under a weight the damped rotor comes to rest where F(r, -P r) balances it, not where the linear
// law would.
TEST(OpposedMagnets, CarryAWeightWhereTheirForceDoes) {
  const double gain = 4.0 * kConstant * kBias / (kGap * kGap), pull = gain * kBias / kGap;
  const double p = 2.5 * pull / gain;
  scene::Scene s = opposed(0.0);
  s.magnetic_bearings[0].control = scene::BearingControl{.proportional = p, .derivative = 12.0};
  s.gravity = scene::Gravity{{0.0, -9.81}, {}};
  s.run.end = 1.0;
  double low = -1e-4, high = 0.0;
  ASSERT_GT(force(low, -p * low), kMagnetsCarry);
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (force(middle, -p * middle) > kMagnetsCarry ? low : high) = middle;
  }
  ASSERT_GT(std::abs(low + kMagnetsCarry / (gain * p - pull)), 1e-3 * std::abs(low));
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    EXPECT_NEAR(run_with(s, integrator).column("rotor_y").back(), low, 1e-11)
        << static_cast<int>(integrator);
  }
}

// The cores do not stop the rotor: beyond 99 % of the gap the force is constant. A bearing without
// a control has the same magnets, and no current to show.
TEST(OpposedMagnets, PullBeyondTheirGapAsAt99PercentOfIt) {
  constexpr double kReach = 0.99 * kGap;
  for (const double start : {kReach, kGap, 3.0 * kGap}) {
    for (const bool controlled : {false, true}) {
      for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
        scene::Scene s = opposed(0.0);
        if (controlled) s.magnetic_bearings[0].control = scene::BearingControl{};
        s.first().contact.reset();
        s.initial.x = {start};
        s.run.end = 8e-4;
        s.run.output_step = 1e-4;
        const Trajectory t = run_with(s, integrator);
        EXPECT_EQ(t.has("bearing_current_x"), controlled);
        for (std::size_t k = 0; k < t.rows(); ++k) {
          const double time = t.column("t")[k];
          const double exact = start + 0.5 * force(kReach, 0.0) / kMagnetsHold * time * time;
          EXPECT_NEAR(t.column("rotor_x")[k] / exact, 1.0, 1e-12) << start << " " << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace rotorub
