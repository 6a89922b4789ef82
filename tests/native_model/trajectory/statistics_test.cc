// Figures of a run on steps made by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "native_model/bearing/actuator.h"
#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "native_model/trajectory/full_passes.h"
#include "native_model/trajectory/range_check.h"
#include "native_model/trajectory/recorder.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/jeffcott.h"
#include "tests/support/levitated_shaft.h"
#include "tests/support/native_run.h"
#include "tests/support/trapezoid_balance.h"

namespace rotorub {
namespace {

constexpr double kRoundOff = 1e-14;
const ContactSnapshot kFlight[1];

// Feeds states of a one-mode rotor, 2 kg, clearance 0.5 mm, radius 0.05 m.
class Feed {
 public:
  explicit Feed(const Model& model) : model_(model), recorder_(model, {}), balance_(model) {}
  void begin(const Eigen::Vector2d& q, const Eigen::Vector2d& v) {
    const Snapshot start{0.0, q.data(), v.data(), kFlight};
    recorder_.begin(start);
    balance_.begin(start);
    last_ = contact_point(model_, q.data(), v.data());
  }
  void step(double t, const Eigen::Vector2d& q, const Eigen::Vector2d& v, double normal = 0.0,
            double friction = 0.0, bool impact = false) {
    const Snapshot now{t, q.data(), v.data(), kFlight};
    const ContactPoint point = contact_point(model_, q.data(), v.data());
    const Impact own{t,          normal,     friction, last_.gap_rate, point.gap_rate,
                     last_.slip, point.slip, 0.0};
    const StepBalance balance = balance_.step(now, normal, friction, nullptr);
    recorder_.step(now, normal, friction, impact ? &own : nullptr, balance);
    last_ = point;
  }
  Trajectory finish(double end) { return recorder_.finish({end}); }

 private:
  const Model& model_;
  Recorder recorder_;
  test::TrapezoidBalance balance_;
  ContactPoint last_;
};

TEST(Statistics, ContactIsCountedFromFirstTouch) {
  const Model m = prepare(test::make_scene({.speed = 100.0}));
  const Eigen::Vector2d at{0.5e-3, 0.0}, whirl{0.0, 0.2}, resting{0.0, 0.0};
  Feed feed(m);
  feed.begin({0.4e-3, 0.0}, resting);
  feed.step(1.0, at, resting);                   // free
  feed.step(3.0, at, whirl, 8.0, -1.6);          // 2 s of contact, 4 N
  feed.step(4.0, at, whirl, 0.0, 0.0);           // free again
  feed.step(5.0, at, resting, 1.0, -0.2, true);  // an impact: one step
  feed.step(9.0, {0.51e-3, 0.0}, {0.1, 0.0});    // 10 um too deep, opening at -0.1 m/s
  const Trajectory t = feed.finish(9.0);
  const Statistics& s = t.statistics;
  EXPECT_EQ(s.first_touch, 1.0) << "the beginning of the step that touched";
  EXPECT_EQ(s.contact_time, 3.0);
  EXPECT_EQ(s.impulse_total, 9.0);
  EXPECT_DOUBLE_EQ(s.friction_impulse, -1.8);
  EXPECT_EQ(s.peak_force, 4.0);
  ASSERT_EQ(s.contacts.size(), 1U);
  EXPECT_EQ(s.contacts[0].impulse_total, s.impulse_total) << "the only contact is the whole";
  EXPECT_EQ(s.contacts[0].friction_work, s.friction_work);
  EXPECT_EQ(s.contacts[0].contact_time, s.contact_time);
  EXPECT_EQ(s.contacts[0].least_gap, s.least_gap);
  EXPECT_EQ(s.force_square, 4.0 * 4.0 * 2.0 + 1.0);
  EXPECT_DOUBLE_EQ(t.contact_fraction(), 3.0 / 8.0);
  EXPECT_DOUBLE_EQ(t.mean_force(), 9.0 / 8.0);
  EXPECT_NEAR(s.max_penetration, 1e-5, 1e-17);
  EXPECT_NEAR(s.least_gap, -1e-5, 1e-17);
  EXPECT_NEAR(s.penetration_square, 1e-10 * 4.0, 1e-20);
  EXPECT_NEAR(s.gap_rate_square, 0.01 * 4.0, 1e-15);
  // Slip: whirl 0.2 + 0.05 * 100. At rest before the first contact step, whirling after it.
  EXPECT_DOUBLE_EQ(s.friction_work, -1.6 * (5.0 + 5.2) / 2 - 0.2 * (5.2 + 5.0) / 2);
  EXPECT_LT(s.friction_work, 0.0) << "friction only takes";
}

// One contact lasts while another is hit: the step counts as one step of contact.
TEST(Statistics, AnImpactBesideLastingContactTakesNoTimeOfItsOwn) {
  const Model m = prepare(test::make_scene({}));
  const double q[] = {0.5e-3, 0.0}, v[] = {0.0, 0.0};
  Recorder recorder(m, {});
  recorder.begin({0.0, q, v, kFlight});
  const StepFigures lasting{.h = 1.0, .normal_impulse = 2.0},
      impact{.h = 1.0, .normal_impulse = 3.0, .impact = true};
  recorder.count(lasting, 0.0);
  recorder.count(impact, 0.0);
  const ContactPoint point = contact_point(m, q, v);
  recorder.advance({1.0, q, v, kFlight}, {&point, 1}, true);
  recorder.count(impact, 1.0);
  recorder.advance({2.0, q, v, kFlight}, {&point, 1}, true);
  const Statistics s = recorder.finish({2.0}).statistics;
  EXPECT_EQ(s.contact_time, 2.0);
  EXPECT_EQ(s.impact_time, 1.0) << "of the second step";
  EXPECT_EQ(s.impulse_total, 8.0);
}

TEST(Statistics, ImpactsBalanceTheEnergyWithTheirOwnWork) {
  // Head on with 0.4 m/s, back with 0.2: the work of the impulse is its mean gap rate times it.
  const Model m = prepare(test::make_scene({}));
  const auto run = [&](double impulse) {
    Feed feed(m);
    feed.begin({0.5e-3, 0.0}, {0.4, 0.0});
    feed.step(1e-5, {0.5e-3, 0.0}, {-0.2, 0.0}, impulse, 0.0, true);
    return feed.finish(1e-5).statistics;
  };
  const Statistics s = run(2.0 * 0.6);
  EXPECT_DOUBLE_EQ(s.energy_start, 0.16);
  EXPECT_DOUBLE_EQ(s.energy_end, 0.04);
  EXPECT_NEAR(s.contact_work, -0.12, kRoundOff);
  EXPECT_NEAR(s.energy_residual(), 0.0, kRoundOff);
  EXPECT_NEAR(run(2.0 * 0.7).energy_residual(), 0.02 / 0.16, kRoundOff)
      << "a wrong impulse does not balance";
}

TEST(Statistics, FrictionFromAHeldShaftFeedsTheOrbitAndIsBalanced) {
  // Sliding at 5 m/s drags the centre backward by 0.1 N s / 2 kg; the shaft is held at its speed.
  const Model m = prepare(test::make_scene({.speed = 100.0}));
  Feed feed(m);
  feed.begin({0.5e-3, 0.0}, {0.0, 0.0});
  feed.step(1e-5, {0.5e-3, 0.0}, {0.0, -0.05}, 0.5, -0.1);
  const Statistics s = feed.finish(1e-5).statistics;
  EXPECT_DOUBLE_EQ(s.energy_end, 0.5 * 2.0 * 0.05 * 0.05);
  EXPECT_NEAR(s.contact_work, s.energy_end, kRoundOff) << "what reaches the coordinates";
  EXPECT_DOUBLE_EQ(s.friction_work, -0.1 * (5.0 + 4.95) / 2) << "what friction does in all";
  EXPECT_NEAR(s.energy_residual(), 0.0, kRoundOff);
}

// ---------------------------------------------------------------- passes
constexpr double kTurn = 2.0 * std::numbers::pi;

FullPasses followed(double end, double step, const std::function<double(double)>& angle) {
  FullPasses passes;
  for (double t = 0.0; t <= end; t += step) {
    passes.follow(1e-4 * Eigen::Vector2d(std::cos(angle(t)), std::sin(angle(t))), t);
  }
  return passes;
}

TEST(FullPasses, OfAWhirl) {
  // 10.6 turns, in the one sense and the other, at 3 to 400 states a turn.
  for (const double each : {3.1, 7.3, 400.0}) {
    for (const double sense : {1.0, -1.0}) {
      const FullPasses p =
          followed(1.06, 0.1 / each, [&](double t) { return 0.3 + sense * kTurn * 10.0 * t; });
      EXPECT_EQ(sense > 0.0 ? p.forward() : p.backward(), 10) << each;
      EXPECT_EQ(sense > 0.0 ? p.backward() : p.forward(), 0) << each;
      EXPECT_NEAR(p.time(), 1.0, 0.1 / each + 0.03) << each;
    }
  }
}

// The rotor rocks for 1 s, then turns backward three times in 0.3 s, and rocks again.
TEST(FullPasses, BetweenRocking) {
  const FullPasses p = followed(2.5, 1e-3, [](double t) {
    if (t < 1.0) return -1.5 + 0.8 * std::sin(kTurn * 4.0 * t);
    if (t < 1.3) return -1.5 - kTurn * 10.0 * (t - 1.0);
    return -1.5 - 3.0 * kTurn + 0.8 * std::sin(kTurn * 4.0 * (t - 1.3));
  });
  EXPECT_EQ(p.backward(), 3);
  EXPECT_EQ(p.forward(), 0);
  EXPECT_NEAR(p.time(), 0.3, 0.25);
}

// ---------------------------------------------------------------- range
// A rotor or a ring that has left its support.

constexpr double kAirGap = 1e-3;  // m

scene::Scene in_magnets() {
  scene::Scene scene = test::make_scene({.mass = 2.0, .stiffness = 2e5});
  test::add_ring(scene, 1.0, 200.0, 1e4);
  scene.first().actuator = scene::Actuator{.kind = scene::ActuatorKind::kElectromagnet,
                                           .force_constant = 3e-5,
                                           .bias_current = 3.0,
                                           .air_gap = kAirGap};
  return scene;
}

TEST(RangeCheck, OfTheRingIsTheAirGapOnEitherAxis) {
  const Model model = prepare(in_magnets());
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(model.nq());
  Eigen::VectorXd q = v;
  const int ring = model.layout.ring();
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, -1.0)}) {
    q.segment(ring, 2) = from_axes(0.99 * kAirGap * axis);
    q.head(2) = q.segment(ring, 2);  // the rotor in its middle
    EXPECT_FALSE(out_of_range(model, q.data(), v.data()));
    q.segment(ring, 2) = from_axes(1.01 * kAirGap * axis);
    q.head(2) = q.segment(ring, 2);
    const auto reason = out_of_range(model, q.data(), v.data());
    ASSERT_TRUE(reason);
    EXPECT_NE(reason->find("air gap"), std::string::npos) << *reason;
  }
}

TEST(RangeCheck, OfTheRotorIsTwiceTheClearance) {
  const Model model = prepare(test::make_scene({.clearance = 0.5e-3}));
  const Eigen::VectorXd v = Eigen::VectorXd::Zero(model.nq());
  Eigen::VectorXd q = v;
  q[0] = 0.99e-3;
  EXPECT_FALSE(out_of_range(model, q.data(), v.data()));
  q[0] = -1.01e-3;
  const auto reason = out_of_range(model, q.data(), v.data());
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("clearance"), std::string::npos) << *reason;
}

// A soft ring holds up to its own thickness, 5 mm here, wherever it stands in the list.
TEST(RangeCheck, OfASoftRingIsItsOwnThickness) {
  scene::Scene scene = test::make_scene({.clearance = 0.5e-3, .radius = 5e-3});
  scene.auxiliary.push_back(scene.first());
  scene.auxiliary[1].contact->radius = 0.05;
  for (const char* order : {"thin ring first", "thick ring first"}) {
    SCOPED_TRACE(order);
    const Model model = prepare(scene);
    const Eigen::VectorXd v = Eigen::VectorXd::Zero(model.nq());
    Eigen::VectorXd q = v;
    q[0] = 5.4e-3;
    EXPECT_FALSE(out_of_range(model, q.data(), v.data(), RingDepth::kThickness));
    EXPECT_TRUE(out_of_range(model, q.data(), v.data()))
        << "a rigid ring holds up to its clearance";
    q[0] = 5.6e-3;
    EXPECT_TRUE(out_of_range(model, q.data(), v.data(), RingDepth::kThickness));
    std::swap(scene.auxiliary[0], scene.auxiliary[1]);
  }
}

// A shaft in magnets, one of which has a law of the wrong sign: its end flies off around the ring.
TEST(RangeCheck, OfAShaftIsTenTimesItsLength) {
  const scene::Scene scene = test::held_shaft(R"(
[[magnetic_bearing]]
station = 0.05
negative_stiffness = 1e4
[magnetic_bearing.control]
kind = "transfer_function"
force_per_current = 80
proportional = 2e4
numerator = [-2e4]
denominator = [1.0]
sample_time = 1e-4
[[magnetic_bearing]]
station = 0.55
negative_stiffness = 1e4
[magnetic_bearing.control]
force_per_current = 80
proportional = 2e4
derivative = 20
)");
  EXPECT_DOUBLE_EQ(prepare(scene).reach, 6.0);
  for (const Trajectory& t :
       {test::attempt_event(scene), test::attempt_with(scene, scene::Integrator::kVerlet)}) {
    SCOPED_TRACE(t.integrator);
    EXPECT_EQ(t.status, Status::kOutOfRange);
    EXPECT_NE(t.message.find("the magnetic bearings do not hold it (`rotorub modes`"),
              std::string::npos)
        << t.message;
  }
}

// A law of the wrong sign adds energy while the ring holds the rotor.
TEST(RangeCheck, OfASpeedBelongsToAnyRotor) {
  const Model model = prepare(test::make_scene({.clearance = 0.5e-3}));
  const Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq());
  Eigen::VectorXd v = q;
  v[1] = -0.99 * kFastestBending;
  EXPECT_FALSE(out_of_range(model, q.data(), v.data()));
  v[1] = -1.01 * kFastestBending;
  const auto reason = out_of_range(model, q.data(), v.data());
  ASSERT_TRUE(reason);
  EXPECT_NE(reason->find("moves at"), std::string::npos) << *reason;
}

}  // namespace
}  // namespace rotorub
