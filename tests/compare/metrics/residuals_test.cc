#include "compare/metrics/residuals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/compare/hand_made.h"

namespace rotorub {
namespace {

using test::hand_made;
using test::Row;
using test::sliding;
using test::Whirl;

constexpr double kRoundOff = 1e-12;

const Whirl kWhirl;
const ContactFacts kFacts{kWhirl.clearance, kWhirl.radius, kWhirl.friction};

// A lawful series with one row changed.
Residuals with(const std::function<void(Row&)>& spoil) {
  return contact_residuals(hand_made(100, 1e-4,
                                     [&](double t) {
                                       Row row = sliding(kWhirl, t);
                                       if (t > 49.5e-4 && t < 50.5e-4) spoil(row);
                                       return row;
                                     }),
                           kFacts);
}

TEST(ContactResiduals, ALawfulSeriesHasNone) {
  const Residuals r = with([](Row&) {});
  EXPECT_DOUBLE_EQ(r.force_scale, kWhirl.normal);
  for (const double residual :
       {r.penetration, r.adhesion, r.complementarity, r.cone, r.sliding, r.power, r.gap_error}) {
    EXPECT_LE(residual, kRoundOff);
    EXPECT_GE(residual, 0.0);
  }
}

TEST(ContactResiduals, SeesPenetration) {
  const Residuals r = with([](Row& row) {
    row.x *= 1.1;
    row.y *= 1.1;
    row.gap = -0.1 * kWhirl.clearance;
  });
  EXPECT_NEAR(r.penetration, 0.1, kRoundOff);
  EXPECT_LE(r.gap_error, kRoundOff);
}

TEST(ContactResiduals, SeesAPull) {
  EXPECT_NEAR(with([](Row& row) { row.normal = -5.0; }).adhesion, 5.0 / kWhirl.normal, kRoundOff);
}

TEST(ContactResiduals, SeesForceWithoutTouch) {
  const Residuals r = with([](Row& row) {
    row.x *= 0.5;
    row.y *= 0.5;
  });
  EXPECT_NEAR(r.complementarity, 0.5, kRoundOff);
  EXPECT_NEAR(r.gap_error, 0.5, kRoundOff);  // the column says 0, the positions half the clearance
}

TEST(ContactResiduals, SeesFrictionBeyondTheCone) {
  EXPECT_NEAR(with([](Row& row) { row.friction *= 2.0; }).cone, kWhirl.friction, kRoundOff);
}

TEST(ContactResiduals, SeesSlidingWithTooLittleFriction) {
  const Residuals r = with([](Row& row) { row.friction *= 0.25; });
  EXPECT_NEAR(r.sliding, 0.75 * kWhirl.friction, kRoundOff);
  EXPECT_LE(r.cone, kRoundOff);
}

TEST(ContactResiduals, SeesFrictionThatDrives) {
  EXPECT_NEAR(with([](Row& row) { row.friction = -row.friction; }).power, kWhirl.friction,
              kRoundOff);
}

TEST(ContactResiduals, SlowSlipMayHaveAnyFrictionInTheCone) {
  const Residuals r = with([](Row& row) {
    row.slip = 1e-6;
    row.friction = 0.0;
  });
  EXPECT_LE(r.sliding, kRoundOff);
}

TEST(ContactResiduals, WithoutContactForcesAreScaledByOneNewton) {
  const Residuals r = contact_residuals(hand_made(3, 1.0,
                                                  [](double) {
                                                    Row row;
                                                    row.gap = kWhirl.clearance;
                                                    return row;
                                                  }),
                                        kFacts);
  EXPECT_EQ(r.force_scale, 1.0);
  EXPECT_EQ(r.penetration, 0.0);
  EXPECT_EQ(r.gap_error, 0.0);
}

}  // namespace
}  // namespace rotorub
