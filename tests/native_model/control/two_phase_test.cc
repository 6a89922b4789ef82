// The two-phase law: each phase is the law that it is made of, and the force does not jump between
// them.
#include "native_model/control/two_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rotorub {
namespace {

constexpr double kPhaseSample = 2e-5, kPhaseClearance = 5e-4;

scene::Controller two_phase_settings() {
  scene::Controller c;
  c.kind = scene::ControllerKind::kTwoPhase;
  c.sample_time = kPhaseSample;
  c.feedback = {2000.0};
  c.handover_time = 0.004;
  c.gap_time = 0.008;
  return c;
}

Plant two_phase_plant() {
  Plant p;
  p.clearance = kPhaseClearance;
  p.stator_mass = {1.5, 1.5};
  p.stator_damping = {300.0, 300.0};
  p.stator_stiffness = {2e5, 2e5};
  return p;
}

// The rotor closes on the ring at 0.1 m/s, touches at t = 2 ms and comes back at half of it; the
// ring moves.
Measurement at(int k) {
  const double t = k * kPhaseSample, touch = 0.002;
  Measurement m;
  m.t = t;
  m.sample = k;
  m.spin_speed = 314.0;
  const double gap = t < touch ? 0.1 * (touch - t) : 0.05 * (t - touch);
  const double rate = t < touch ? -0.1 : 0.05;
  const Eigen::Vector2d e(std::cos(300.0 * t), std::sin(300.0 * t)), n(-e.y(), e.x());
  m.stator = {1e-5 * std::sin(400.0 * t), 2e-5 * std::cos(300.0 * t)};
  m.stator_velocity = {4e-3 * std::cos(400.0 * t), -6e-3 * std::sin(300.0 * t)};
  m.rotor = m.stator + (kPhaseClearance - gap) * e;
  m.rotor_velocity = m.stator_velocity - rate * e + 300.0 * (kPhaseClearance - gap) * n;
  return m;
}

TEST(TwoPhase, TracksFirstThenCrossesAndTheForceDoesNotJump) {
  const TwoPhase law(two_phase_settings(), two_phase_plant());
  const SlidingController track(two_phase_settings(), two_phase_plant());
  const CrossCoupled cross(two_phase_settings());
  const SwitchOn on{0.0, 2e-4, -0.1};
  std::vector<double> state(law.state_size(), 0.0);
  law.start(state.data());
  Eigen::Vector2d last{0.0, 0.0};
  double largest_change = 0.0, in_tracking = 0.0;
  for (int k = 0; k < 500; ++k) {
    const Measurement m = at(k);
    const Eigen::Vector2d u = law.command(m, on, state.data());
    if (k <= 100) {
      EXPECT_EQ(u, track.command(m, on, nullptr)) << k << ": sliding up to the touch";
    }
    if (k > 101 + 200) {
      EXPECT_LT((u - cross.command(m, on, nullptr)).norm(), 1e-12)
          << k << ": cross-coupled after it";
    }
    const double change = (u - last).norm();
    if (k > 0 && k < 99) in_tracking = std::max(in_tracking, change);
    if (k > 101) largest_change = std::max(largest_change, change);
    last = u;
  }
  EXPECT_GT(in_tracking, 0.0);
  // From the force left over, some hundred N, to nothing in 200 samples, 1.9 times the mean at
  // most; and the feedback's own.
  EXPECT_LT(largest_change, 10.0);
}

TEST(TwoPhase, WithoutATouchItGoesOnTracking) {
  const TwoPhase law(two_phase_settings(), two_phase_plant());
  const SlidingController track(two_phase_settings(), two_phase_plant());
  std::vector<double> state(law.state_size(), 0.0);
  law.start(state.data());
  for (int k = 0; k < 95; ++k) {
    EXPECT_EQ(law.command(at(k), {0.0, 2e-4, -0.1}, state.data()),
              track.command(at(k), {0.0, 2e-4, -0.1}, nullptr));
  }
}

// The layer of (27): phi' + psi phi = k.
TEST(AdaptiveLayer, GoesToItsRestAsTheEquationSays) {
  scene::Controller c = two_phase_settings();
  c.kind = scene::ControllerKind::kSliding;
  c.layer = scene::BoundaryLayer::kAdaptive;
  c.boundary_layer = 0.03;
  const SlidingController law(c, two_phase_plant());
  ASSERT_EQ(law.state_size(), 1u);
  double state = 0.0;
  law.start(&state);
  const double rest = c.switching_gain / c.bandwidth;
  for (int k = 0; k < 50; ++k) {
    const double wanted = rest + (0.03 - rest) * std::exp(-c.bandwidth * kPhaseSample * k);
    EXPECT_NEAR(state, wanted, 1e-15) << k;
    // Within the layer psi s: u = M (... - psi e' - psi s), whatever k is.
    const Measurement m = at(k);
    scene::Controller constant = c;
    constant.layer = scene::BoundaryLayer::kConstant;
    constant.boundary_layer = 1.0;
    constant.switching_gain = c.bandwidth;
    double values[2] = {0.0, 0.0};
    law.output(m, {0.0, 2e-4, -0.1}, &state, values);
    ASSERT_EQ(values[1], state);
    const bool within = std::abs(values[0]) < state;
    const Eigen::Vector2d u = law.command(m, {0.0, 2e-4, -0.1}, &state);
    if (within) {
      const Eigen::Vector2d same =
          SlidingController(constant, two_phase_plant()).command(m, {0.0, 2e-4, -0.1}, nullptr);
      EXPECT_LT((u - same).norm(), 1e-10 * same.norm()) << k;
    }
  }
}

}  // namespace
}  // namespace rotorub
