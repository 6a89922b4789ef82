// Figures of a run on steps made by hand.
#include <gtest/gtest.h>

#include "native_model/model/dynamics.h"
#include "native_model/prepare/prepare.h"
#include "native_model/trajectory/recorder.h"
#include "tests/support/jeffcott.h"
#include "tests/support/trapezoid_balance.h"

namespace rotorub {
namespace {

constexpr double kRoundOff = 1e-14;

// Feeds states of a one-mode rotor, 2 kg, clearance 0.5 mm, radius 0.05 m.
class Feed {
 public:
  explicit Feed(const Model& model) : model_(model), recorder_(model, {}), balance_(model) {}
  void begin(const Eigen::Vector2d& q, const Eigen::Vector2d& v) {
    const Snapshot start{{}, 0.0, q.data(), v.data()};
    recorder_.begin(start);
    balance_.begin(start);
    last_ = contact_point(model_, q.data(), v.data());
  }
  void step(double t, const Eigen::Vector2d& q, const Eigen::Vector2d& v, double normal = 0.0,
            double friction = 0.0, bool impact = false) {
    const Snapshot now{{}, t, q.data(), v.data()};
    const ContactPoint point = contact_point(model_, q.data(), v.data());
    const Impact own{t,          normal,     friction, last_.gap_rate, point.gap_rate,
                     last_.slip, point.slip, 0.0};
    const StepBalance balance = balance_.step(now, normal, friction, nullptr);
    recorder_.step(now, normal, friction, impact ? &own : nullptr, balance);
    last_ = point;
  }
  Trajectory finish(double end) { return recorder_.finish(end); }

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

// One contact lasts while another is hit: the step is one step of contact.
TEST(Statistics, AnImpactBesideLastingContactTakesNoTimeOfItsOwn) {
  const Model m = prepare(test::make_scene({}));
  const double q[] = {0.5e-3, 0.0}, v[] = {0.0, 0.0};
  Recorder recorder(m, {});
  recorder.begin({{}, 0.0, q, v});
  const StepFigures lasting{.h = 1.0, .normal_impulse = 2.0},
      impact{.h = 1.0, .normal_impulse = 3.0, .impact = true};
  recorder.count(lasting, 0.0);
  recorder.count(impact, 0.0);
  recorder.advance({{}, 1.0, q, v}, contact_point(m, q, v), true);
  recorder.count(impact, 1.0);
  recorder.advance({{}, 2.0, q, v}, contact_point(m, q, v), true);
  const Statistics s = recorder.finish(2.0).statistics;
  EXPECT_EQ(s.contact_time, 2.0);
  EXPECT_EQ(s.impact_time, 1.0) << "of the second step";
  EXPECT_EQ(s.impulse_total, 8.0);
}

TEST(Statistics, PenetrationIsTheDeepestMet) {
  const Model m = prepare(test::make_scene({}));
  Feed feed(m);
  feed.begin({0.5e-3, 0.0}, {0.0, 0.0});
  feed.step(1.0, {0.52e-3, 0.0}, {0.0, 0.0}, 1.0, 0.0);
  feed.step(2.0, {0.505e-3, 0.0}, {0.0, 0.0}, 1.0, 0.0);
  const Statistics s = feed.finish(2.0).statistics;
  EXPECT_NEAR(s.max_penetration, 2e-5, 1e-17);
  EXPECT_NEAR(s.penetration_square, 4e-10 + 0.25e-10, 1e-20);
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

}  // namespace
}  // namespace rotorub
