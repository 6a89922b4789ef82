#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "native_model/contact/impact.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "tests/support/contact_residual.h"
#include "tests/support/oracles/planar_impact.h"

namespace rotorub {
namespace {

constexpr double kClosedForm = 1e-12;  // scaled residual of the closed form in double

ImpactResidual residual(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law,
                        const ImpactResult& r) {
  return impact_residual({g.nn, g.nt, g.tt, gap_rate, slip, r.normal_compression,
                          r.friction_compression, r.normal_expansion, r.friction_expansion,
                          law.friction.coefficient, law.restitution, law.tangential_restitution});
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

// With and without coupling of normal and tangential direction, all coefficients, mu up to 10, also
// for bodies that separate: the laws hold, and energy never grows.
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
      // Only a coupling beyond the friction cone may have no unique solution.
      ASSERT_GE(law.friction.coefficient * std::abs(nt), nn) << k;
      continue;
    }
    const ImpactResidual e = residual(g, gap_rate, slip, law, r);
    ASSERT_LT(e.compression, kClosedForm) << k;
    ASSERT_LT(e.expansion, kClosedForm) << k;
    ASSERT_LT(e.energy_gain, kClosedForm) << k;
  }
}

// ------------------------------------------------------------------

// All engines end an accumulation of impacts by the same rule.

TEST(Rebound, ClosingAccelerationIsFromTheLoadAndTheTurningOfTheNormal) {
  // On a circle of 2 m at 3 m/s the centre accelerates by 4.5 m/s^2.
  EXPECT_DOUBLE_EQ(closing_acceleration({1.0, 0.0}, {0.5, 3.0, 9.0}, {1.25, 7.0, 8.0}, 2.0),
                   1.25 + 4.5);
  EXPECT_DOUBLE_EQ(closing_acceleration({0.0, -1.0}, {3.0, 0.5, 9.0}, {7.0, -1.25, 8.0}, 2.0),
                   1.25 + 4.5);
}

TEST(Rebound, AFlightLastsTwiceItsSpeedOverTheClosingAcceleration) {
  EXPECT_TRUE(flight_outlives(0.99, 5.0, 10.0));
  EXPECT_FALSE(flight_outlives(1.0, 5.0, 10.0));
  EXPECT_TRUE(flight_outlives(1e9, 5.0, 0.0)) << "nothing closes the gap";
  EXPECT_TRUE(flight_outlives(1e9, 5.0, -1.0));
  EXPECT_FALSE(flight_outlives(1.0, 0.0, 1.0)) << "no rebound at all";
}

// Impacts that are not located: the speed that the fall within a step adds to each.
TEST(Rebound, AnImpactThatFeedsItselfHasNoFlight) {
  const double h = 1e-5, load = 10.0;
  EXPECT_FALSE(rebound_outlives_steps(h, 0.5, 1.9e-4, load)) << "a flight of less than two steps";
  EXPECT_TRUE(rebound_outlives_steps(h, 0.5, 2.1e-4, load));
  EXPECT_FALSE(rebound_outlives_steps(h, 0.9, 9e-4, load)) << "0.1 v under a h";
  EXPECT_TRUE(rebound_outlives_steps(h, 0.9, 1.1e-3, load));
  EXPECT_TRUE(rebound_outlives_steps(h, 0.999, 3e-3, load)) << "a flight of 60 steps";
  EXPECT_TRUE(rebound_outlives_steps(h, 1.0, 2.1e-4, load)) << "nothing is lost";
}

// bench_drop thrown sideways: a mass bounces to rest on a ring and slides on. However long the step
// and however elastic the blows, lasting contact begins where the accumulation ends, and no impact
// follows. (Impacts that are not located are of first order, and each gives the next one a little
// more speed.)
TEST(Rebound, AnAccumulationEndsInLastingContact) {
  struct Case {
    const char* integrator;
    const char* step;
    double late;  // of the time in contact
  };
  constexpr Case kCases[] = {{"verlet", "1e-4", 0.07},
                             {"verlet", "2e-5", 0.02},
                             {"euler", "1e-4", 0.12},
                             {"euler", "2e-5", 0.08},
                             {"euler", "5e-6", 0.06}};
  for (const char* restitution : {"0.1", "0.5", "0.6", "0.7", "0.8", "0.9"}) {
    const auto run = [&](const char* integrator, const char* step) {
      const std::vector<std::string> changes{"run.end=0.25",
                                             "initial.vx=[0.003]",
                                             "contact.friction=0.2",
                                             "rotor.speed=20.0",
                                             std::string("contact.restitution=") + restitution,
                                             std::string("run.integrator=\"") + integrator + "\"",
                                             std::string("run.step=") + step};
      return run_native(scene::read_scene(ROTORUB_MJCF_DIR "/bench_drop.toml", changes));
    };
    const Trajectory exact = run("event", "1e-5");
    for (const Case& c : kCases) {
      const Trajectory found = run(c.integrator, c.step);
      const std::string which = std::string(c.integrator) + " " + c.step + " eps " + restitution;
      EXPECT_LE(found.impacts.size(), exact.impacts.size()) << which;
      EXPECT_LT(found.impacts.back().t, exact.end - 0.85 * exact.statistics.contact_time) << which;
      EXPECT_NEAR(found.statistics.contact_time, exact.statistics.contact_time,
                  c.late * exact.statistics.contact_time)
          << which;
      EXPECT_NEAR(found.statistics.impulse_total, exact.statistics.impulse_total,
                  0.02 * exact.statistics.impulse_total)
          << which;
    }
  }
}

}  // namespace
}  // namespace rotorub
