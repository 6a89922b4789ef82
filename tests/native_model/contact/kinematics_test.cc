// Rates of a contact, and the work of an impulse on them.
#include "native_model/contact/kinematics.h"

#include <gtest/gtest.h>

#include "native_model/contact/impact_record.h"

namespace rotorub {
namespace {

constexpr double kLastDigit = 1e-15;

TEST(ContactKinematics, RatesAreThoseOfTheContactPoint) {
  const Eigen::Vector2d d{3e-4, -4e-4}, dv{0.2, 0.7};
  const ContactPoint p = contact_kinematics(d, dv, 30.0, 0.05, 6e-4);
  const Eigen::Vector2d rates = rates_along(p.e_r, 0.05, {dv.x(), dv.y(), 30.0});
  EXPECT_NEAR(rates.x(), p.gap_rate, kLastDigit);
  EXPECT_NEAR(rates.y(), p.slip, kLastDigit);
}

// A disc of 2 kg that a wall throws back: e_r = (1, 0), the impulse -x and along y.
TEST(ContactKinematics, AnImpulsesWorkIsItsEnergy) {
  const Eigen::Vector2d e_r{1.0, 0.0}, before{0.4, 0.3};
  const double mass = 2.0, normal = 1.2, friction = -0.25;
  const Eigen::Vector2d after = before + Eigen::Vector2d(-normal, friction) / mass;
  const auto rates = [&](const Eigen::Vector2d& v) {
    return rates_along(e_r, 0.0, {v.x(), v.y(), 0.0});
  };
  const ImpulseWork work = impulse_work(normal, friction, rates(before), rates(after));
  EXPECT_NEAR(work.total(), 0.5 * mass * (after.squaredNorm() - before.squaredNorm()), kLastDigit);
  EXPECT_NEAR(work.friction, 0.5 * mass * (after.y() * after.y() - before.y() * before.y()),
              kLastDigit);
  EXPECT_LT(work.friction, 0.0) << "friction brakes";
}

}  // namespace
}  // namespace rotorub
