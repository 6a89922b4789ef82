// Onsets in made-up steps, by hand.
#include "compare/study/resync.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tests/support/native_run.h"

namespace rotorub {
namespace {

constexpr double kStep = 1e-3;       // s
constexpr double kClearance = 5e-4;  // m, of the scene

// bench_drop's rotor (one mode a plane, fixed ring) on the x axis, where the steps say it is.
class MadeUpSteps : public testing::Test {
 protected:
  void fly(int steps, double gap = 1e-5, double gap_rate = -0.1) {
    for (int k = 0; k < steps; ++k) give(0.0, gap, gap_rate);
  }
  void press(double impulse, double gap = -1e-6, double gap_rate = 0.0) {
    give(impulse, gap, gap_rate);
  }
  void hit(double impulse, double rebound, double part) {
    WatchedStep s = made(1e-5, -0.1);
    const WatchedContact contact{impulse, true, s.t + part * kStep, rebound};
    s.contacts = {&contact, 1};
    watch_.step(s);
    ++k_;
  }
  std::vector<Onset> finish() { return watch_.finish(k_ * kStep); }
  double now() const { return k_ * kStep; }

  const Model model_ = prepare(test::shipped("bench_drop"));
  OnsetWatch watch_{model_};

 private:
  WatchedStep made(double gap, double gap_rate) {
    q_.assign(static_cast<std::size_t>(model_.nq()), 0.0);
    v_ = q_;
    q_[0] = kClearance - gap;
    v_[0] = -gap_rate;
    WatchedStep s;
    s.t = k_ * kStep;
    s.h = kStep;
    s.q = q_.data();
    s.v = v_.data();
    return s;
  }
  void give(double impulse, double gap, double gap_rate) {
    WatchedStep s = made(gap, gap_rate);
    const WatchedContact contact{impulse};
    s.contacts = {&contact, 1};
    watch_.step(s);
    ++k_;
  }

  int k_ = 0;
  std::vector<double> q_, v_;
};

TEST_F(MadeUpSteps, ASoftContactIsSummedUp) {
  fly(12);  // the last of them at 11 ms
  press(0.2);
  press(0.5);
  press(0.1);           // its force acts until half a step after 14 ms
  fly(21, 2e-5, 0.07);  // leaves with 0.07 m/s
  const double end = now();
  const auto onsets = finish();
  ASSERT_EQ(onsets.size(), 1U);
  const Onset& o = onsets[0];
  EXPECT_NEAR(o.before.t, 11e-3, 1e-15);
  EXPECT_NEAR(o.before.q[0], kClearance - 1e-5, 1e-15);
  EXPECT_NEAR(o.closing, 0.1, 1e-15);
  EXPECT_NEAR(o.touch, 11e-3 + 1e-4, 1e-12);  // 10 um at 0.1 m/s
  EXPECT_NEAR(o.mujoco.impulse, 0.8, 1e-15);
  EXPECT_NEAR(o.mujoco.window_impulse, 0.8, 1e-15);
  EXPECT_NEAR(o.mujoco.duration, 14.5e-3 - o.touch, 1e-12);
  EXPECT_NEAR(o.mujoco.rebound, 0.07, 1e-15);
  EXPECT_NEAR(o.end, 0.5 * (14.5e-3 + end), 1e-12);
  EXPECT_FALSE(o.lasts);
}

TEST_F(MadeUpSteps, AnImpactOfTheRigidLawTakesNoTime) {
  fly(12);
  hit(0.3, 0.05, 0.1);
  fly(12);
  const auto onsets = finish();
  ASSERT_EQ(onsets.size(), 1U);
  EXPECT_NEAR(onsets[0].mujoco.impulse, 0.3, 1e-15);
  EXPECT_NEAR(onsets[0].mujoco.rebound, 0.05, 1e-15);
  EXPECT_NEAR(onsets[0].touch, 12.1e-3, 1e-12);
  EXPECT_EQ(onsets[0].mujoco.duration, 0.0);
}

// Short flights are bounces of one contact, long ones begin another.
TEST_F(MadeUpSteps, ShortFlightsAreOneContact) {
  fly(kShortestFlight);
  press(0.1);
  fly(kShortestFlight - 1);
  press(0.2);
  fly(kShortestFlight);
  const double next = now();
  press(0.4);
  const double end = now();
  const auto onsets = finish();
  ASSERT_EQ(onsets.size(), 2U);
  EXPECT_NEAR(onsets[0].mujoco.impulse, 0.3, 1e-15);
  EXPECT_NEAR(onsets[0].end, 0.5 * (20.5e-3 + next), 1e-12);
  EXPECT_NEAR(onsets[1].mujoco.impulse, 0.4, 1e-15);
  EXPECT_TRUE(onsets[1].lasts);
  EXPECT_EQ(onsets[1].end, end);
  EXPECT_EQ(onsets[1].mujoco.rebound, 0.0) << "it never parts";
}

// A contact at the start has no state before it, and a contact at the end has none after it.
TEST_F(MadeUpSteps, OnlyFlightsThatEndAreOnsets) {
  press(0.1);
  fly(kShortestFlight - 1);
  press(0.1);
  fly(kShortestFlight, -1e-6, -0.1);  // without a force, but in the ring
  press(0.1);
  EXPECT_EQ(watch_.left_out(), 1);
  EXPECT_TRUE(finish().empty());
}

// The rotor of two_catchers, whose contact `touching` alone touches its ring.
std::vector<Onset> onsets_at(const Model& model, std::size_t touching) {
  const Layout& l = model.layout;
  Eigen::Matrix2d shapes;
  for (int k = 0; k < 2; ++k)
    shapes.row(k) = model.auxiliary[static_cast<std::size_t>(k)].shape.x.head(2);
  const auto at_contact = [&](double there) {
    return Eigen::Vector2d(shapes.inverse() *
                           (there * Eigen::Vector2d::Unit(static_cast<Eigen::Index>(touching))));
  };
  Eigen::VectorXd q = Eigen::VectorXd::Zero(l.nq()), v = q;
  OnsetWatch watch(model);
  int step = 0;
  const auto give = [&](double impulse, double gap, double gap_rate) {
    q.segment<2>(l.x()) = at_contact(model.auxiliary[touching].contact->clearance - gap);
    v.segment<2>(l.x()) = at_contact(-gap_rate);
    std::vector<WatchedContact> contacts(model.auxiliary.size());
    contacts[touching].normal_impulse = impulse;
    WatchedStep s;
    s.t = step++ * kStep;
    s.h = kStep;
    s.q = q.data();
    s.v = v.data();
    s.contacts = contacts;
    watch.step(s);
  };
  for (int k = 0; k < 12; ++k) give(0.0, 1e-5, -0.1);
  give(0.2, -1e-6, 0.0);
  give(0.5, -1e-6, 0.0);
  for (int k = 0; k < 21; ++k) give(0.0, 2e-5, 0.07);
  return watch.finish(step * kStep);
}

// Which of the auxiliary bearings has the contact makes no difference.
TEST(Onsets, EveryContactIsWatched) {
  const Model model = prepare(test::shipped("two_catchers"));
  for (const std::size_t touching : {0, 1}) {
    SCOPED_TRACE(touching);
    const std::vector<Onset> onsets = onsets_at(model, touching);
    ASSERT_EQ(onsets.size(), 1U);
    EXPECT_NEAR(onsets[0].closing, 0.1, 1e-12);
    EXPECT_NEAR(onsets[0].touch, 11.1e-3, 1e-12);  // 10 um at 0.1 m/s
    EXPECT_NEAR(onsets[0].mujoco.impulse, 0.7, 1e-15);
    EXPECT_NEAR(onsets[0].mujoco.duration, 13.5e-3 - onsets[0].touch, 1e-12);
    EXPECT_NEAR(onsets[0].mujoco.rebound, 0.07, 1e-12);
  }
}

}  // namespace
}  // namespace rotorub
