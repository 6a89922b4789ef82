// The friction law, and the sets that the solvers derive from it.
#include "native_model/contact/friction.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/impact.h"
#include "native_model/contact/planar_contact.h"

namespace rotorub {
namespace {

// The law of a bearing of bronze, say: falls within 0.1 m/s, and grows by a hundredth a m/s.
FrictionLaw falling(double viscous = 0.01) {
  FrictionLaw law = 0.15;
  law.excess = 0.15;
  law.stribeck_speed = 0.1;
  law.viscous = viscous;
  return law;
}

TEST(Friction, FallsFromStaticToKineticAndGrowsWithTheSlip) {
  const FrictionLaw law = falling();
  EXPECT_EQ(law.sticking(), 0.3);
  EXPECT_EQ(law.at(0.0), 0.3);
  EXPECT_DOUBLE_EQ(law.at(0.1), 0.15 + 0.15 * std::exp(-1.0) + 0.001);
  EXPECT_DOUBLE_EQ(law.at(-0.1), law.at(0.1));
  EXPECT_DOUBLE_EQ(law.at(8.0), 0.23);
  EXPECT_FALSE(law.is_constant());
  EXPECT_FALSE(law.is_frictionless());
  EXPECT_THROW(law.constant("a cone"), std::invalid_argument);
  for (const double slip : {0.03, 0.1, -0.2, 1.0}) {
    constexpr double d = 1e-6;
    const double v = std::abs(slip);
    EXPECT_NEAR(law.slope(slip), (law.at(v + d) - law.at(v - d)) / (2.0 * d), 1e-8) << slip;
    EXPECT_GE(law.bound(slip), law.at(slip));
  }
  // Beyond the end of sliding it continues smoothly.
  EXPECT_NEAR(law.along(1e-3) + law.along(-1e-3), 2.0 * law.along(0.0), 1e-4);
}

// Viscous friction alone, dT = -c v dL: v = v_0 exp(-c G_TT L) at the end of each phase.
TEST(FallingFriction, ViscousImpactIsTheClosedForm) {
  const Delassus g{0.5, 0.0, 0.0, 1.75};
  for (const double c : {1e-3, 0.1, 10.0, 1e9}) {  // however stiff
    FrictionLaw law{};
    law.viscous = c;
    const double before = 3.0, closing = 0.4, restitution = 0.6;
    const ImpactResult r = solve_impact(g, -closing, before, {law, restitution, 0.0});
    ASSERT_EQ(r.status, Status::kOk);
    const double normal = closing / g.nn;
    EXPECT_NEAR(r.slip_compression, before * std::exp(-c * g.tt * normal), 3e-14 * before) << c;
    EXPECT_NEAR(r.slip, before * std::exp(-c * g.tt * (1.0 + restitution) * normal), 3e-14 * before)
        << c;
  }
}

// The impulse of friction during a normal impulse, dT/dL = -mu(|v|) sign(v), dv/dL = c + g_TT
// dT/dL, by many small steps.
double rubbed(const FrictionLaw& law, double slip, double drift, double mobility, double normal) {
  constexpr int kSteps = 4000;
  const double h = normal / kSteps, sign = slip > 0.0 ? 1.0 : -1.0;
  const auto rate = [&](double v) { return drift - sign * law.along(sign * v) * mobility; };
  double v = slip, sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const double a = rate(v), b = rate(v + 0.5 * h * a), c = rate(v + 0.5 * h * b),
                 d = rate(v + h * c), moved = h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    sum += (moved - drift * h) / mobility;
    v += moved;
  }
  return sum;
}

// The friction of each phase is that of its slips.
TEST(FallingFriction, ImpactsFollowTheirSlip) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int slides = 0, sticks = 0;
  for (int k = 0; k < 600; ++k) {
    const double nn = 0.2 + unit(random), tt = 0.2 + 3.0 * unit(random);
    const double nt = 0.3 * (unit(random) - 0.5) * std::sqrt(nn * tt);
    FrictionLaw law = 0.4 * unit(random);
    law.excess = 0.3 * unit(random);
    law.stribeck_speed = 0.05 + unit(random);
    law.viscous = k % 3 == 0 ? 0.0 : 0.2 * unit(random);
    const double before = 4.0 * (unit(random) - 0.5);
    const ImpactResult r =
        solve_impact({nn, nt, nt, tt}, -unit(random), before, {law, unit(random), 0.0});
    if (r.status != Status::kOk) continue;
    if (r.slip_compression == 0.0) {
      ++sticks;
      EXPECT_NEAR(r.friction_compression, -(before + nt * r.normal_compression) / tt, 1e-12);
    } else if (r.slip_compression * before > 0.0) {
      ++slides;
      EXPECT_NEAR(r.friction_compression, rubbed(law, before, nt, tt, r.normal_compression), 1e-10)
          << k;
      if (r.slip * before <= 0.0) continue;
      EXPECT_NEAR(r.friction_expansion, rubbed(law, r.slip_compression, nt, tt, r.normal_expansion),
                  1e-10)
          << k;
    }
  }
  EXPECT_GT(slides, 200);
  EXPECT_GT(sticks, 40);
}

// Where friction falls steeply, the same impact may end in sliding or sticking: the first slip that
// it reaches from its start counts.
TEST(FallingFriction, OfSeveralSlipsTheOneNextToTheBeginning) {
  const Delassus g{1.0, 0.0, 0.0, 1.0};
  FrictionLaw law = 0.1;
  law.excess = 0.5;
  law.stribeck_speed = 0.05;
  const double normal = 1.0, slip = 0.4;
  const CoulombSolution fast = solve_coulomb(g, -normal, slip, law, slip);
  EXPECT_EQ(fast.contact_case, ContactCase::kSlidePositive);
  EXPECT_NEAR(fast.friction, -law.at(slip + fast.friction), 1e-14);
  EXPECT_GT(slip + fast.friction, 4.0 * law.stribeck_speed);
  const CoulombSolution held = solve_coulomb(g, -normal, slip, law, 0.0);
  EXPECT_EQ(held.contact_case, ContactCase::kStick);
  EXPECT_NEAR(held.friction, -slip, 1e-15);
}

// Two contacts of one body, and friction with two directions.
TEST(FallingFriction, SeveralContactsEachHaveTheMuOfTheirSlip) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  int met = 0;
  for (int k = 0; k < 500; ++k) {
    const Eigen::Index rows = k % 2 == 0 ? 2 : 3, n = 2 * rows;
    Eigen::MatrixXd w(2 * n, n);
    for (double& x : w.reshaped()) x = normal(random);
    const ContactMatrix a = w.transpose() * w;
    ContactVector b(n);
    for (double& x : b) x = normal(random);
    b[0] -= 1.0;
    b[rows] -= 1.0;
    const std::vector<ImpactLaw> laws{{falling(0.02), 0.3, 0.0}, {falling(0.0), 0.5, 0.0}};
    const CoupledSolution s = solve_coupled_coulomb(a, b, laws);
    if (s.solutions != 1) continue;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const double pressed = s.p[i * rows];
      if (!(pressed > 0.0)) continue;
      const FrictionLaw& law = laws[static_cast<std::size_t>(i)].friction;
      const double slip = s.y.segment(i * rows + 1, rows - 1).norm();
      const double friction = s.p.segment(i * rows + 1, rows - 1).norm();
      if (slip > 1e-9) {
        ++met;
        // The slip is between the first and the last.
        const double first = b.segment(i * rows + 1, rows - 1).norm();
        EXPECT_LE(friction, law.bound(std::max(first, slip)) * pressed + 1e-11 * s.p.norm()) << k;
        EXPECT_GE(friction, law.coefficient * pressed - 1e-11 * s.p.norm()) << k;
      } else {
        EXPECT_LE(friction, law.sticking() * pressed + 1e-11 * s.p.norm()) << k;
      }
    }
  }
  EXPECT_GT(met, 200);
}

}  // namespace
}  // namespace rotorub
