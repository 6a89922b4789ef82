#include "compare/metrics/residuals.h"

#include <gtest/gtest.h>

#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

using test::hand_made;
using test::Row;
using test::sliding;
using test::Whirl;

constexpr double kResidual = 1e-12;

const Whirl kRub;
const ContactFacts kRubFacts{kRub.clearance, kRub.radius, kRub.friction};

// A lawful series with one row changed.
Residuals with(const std::function<void(Row&)>& spoil) {
  return contact_residuals(hand_made(100, 1e-4,
                                     [&](double t) {
                                       Row row = sliding(kRub, t);
                                       if (t > 49.5e-4 && t < 50.5e-4) spoil(row);
                                       return row;
                                     }),
                           kRubFacts);
}

TEST(ContactResiduals, ALawfulSeriesHasNone) {
  const Residuals r = with([](Row&) {});
  EXPECT_DOUBLE_EQ(r.force_scale, kRub.normal);
  for (const double residual :
       {r.penetration, r.adhesion, r.complementarity, r.cone, r.sliding, r.power, r.gap_error}) {
    EXPECT_LE(residual, kResidual);
    EXPECT_GE(residual, 0.0);
  }
}

// A force beside an open gap belongs to an impact that takes time, and is a fault after it.
TEST(ContactResiduals, AnImpactThatTakesTimeHasItsOwnLaw) {
  Trajectory t = hand_made(100, 1e-4, [](double time) {
    Row row = sliding(kRub, time);
    if (time < 19.5e-4 || time > 21.5e-4) return row;
    row.x *= 0.9;
    row.y *= 0.9;
    row.gap = 0.1 * kRub.clearance;
    return row;
  });
  t.impacts.push_back({.t = 19.5e-4});
  ContactFacts facts = kRubFacts;
  EXPECT_NEAR(contact_residuals(t, facts).complementarity, 0.1, 1e-3);
  facts.impact_time = 2e-4;
  EXPECT_LE(contact_residuals(t, facts).complementarity, kResidual);
  facts.impact_time = 1e-4;
  EXPECT_NEAR(contact_residuals(t, facts).complementarity, 0.1, 1e-3);
}

// The position counts, at a share of the clearance from the ring's centre, not the column `gap`.
void move_to(double share, Row& row) {
  row.x *= share;
  row.y *= share;
}

// One fault has one residual: 5 N of pull, friction twice as large, a quarter of it, or one that
// drives. Slow slip may have any friction in the cone.
TEST(ContactResiduals, EachFaultHasItsOwn) {
  struct Fault {
    double Residuals::*seen;
    double size;
    void (*spoil)(Row&);
  };
  const auto inside = [](Row& row) { move_to(0.5, row); };
  const auto outside = [](Row& row) {
    move_to(1.1, row);
    row.gap = -0.1 * kRub.clearance;
  };
  const double mu = kRub.friction;
  for (const Fault& fault :
       {Fault{&Residuals::adhesion, 5.0 / kRub.normal, [](Row& row) { row.normal = -5.0; }},
        Fault{&Residuals::cone, mu, [](Row& row) { row.friction *= 2.0; }},
        Fault{&Residuals::cone, 0.0, [](Row& row) { row.friction *= 0.25; }},
        Fault{&Residuals::sliding, 0.75 * mu, [](Row& row) { row.friction *= 0.25; }},
        Fault{&Residuals::sliding, 0.0, [](Row& row) { row.slip = 1e-6, row.friction = 0.0; }},
        Fault{&Residuals::power, mu, [](Row& row) { row.friction = -row.friction; }},
        Fault{&Residuals::penetration, 0.1, outside}, Fault{&Residuals::gap_error, 0.0, outside},
        Fault{&Residuals::complementarity, 0.5, inside},
        Fault{&Residuals::gap_error, 0.5, inside}}) {
    EXPECT_NEAR(with(fault.spoil).*fault.seen, fault.size, kResidual);
  }
}

TEST(ContactResiduals, WithoutContactForcesAreScaledByOneNewton) {
  const Residuals r = contact_residuals(hand_made(3, 1.0,
                                                  [](double) {
                                                    Row row;
                                                    row.gap = kRub.clearance;
                                                    return row;
                                                  }),
                                        kRubFacts);
  EXPECT_EQ(r.force_scale, 1.0);
  EXPECT_EQ(r.penetration, 0.0);
  EXPECT_EQ(r.gap_error, 0.0);
}

}  // namespace
}  // namespace rotorub
