// The sliding law: its error dynamics, on a ring before a rotor on a prescribed orbit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "native_model/control/radial_tracking.h"
#include "native_model/control/sliding.h"
#include "native_model/scene/auxiliary_bearing.h"
#include "tests/support/runge_kutta.h"

namespace rotorub {
namespace {

constexpr double kClearance = 0.5e-3;

scene::Controller settings() {
  scene::Controller c;
  c.kind = scene::ControllerKind::kSliding;
  c.on = 0.1;
  c.bandwidth = 1500.0;
  c.boundary_layer = 0.03;
  c.switching_gain = 120.0;
  c.gap_time = 0.008;
  c.preload = 0.0;
  return c;
}

Plant plant() {
  Plant p;
  p.clearance = kClearance;
  p.stator_mass = {1.5, 1.5};
  p.stator_damping = {300.0, 250.0};
  p.stator_stiffness = {2e5, 1.4e5};
  return p;
}

const SwitchOn kOn{0.1, kClearance, 0.0};

// ------------------------------------------------------------------ closed loop

// A rotor that whirls with growing amplitude, r = R(t) e^{i w t}; its motion is prescribed.
Measurement orbit(double t) {
  const double growth = 0.02, w = 314.0;  // m/s, rad/s
  const double radius = 0.6e-3 + growth * (t - 0.1);
  const Eigen::Vector2d e{std::cos(w * t), std::sin(w * t)}, n{-e.y(), e.x()};
  Measurement m;
  m.t = t;
  m.rotor = radius * e;
  m.rotor_velocity = growth * e + radius * w * n;
  m.rotor_acceleration = 2.0 * growth * w * n - radius * w * w * e;
  return m;
}

// Law, ring and orbit; y = (q_f, qdot_f).
class Loop {
 public:
  explicit Loop(const scene::Controller& c, const Plant& p = plant()) : law_(c, p), plant_(p) {}

  // A ring on the near side of the rotor with the given gap and gap rate, and a sideways speed.
  static Eigen::Vector4d ring(double t, double gap, double gap_rate) {
    const Measurement m = orbit(t);
    const double a = 314.0 * t + 0.7;
    const Eigen::Vector2d e_r{std::cos(a), std::sin(a)}, e_t{-e_r.y(), e_r.x()};
    Eigen::Vector4d y;
    y << m.rotor - (kClearance - gap) * e_r, m.rotor_velocity + gap_rate * e_r - 0.05 * e_t;
    return y;
  }
  struct Error {
    double e, s;  // g_N - g_d, and edot + psi e
  };
  Error error(double t, const Eigen::VectorXd& y) const {
    const Measurement m = orbit(t);
    const Eigen::Vector2d d = m.rotor - y.head(2), dv = m.rotor_velocity - y.tail(2);
    const auto wanted = gap_reference(kOn, t, settings().gap_time);
    const double e = kClearance - d.norm() - wanted.gap;
    return {e, -d.normalized().dot(dv) - wanted.rate + settings().bandwidth * e};
  }
  // 2 us resolve the boundary layer's 250 us and the orbit's 20 ms to 1e-9.
  Eigen::VectorXd run(double from, double end, const Eigen::VectorXd& start) const {
    const auto rate = [&](double t, const Eigen::VectorXd& y) {
      Measurement m = orbit(t);
      m.stator = y.head(2);
      m.stator_velocity = y.tail(2);
      const Eigen::Vector2d own = plant_.stator_stiffness.cwiseProduct(m.stator) +
                                  plant_.stator_damping.cwiseProduct(m.stator_velocity);
      Eigen::VectorXd dy(4);
      dy << m.stator_velocity,
          (law_.command(m, kOn, nullptr) - own).cwiseQuotient(plant_.stator_mass);
      return dy;
    };
    return test::runge_kutta(rate, from, end, static_cast<int>((end - from) / 2e-6) + 1, start);
  }

 private:
  SlidingController law_;
  Plant plant_;
};

// Within the boundary layer sdot = -k s / phi and edot = -psi e + s: two exponentials, for any
// motion of the rotor and any spring, damper and mass of the ring in either direction.
TEST(SlidingLoop, ErrorDecaysAsTheLawPromises) {
  const scene::Controller c = settings();
  Plant heavier_one_way = plant();
  heavier_one_way.stator_mass = {1.5, 3.0};
  for (const Plant& p : {plant(), heavier_one_way}) {
    const Loop loop(c, p);
    const double from = 0.109;  // the reference is 0
    const double psi = c.bandwidth, decay = c.switching_gain / c.boundary_layer;
    Eigen::VectorXd y = Loop::ring(from, 1e-5, 0.01);
    const Loop::Error start = loop.error(from, y);
    ASSERT_LT(std::abs(start.s), c.boundary_layer);
    for (const double t : {0.25e-3, 0.5e-3, 1e-3}) {
      const Loop::Error now = loop.error(from + t, loop.run(from, from + t, y));
      const double s = start.s * std::exp(-decay * t), forced = start.s / (psi - decay);
      const double e = (start.e - forced) * std::exp(-psi * t) + forced * std::exp(-decay * t);
      EXPECT_NEAR(now.s, s, 1e-6 * start.s) << t;
      EXPECT_NEAR(now.e, e, 1e-6 * start.e) << t;
    }
  }
}

TEST(SlidingLoop, ReachesTheLayerAtTheRateOfTheSwitchingGain) {
  const Loop loop(settings());
  const double from = 0.109;
  const Eigen::VectorXd y = Loop::ring(from, 1.8e-4, 0.03);
  const double s = loop.error(from, y).s;
  ASSERT_GT(s, 10 * settings().boundary_layer - 0.01);
  for (const double t : {0.5e-3, 1e-3, 2e-3}) {
    EXPECT_NEAR(loop.error(from + t, loop.run(from, from + t, y)).s, s - 120.0 * t, 1e-6) << t;
  }
}

TEST(SlidingLoop, GapFollowsTheReferenceToZero) {
  const Loop loop(settings());
  Eigen::VectorXd y = Loop::ring(0.1, 0.8 * kClearance, -0.05);
  double worst = 0.0, last = 0.1;
  for (double t = 0.1005; t < 0.13; t += 0.5e-3) {
    y = loop.run(last, t, y);
    last = t;
    // 0.1 mm of error: psi e / k = 1.3 ms to the layer, and 1/psi = 0.7 ms a decay from there.
    if (t > 0.106) worst = std::max(worst, std::abs(loop.error(t, y).e));
  }
  EXPECT_LT(worst, 0.01 * kClearance);
  EXPECT_LT(std::abs(loop.error(last, y).e), 1e-7 * kClearance) << "and stays there";
}

TEST(SlidingLoop, PreloadPressesOnceTheReferenceIsClosed) {
  scene::Controller c = settings();
  c.preload = 20.0;
  const Loop loop(c);
  const Eigen::VectorXd y = loop.run(0.109, 0.13, Loop::ring(0.109, 1e-5, 0.0));
  // Without a contact that holds it, the ring goes on by P phi / (M k psi).
  EXPECT_NEAR(loop.error(0.13, y).e, -20.0 * 0.03 / (1.5 * 120.0 * 1500.0), 1e-11);
  // The preload grows as the reference falls: none at switch-on, half of it halfway.
  scene::Controller none = settings();
  const auto pressed = [&](double t) {
    Measurement m = orbit(t);
    m.stator = m.rotor - Eigen::Vector2d(3e-4, 0.0);
    return SlidingController(c, plant()).command(m, kOn, nullptr).x() -
           SlidingController(none, plant()).command(m, kOn, nullptr).x();
  };
  EXPECT_NEAR(pressed(0.1), 0.0, 1e-10);
  EXPECT_NEAR(pressed(0.104), -10.0, 1e-10);
  EXPECT_NEAR(pressed(0.2), -20.0, 1e-10) << "against e_r: on to the rotor";
}

TEST(SlidingForce, CentresTogetherAskForNothing) {
  const SlidingController law(settings(), plant());
  for (const double delta : {0.0, 5e-324, 1e-300, 1e-160, 1e-16}) {
    Measurement m = orbit(0.103);
    m.stator = m.rotor = {0.0, 0.0};
    m.rotor.x() = delta;
    EXPECT_EQ(law.command(m, kOn, nullptr), Eigen::Vector2d(0.0, 0.0))
        << delta << ": no direction to track";
  }
}

// ------------------------------------------------------------------

// The two-phase law: each phase is the law of its name, and the force does not jump between them.

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

// The rotor approaches the ring at 0.1 m/s, touches at t = 2 ms and returns at half the speed; the
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
