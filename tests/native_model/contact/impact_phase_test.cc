// Works of a phase of an impact, against the kinetic energy that they leave behind.
#include "native_model/contact/impact_phase.h"

#include <gtest/gtest.h>

#include <vector>

#include "native_model/contact/kinematics.h"

namespace rotorub {
namespace {

constexpr double kLastDigit = 1e-15;

TEST(ImpactPhase, RatesAreThoseOfTheContactPoint) {
  const Eigen::Vector2d d{3e-4, -4e-4}, dv{0.2, 0.7};
  const ContactPoint p = contact_kinematics(d, dv, 30.0, 0.05, 6e-4);
  const Eigen::Vector2d rates = rates_along(p.e_r, 0.05, {dv.x(), dv.y(), 30.0});
  EXPECT_NEAR(rates.x(), p.gap_rate, kLastDigit);
  EXPECT_NEAR(rates.y(), p.slip, kLastDigit);
}

// Masses 2 and 3 under constant forces; a third coordinate has a rate and no load's work.
TEST(ImpactPhase, TheLoadsWorkIsWhatTheyMove) {
  const std::vector<double> force{4.0, -9.0}, acceleration{2.0, -3.0, 7.0}, from{0.3, -0.2, 1.0};
  const double tau = 0.1;
  std::vector<double> to(3);
  load_phase(tau, acceleration, from, to);
  EXPECT_NEAR(to[0], 0.5, kLastDigit);
  EXPECT_NEAR(to[1], -0.5, kLastDigit);
  EXPECT_NEAR(to[2], 1.7, kLastDigit);
  double work = 10.0;
  add_load_work(tau, force, from.data(), to.data(), work);
  const double gain = 0.5 * 2.0 * (0.25 - 0.09) + 0.5 * 3.0 * (0.25 - 0.04);
  EXPECT_NEAR(work, 10.0 + gain, 1e-14);
}

// A disc of 2 kg that a wall throws back: e_r = (1, 0), the impulse -x and along y.
TEST(ImpactPhase, AnImpulsesWorkIsItsEnergy) {
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
