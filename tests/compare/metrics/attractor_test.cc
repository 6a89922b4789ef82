#include "compare/metrics/attractor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

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

// Rolling: psi' delta_0 = -Omega r, so that the slip is 0. A rotor that lies on the ring, spinning
// or not, is no rub that whirls.
TEST(Attractor, IsNamedByTheWhirlOfAPermanentContact) {
  const Whirl w;
  const double rolls = -w.spin_speed * w.radius / w.clearance;
  for (const auto& [frequency, spin, name] :
       {std::tuple(300.0, 300.0, Attractor::kSynchronousRub),
        std::tuple(200.0, 300.0, Attractor::kForwardRub),
        std::tuple(-1000.0, 300.0, Attractor::kBackwardWhip),
        std::tuple(rolls, w.spin_speed, Attractor::kRolling),
        std::tuple(0.0, 300.0, Attractor::kResting), std::tuple(0.0, 0.0, Attractor::kResting)}) {
    // Forward is with the spin, whichever way that turns: the mirror image is the same.
    for (const double sign : {1.0, -1.0}) {
      const Settled s = of({.frequency = sign * frequency, .spin_speed = sign * spin});
      EXPECT_EQ(s.attractor, name) << frequency;
      EXPECT_EQ(s.contact_share, 1.0);
      EXPECT_NEAR(s.whirl_frequency, sign * frequency, 1e-6 * (1.0 + std::abs(frequency) / 1e3));
      EXPECT_NEAR(s.spin_speed, sign * spin, 1e-9);
    }
  }
}

// A rotor that rocks about its lowest place is at rest there, whenever the run ends: its mean whirl
// depends on the swing.
TEST(Attractor, RestsWhereItRocks) {
  for (const double end : {0.83, 0.91, 1.0, 1.04}) {
    const Whirl w;
    const Settled s = settled(hand_made(1000, end / 1000.0, [&](double t) {
      constexpr double kSwing = 0.4, kRate = 40.0;  // rad, rad/s
      const double angle = kSwing * std::sin(kRate * t),
                   rate = kSwing * kRate * std::cos(kRate * t);
      Row row = sliding(w, 0.0);
      row.x = w.clearance * std::cos(angle);
      row.y = w.clearance * std::sin(angle);
      row.vx = -row.y * rate;
      row.vy = row.x * rate;
      row.slip = w.radius * w.spin_speed + w.clearance * rate;
      return row;
    }));
    EXPECT_EQ(s.attractor, Attractor::kResting) << end;
    EXPECT_NE(s.whirl_frequency, 0.0);
  }
}

TEST(Attractor, BouncesWhereContactComesAndGoes) {
  const Whirl w;
  const auto half = hand_made(1000, 1e-3, [&](double t) {
    Row row = sliding(w, t);
    if (static_cast<int>(std::lround(t / 1e-3)) % 2 == 0) row.normal = 0.0;
    return row;
  });
  EXPECT_EQ(settled(half).attractor, Attractor::kBouncing);
  EXPECT_NEAR(settled(half).contact_share, 0.5, 0.01);
}

TEST(Attractor, ImpactsAloneAreBouncesToo) {
  Trajectory t = hand_made(1000, 1e-3, [](double) { return Row{}; });
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
  Impact impact;
  impact.t = 0.9;
  impact.gap_rate_before = -0.1;
  t.impacts.push_back(impact);
  EXPECT_EQ(settled(t).attractor, Attractor::kBouncing);
  // An impact or a touch before the last fifth does not count.
  t.impacts[0].t = 0.5;
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
  t.impacts[0] = {0.9, 0.0, 0.0, -1e-6, 0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
}

// A rub that has ended does not count; a bouncing rotor that is in flight at the end does.
TEST(Attractor, IgnoresContactThatHasEnded) {
  const Whirl w;
  const auto until = [&](double last) {
    return settled(hand_made(1000, 1e-3, [&](double t) {
      Row row = sliding(w, t);
      if (t > last) row.normal = 0.0;
      return row;
    }));
  };
  EXPECT_EQ(until(0.85).attractor, Attractor::kNoContact);
  EXPECT_EQ(until(0.95).attractor, Attractor::kBouncing);
  Trajectory t = hand_made(1000, 1e-3, [](double) { return Row{}; });
  const auto strike = [](double at) {
    Impact impact;
    impact.t = at;
    impact.gap_rate_before = -0.1;
    return impact;
  };
  t.impacts = {strike(0.83), strike(0.85)};
  EXPECT_EQ(settled(t).attractor, Attractor::kNoContact);
  t.impacts = {strike(0.81), strike(0.88)};
  EXPECT_EQ(settled(t).attractor, Attractor::kBouncing);
}

// On a ring that turns along a synchronous rub has no slip: it is a synchronous rub.
TEST(Attractor, RollingIsBackward) {
  for (const double sign : {1.0, -1.0}) {
    const Whirl w{.frequency = sign * 300.0, .spin_speed = sign * 300.0};
    const Settled s = settled(hand_made(1000, 1e-3, [&](double t) {
      Row row = sliding(w, t);
      row.slip = 0.0;
      row.friction = 0.0;
      return row;
    }));
    EXPECT_EQ(s.attractor, Attractor::kSynchronousRub);
  }
}

// An orbit that is longer than it is wide, in rows of many turns each: its rate at two rows does
// not tell how often it went round between them.
TEST(Attractor, HasNoWhirlIfRowsAreTooFarApart) {
  const auto of = [](double spacing) {
    return settled(hand_made(1000, spacing, [](double t) {
      constexpr double kRate = 1204.0;
      Row row = sliding({.frequency = kRate, .spin_speed = kRate}, t);
      row.x *= 1.5;
      row.vx *= 1.5;
      return row;
    }));
  };
  const Settled fine = of(1e-3), coarse = of(0.0613);
  EXPECT_EQ(fine.attractor, Attractor::kSynchronousRub);
  EXPECT_NEAR(fine.whirl_frequency, 1204.0, 5.0);
  EXPECT_EQ(coarse.attractor, Attractor::kUnknown);
  EXPECT_TRUE(std::isnan(coarse.whirl_frequency));
  EXPECT_NEAR(coarse.spin_speed, 1204.0, 1e-6);
}

// Too few rows: the whirl is unknown, which is not 0; the angle gives the spin.
TEST(Attractor, IsUnknownWithFewRows) {
  const Settled s = settled(hand_made(50, 1e-3, [](double t) { return sliding({}, t); }));
  EXPECT_EQ(s.attractor, Attractor::kUnknown);
  EXPECT_TRUE(std::isnan(s.whirl_frequency));
  EXPECT_TRUE(std::isnan(s.contact_share));
  EXPECT_NEAR(s.spin_speed, 300.0, 1e-9);
}

}  // namespace
}  // namespace rotorub
