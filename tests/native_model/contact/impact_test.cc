#include "native_model/contact/impact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "native_model/contact/impact_map.h"
#include "native_model/contact/residual.h"
#include "native_model/oracles/planar_impact.h"

namespace rotorub {
namespace {

constexpr double kClosedForm = 1e-12;  // scaled residual of the closed form in double

ImpactResidual residual(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law,
                        const ImpactResult& r) {
  return impact_residual({g.nn, g.nt, g.tt, gap_rate, slip, r.normal_compression,
                          r.friction_compression, r.normal_expansion, r.friction_expansion,
                          law.friction.coefficient, law.restitution, law.tangential_restitution});
}

TEST(Impact, StickByHand) {
  // G = diag(1, 2): compression takes L_NC = 1, L_TC = -0.1 and expansion half of each (eps_T = 1).
  const ImpactResult r = solve_impact({1.0, 0.0, 0.0, 2.0}, -1.0, 0.2, {0.5, 0.5, 1.0});
  EXPECT_DOUBLE_EQ(r.normal_compression, 1.0);
  EXPECT_DOUBLE_EQ(r.friction_compression, -0.1);
  EXPECT_DOUBLE_EQ(r.gap_rate, 0.5);
  EXPECT_DOUBLE_EQ(r.slip, -0.1);
}

TEST(Impact, PlanarOracleSweep) {
  for (const double mu : {0.0, 0.1, 0.3, 1.0, 10.0}) {
    for (const double eps_n : {0.0, 0.3, 1.0}) {
      for (const double slip : {-7.0, -0.3, 0.0, 0.01, 2.0, 40.0}) {
        for (const double eps_t : {0.0, 0.4, 1.0}) {
          const oracle::PlanarImpact exact{0.5, 3.0, mu, eps_n, eps_t};
          if (!exact.sticks(-0.8, slip) && eps_t != 0.0) continue;
          const ImpactResult r = solve_impact({0.5, 0.0, 0.0, 3.0}, -0.8, slip, {mu, eps_n, eps_t});
          ASSERT_EQ(r.status, Status::kOk);
          EXPECT_NEAR(r.gap_rate, exact.normal_after(-0.8), kClosedForm);
          EXPECT_NEAR(r.slip, exact.slip_after(-0.8, slip), kClosedForm * 40.0)
              << "mu " << mu << " eps_N " << eps_n << " eps_T " << eps_t << " slip " << slip;
        }
      }
    }
  }
}

// With and without coupling of normal and tangential direction, all coefficients, mu to 10, also
// for bodies that do not close: the laws hold, energy never grows.
TEST(Impact, RandomImpactsSatisfyTheLawsAndDissipate) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto symmetric = [&] { return 2.0 * unit(random) - 1.0; };
  for (int k = 0; k < 40000; ++k) {
    const double nn = std::pow(10.0, 2.0 * symmetric()), tt = std::pow(10.0, 2.0 * symmetric());
    const double nt = k % 2 == 0 ? 0.0 : 0.999 * symmetric() * std::sqrt(nn * tt);
    const ImpactLaw law{10.0 * unit(random) * unit(random), unit(random), unit(random)};
    const double gap_rate = symmetric(), slip = 3.0 * symmetric() * std::sqrt(tt / nn);
    const Delassus g{nn, nt, nt, tt};
    const ImpactResult r = solve_impact(g, gap_rate, slip, law);
    if (r.status != Status::kOk) {
      // Only a coupling beyond the friction cone can do without a single solution.
      ASSERT_GE(law.friction.coefficient * std::abs(nt), nn) << k;
      continue;
    }
    const ImpactResidual e = residual(g, gap_rate, slip, law, r);
    ASSERT_LT(e.compression, kClosedForm) << k;
    ASSERT_LT(e.expansion, kClosedForm) << k;
    ASSERT_LT(e.energy_gain, kClosedForm) << k;
  }
}

TEST(Impact, ResidualSeesAWrongImpulse) {
  const Delassus g{1.0, 0.0, 0.0, 2.0};
  const ImpactLaw law{0.3, 0.5, 0.0};
  ImpactResult r = solve_impact(g, -1.0, 5.0, law);
  ASSERT_LT(residual(g, -1.0, 5.0, law, r).expansion, kClosedForm);
  r.normal_expansion *= 1.001;
  EXPECT_GT(residual(g, -1.0, 5.0, law, r).expansion, 1e-5);
  r = solve_impact(g, -1.0, 5.0, law);
  r.friction_compression = -r.friction_compression;  // pushes along the slip
  EXPECT_GT(residual(g, -1.0, 5.0, law, r).compression, 0.1);
}

TEST(ImpactMap, FiniteTimesFadeToTheClassicalLaw) {
  ImpactInput in;
  in.admittance = Eigen::Vector3d(1.2, 0.9, 50.0).asDiagonal();
  in.e_r = Eigen::Vector2d(0.6, 0.8);
  in.radius = 0.02;
  in.delta = 0.5e-3;
  in.velocity = {0.3, 0.4, 100.0};
  in.acceleration = {5.0, -3.0, 0.0};
  const ImpactLaw law{0.2, 0.5, 0.3};
  const ImpactResult classical = solve_impact(in, law);
  double last = 1.0;
  for (const double tau : {1e-5, 1e-6, 1e-7}) {
    in.compression_time = in.expansion_time = tau;
    const ImpactResult r = solve_impact(in, law);
    const double difference = std::abs(r.normal() - classical.normal());
    EXPECT_GT(difference, 0.0);
    EXPECT_LT(difference, 0.2 * last);
    last = difference;
  }
}

}  // namespace
}  // namespace rotorub
