// The derivative of a motion's end by its start against central differences of whole motions.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "native_model/periodic/forcing.h"
#include "native_model/periodic/return_map.h"
#include "native_model/prepare/prepare.h"
#include "native_model/prepare/repeating_model.h"
#include "tests/native_model/periodic/levitated_rotor.h"
#include "tests/native_model/periodic/sampled_ring.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub::periodic {
namespace {

// The events of the motion, one letter each: I impact, T touch, S sliding begins or reverses,
// R rolling or sticking begins, L lift-off or release.
std::string events_of(const Model& model, const MotionRecord& motion) {
  std::string events;
  for (const Stretch& s : motion.stretches) {
    if (!s.jump) continue;
    const ContactState& to = s.jump->states[s.jump->contact];
    const ContactState& from = s.states[s.jump->contact];
    const bool gives = model.auxiliary[s.jump->contact].is_compliant();
    if (from.mode == ContactMode::kFree) events += gives ? 'T' : 'I';
    if (from.mode != ContactMode::kFree && to.mode == ContactMode::kFree) events += 'L';
    if (to.mode == ContactMode::kSlide) events += 'S';
    if (to.mode == ContactMode::kStick) events += 'R';
  }
  return events;
}

// Compares the derivative of the motion of `duration` (s) from `start`, in the tangent space of the
// held contacts. tolerance: relative to its largest entry, both in the sizes of the state. Returns
// the events.
std::string expect_derivative(const Model& model, const State& start, double duration,
                              double tolerance, const HeldContacts& held = {}) {
  const ReturnMap map(model);
  const Return point = map.at(start, duration, 0);
  EXPECT_EQ(point.status, Status::kOk) << point.message;
  const ReturnDerivative d = map.derivative(point, held);
  EXPECT_FALSE(d.grazes);
  double error = 0.0;
  for (Eigen::Index j = 0; j < d.basis.cols(); ++j) {
    constexpr double kShare = 1e-5;
    const auto end_at = [&](double share) {
      const State moved = map.moved(start, point.sizes, d.basis,
                                    share * Eigen::VectorXd::Unit(d.basis.cols(), j), held);
      const MotionRecord motion = record_motion(model, moved, start.t + duration);
      EXPECT_EQ(motion.status, Status::kOk) << motion.message;
      const Eigen::Map<const Eigen::VectorXd> y(motion.end.data(), point.sizes.size());
      return map.essential().take(y.cwiseQuotient(point.sizes).eval().data());
    };
    const Eigen::VectorXd expected = (8.0 * (end_at(kShare) - end_at(-kShare)) -
                                      (end_at(2.0 * kShare) - end_at(-2.0 * kShare))) /
                                     (12.0 * kShare);
    for (Eigen::Index i = 0; i < expected.size(); ++i) {
      // ReturnMap sets the rows of a law's settings to 0.
      const bool stays = d.image.row(i).isZero(0.0) && d.basis(i, j) == expected[i];
      if (!stays) error = std::max(error, std::abs(d.image(i, j) - expected[i]));
    }
  }
  const double largest = d.image.cwiseAbs().maxCoeff();
  EXPECT_LT(error, tolerance * largest);
  return events_of(model, point.motion);
}

TEST(FlowDerivative, OfAFlight) {
  const Model model = prepare(test::shipped("bench_ring"));
  EXPECT_EQ(expect_derivative(model, initial_state(model), 4e-3, 1e-8), "");
}

TEST(FlowDerivative, OfImpactsWithAFreeSpin) {
  const Model model = prepare(test::shipped("bench_ring"));
  EXPECT_EQ(expect_derivative(model, initial_state(model), 9.5e-3, 1e-7), "III");
}

TEST(FlowDerivative, OfAnAccumulationOfImpactsAndASlidingRub) {
  const Model model = prepare(test::shipped("bench_ring"));
  const std::string events = expect_derivative(model, initial_state(model), 0.02, 1e-5);
  EXPECT_EQ(events.back(), 'S');
}

// A slow spin and much friction: the rotor falls on the ring under its weight, slips and rolls.
TEST(FlowDerivative, OfSlipThatEndsInRolling) {
  scene::Scene scene = test::make_scene({.mass = 2.0,
                                         .damping = 40.0,
                                         .stiffness = 2e5,
                                         .friction = 0.3,
                                         .restitution = 0.0,
                                         .speed = 3.0});
  test::add_ring(scene, 1.0, 200.0, 1e6);
  test::add_constant_force(scene, {20.0, -150.0});
  const Model model = prepare(scene);
  expect_derivative(model, initial_state(model), 0.1, 1e-7);
}

TEST(FlowDerivative, OfARubThatStopsAndSlipsAgain) {
  scene::Scene scene = test::make_scene({.mass = 2.0,
                                         .damping = 10.0,
                                         .stiffness = 1e5,
                                         .friction = 0.3,
                                         .restitution = 0.3,
                                         .speed = 2.0});
  test::add_constant_force(scene, {0.0, -150.0});
  test::add_rotating_force(scene, 60.0, 130.0);
  const Model model = prepare(scene);
  expect_derivative(model, initial_state(model), 0.1, 3e-5);
}

TEST(FlowDerivative, OfACompliantContact) {
  for (const double exponent : {1.0, 1.5}) {
    SCOPED_TRACE(exponent);
    scene::Scene scene = test::shipped("compliant_ring");
    scene.first().contact->compliance->exponent = exponent;
    if (exponent == 1.0) scene.first().contact->compliance->stiffness = 1e7;
    const Model model = prepare(scene);
    expect_derivative(model, initial_state(model), 0.012, 1e-5);
  }
}

TEST(FlowDerivative, OfASpringAndADamperInTheContact) {
  scene::Scene scene = test::shipped("compliant_ring");
  scene.first().contact->compliance->exponent = 1.0;
  scene.first().contact->compliance->stiffness = 1e7;
  scene.first().contact->compliance->damping = 300.0;
  const Model model = prepare(scene);
  expect_derivative(model, initial_state(model), 0.012, 1e-6);
}

TEST(FlowDerivative, OfTwoContacts) {
  const Model model = prepare(test::shipped("two_catchers"));
  expect_derivative(model, initial_state(model), 0.012, 1e-5);
}

// The memory of the controls and the voltages' limits of 150 V are parts of the motion.
TEST(FlowDerivative, OfSampledMagneticBearings) {
  for (const char* delay : {"0", "100 us"}) {
    SCOPED_TRACE(delay);
    scene::Scene scene = test::levitated_rotor(delay);
    const Model model = repeating_model(scene, prepare(scene), prepare);
    const MotionRecord before = record_motion(model, initial_state(model), 0.020325);
    State start{before.end_time, {}, {}};
    start.q = Eigen::Map<const Eigen::VectorXd>(before.end.data(), model.nq());
    start.v = Eigen::Map<const Eigen::VectorXd>(before.end.data() + model.nq(), model.nq());
    expect_derivative(model, start, 4.1e-3, 1e-6);
  }
}

// From the middle between two samples in free flight to lasting contact.
TEST(FlowDerivative, OfSampledControllersOfARing) {
  for (const std::vector<std::string>& law : test::sampled_laws()) {
    SCOPED_TRACE(testing::PrintToString(law));
    scene::Scene scene = test::sampled_ring(law);
    scene.first().contact->restitution = 0.0;
    const Model model = repeating_model(scene, prepare(scene), prepare);
    const MotionRecord before = record_motion(model, initial_state(model), 0.0021);
    State start{before.end_time, {}, {}};
    start.q = Eigen::Map<const Eigen::VectorXd>(before.end.data(), model.nq());
    start.v = Eigen::Map<const Eigen::VectorXd>(before.end.data() + model.nq(), model.nq());
    const std::string events = expect_derivative(model, start, 0.02, 1e-6);
    const bool touches = law.front().find("lqg") == std::string::npos;
    EXPECT_EQ(events.substr(0, 1), touches ? "I" : "");
  }
}

TEST(FlowDerivative, OfFrictionThatFallsWithTheSlip) {
  const Model model = prepare(test::shipped("falling_friction"));
  HeldContacts held;
  held.push_back({0, Constraint::Velocity::kTangential});
  expect_derivative(model, initial_state(model), 0.02, 1e-6, held);
}

}  // namespace
}  // namespace rotorub::periodic
