#include "compare/metrics/attractor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

using test::hand_made;
using test::Row;
using test::sliding;
using test::Whirl;

Settled of(const Whirl& w) {
  return settled(hand_made(1000, 1e-3, [&](double t) { return sliding(w, t); }));
}

TEST(Attractor, SynchronousRub) {
  const Settled s = of({});
  EXPECT_EQ(s.attractor, Attractor::kSynchronousRub);
  EXPECT_EQ(s.contact_share, 1.0);
  EXPECT_NEAR(s.whirl_frequency, 300.0, 1e-6);
  EXPECT_NEAR(s.spin_speed, 300.0, 1e-9);
}

TEST(Attractor, ForwardButNotSynchronous) {
  Whirl w;
  w.frequency = 200.0;
  EXPECT_EQ(of(w).attractor, Attractor::kForwardRub);
}

// Forward is with the spin, whichever way that turns.
TEST(Attractor, OfTheMirrorImageIsTheSame) {
  for (const double frequency : {300.0, 200.0, -1000.0}) {
    Whirl w;
    w.frequency = frequency;
    const Attractor here = of(w).attractor;
    w.frequency = -frequency;
    w.spin_speed = -w.spin_speed;
    EXPECT_EQ(of(w).attractor, here) << frequency;
  }
}

TEST(Attractor, BackwardWhip) {
  Whirl w;
  w.frequency = -1000.0;
  const Settled s = of(w);
  EXPECT_EQ(s.attractor, Attractor::kBackwardWhip);
  EXPECT_NEAR(s.whirl_frequency, -1000.0, 1e-6);
}

// Rolling: psi' delta_0 = -Omega r, so that the slip is 0.
TEST(Attractor, Rolling) {
  Whirl w;
  w.frequency = -w.spin_speed * w.radius / w.clearance;
  EXPECT_EQ(of(w).attractor, Attractor::kRolling);
}

// A rotor that lies on the ring, spinning or not, is no rub that whirls.
TEST(Attractor, Resting) {
  for (const double spin : {0.0, 300.0}) {
    Whirl w;
    w.frequency = 0.0;
    w.spin_speed = spin;
    EXPECT_EQ(of(w).attractor, Attractor::kResting);
  }
}

TEST(Attractor, Chattering) {
  const Whirl w;
  const auto half = hand_made(1000, 1e-3, [&](double t) {
    Row row = sliding(w, t);
    if (static_cast<int>(std::lround(t / 1e-3)) % 2 == 0) row.normal = 0.0;
    return row;
  });
  EXPECT_EQ(settled(half).attractor, Attractor::kChattering);
  EXPECT_NEAR(settled(half).contact_share, 0.5, 0.01);
}

TEST(Attractor, ImpactsAloneAreChatteringToo) {
  Trajectory t = hand_made(1000, 1e-3, [](double) { return Row{}; });
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
  Impact impact;
  impact.t = 0.9;
  impact.gap_rate_before = -0.1;
  t.impacts.push_back(impact);
  EXPECT_EQ(settled(t).attractor, Attractor::kChattering);
  // One that happened before the last fifth does not count, nor does a touch.
  t.impacts[0].t = 0.5;
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
  t.impacts[0] = {0.9, 0.0, 0.0, -1e-6, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
}

TEST(Attractor, TooFewRowsAreUnknown) {
  EXPECT_EQ(settled(hand_made(10, 1e-3, [](double) { return Row{}; })).attractor,
            Attractor::kUnknown);
}

}  // namespace
}  // namespace rotorub
