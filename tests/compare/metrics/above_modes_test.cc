// Whirl faster than the kept modes: made-up trajectories of known shares, and a whip on a shaft.
#include "compare/metrics/above_modes.h"

#include <gtest/gtest.h>

#include "native_model/run/run_native.h"
#include "tests/compare/hand_made.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::hand_made;

constexpr ModeBand kBand{.forward = 500.0, .backward = 400.0};

// Lasting contact; slow until `switch_time`, then at `fast` rad/s.
Trajectory rub(double switch_time, double fast) {
  return hand_made(1001, 1e-3, [=](double t) {
    return test::sliding({.frequency = t < switch_time ? 300.0 : fast}, t);
  });
}

TEST(AboveModes, SharesOfTimeAndWork) {
  const AboveModes above = above_modes(rub(0.7505, -600.0), kBand);
  EXPECT_NEAR(above.contact_share, 0.25, 1e-3);
  // Slip r Omega + v_t at equal force: 15 + 0.15 m/s for three quarters, 15 - 0.3 m/s for one.
  const double slow = 0.75 * 15.15, fast = 0.25 * 14.7;
  EXPECT_NEAR(above.friction_share, fast / (fast + slow), 1e-3);
  EXPECT_NEAR(above.fastest, -600.0, 1e-9);
  EXPECT_TRUE(above.matters());
}

TEST(AboveModes, EachSenseHasItsOwnLimit) {
  EXPECT_EQ(above_modes(rub(0.5, 450.0), kBand).contact_share, 0.0);
  EXPECT_NEAR(above_modes(rub(0.5, -450.0), kBand).contact_share, 0.5, 1e-3);
  EXPECT_FALSE(above_modes(rub(2.0, 0.0), kBand).matters());
}

TEST(AboveModes, FlightDoesNotCount) {
  const Trajectory t = hand_made(1001, 1e-3, [](double time) {
    test::Row row = test::sliding({.frequency = time < 0.5 ? 300.0 : 900.0}, time);
    if (time >= 0.5) row.normal = row.friction = 0.0;
    return row;
  });
  EXPECT_EQ(above_modes(t, kBand).contact_share, 0.0);
  EXPECT_NEAR(above_modes(t, kBand).fastest, 300.0, 1e-9);
}

TEST(AboveModes, ImpactsBringTheirFrictionWork) {
  Trajectory t = rub(0.5, -600.0);
  for (Column& column : t.series) {  // nothing but impacts: 3 J slow, 1 J fast
    if (column.name == "normal_force") column.values.assign(column.values.size(), 0.0);
  }
  const auto impact = [](double time, double work) {
    Impact i;
    i.t = time;
    i.friction_impulse = -work;
    i.slip_before = 1.2;
    i.slip_after = 0.8;
    return i;
  };
  t.impacts = {impact(0.2503, 3.0), impact(0.7503, 1.0)};
  const AboveModes above = above_modes(t, kBand);
  EXPECT_NEAR(above.friction_share, 0.25, 1e-12);
  EXPECT_EQ(above.contact_share, 0.0);
}

TEST(AboveModes, IsEmptyWithoutContact) {
  const AboveModes none = above_modes(hand_made(3, 0.1, [](double) { return test::Row{}; }), kBand);
  EXPECT_EQ(none.contact_share, 0.0);
  EXPECT_EQ(none.friction_share, 0.0);
  EXPECT_EQ(none.fastest, 0.0);
}

TEST(AboveModes, IsEmptyForModalData) {
  EXPECT_FALSE(mode_band(test::shipped("bench_whip")).has_value());
}

// A shaft of nearly no mass: eigenvalues that cannot be computed are refused at the shaft's place
// in the scene.
TEST(AboveModes, RefusesAShaftThatCannotBeSolved) {
  const auto refused =
      test::refusals([] { mode_band(test::shipped("paper_sliding", {"rotor.rho=1e-9"})); });
  ASSERT_FALSE(refused.empty()) << "solved";
  EXPECT_EQ(refused.front().key, "rotor");
  EXPECT_NE(refused.front().reason.find("too many orders of magnitude apart"), std::string::npos);
}

// A shaft with one mode in a stiff ring, thrown into backward whirl: friction drives it beyond the
// mode. With eight modes the same whirl is within them.
TEST(AboveModes, AWhipOutrunsTheOneModeOfItsShaft) {
  const auto share = [](int modes) {
    scene::Scene s = test::shipped(
        "paper_passive",
        {"rotor.modes=" + std::to_string(modes), "force=none", "rotor.disc[0].eccentricity=0",
         "contact.friction=0.6", "contact.restitution=0", "stator.stiffness=1e7", "run.end=0.05"});
    for (auto* list : {&s.initial.x, &s.initial.vx, &s.initial.vy}) {
      list->assign(static_cast<std::size_t>(modes), 0.0);
    }
    s.initial.x[0] = 4.9e-4;
    s.initial.vx[0] = 0.5;
    s.initial.vy[0] = -0.8;
    const Trajectory t = run_native(s);
    EXPECT_EQ(t.status, Status::kOk) << t.message;
    return above_modes(s, t).value();
  };
  const AboveModes one = share(1);
  EXPECT_LT(one.fastest, -one.band.backward) << "backward";
  EXPECT_GT(one.contact_share, 0.5);
  EXPECT_LT(share(8).contact_share, 0.1);
}

}  // namespace
}  // namespace rotorub
