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

// A force beside an open gap is an impact's own where the impact takes time, and nobody's after it.
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

TEST(ContactResiduals, SeesPenetration) {
  const Residuals r = with([](Row& row) {
    row.x *= 1.1;
    row.y *= 1.1;
    row.gap = -0.1 * kRub.clearance;
  });
  EXPECT_NEAR(r.penetration, 0.1, kResidual);
  EXPECT_LE(r.gap_error, kResidual);
}

TEST(ContactResiduals, SeesAPull) {
  EXPECT_NEAR(with([](Row& row) { row.normal = -5.0; }).adhesion, 5.0 / kRub.normal, kResidual);
}

TEST(ContactResiduals, SeesForceWithoutTouch) {
  const Residuals r = with([](Row& row) {
    row.x *= 0.5;
    row.y *= 0.5;
  });
  EXPECT_NEAR(r.complementarity, 0.5, kResidual);
  EXPECT_NEAR(r.gap_error, 0.5, kResidual);  // the column says 0, the positions half the clearance
}

TEST(ContactResiduals, SeesFrictionBeyondTheCone) {
  EXPECT_NEAR(with([](Row& row) { row.friction *= 2.0; }).cone, kRub.friction, kResidual);
}

TEST(ContactResiduals, SeesSlidingWithTooLittleFriction) {
  const Residuals r = with([](Row& row) { row.friction *= 0.25; });
  EXPECT_NEAR(r.sliding, 0.75 * kRub.friction, kResidual);
  EXPECT_LE(r.cone, kResidual);
}

TEST(ContactResiduals, SeesFrictionThatDrives) {
  EXPECT_NEAR(with([](Row& row) { row.friction = -row.friction; }).power, kRub.friction, kResidual);
}

TEST(ContactResiduals, SlowSlipMayHaveAnyFrictionInTheCone) {
  const Residuals r = with([](Row& row) {
    row.slip = 1e-6;
    row.friction = 0.0;
  });
  EXPECT_LE(r.sliding, kResidual);
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
