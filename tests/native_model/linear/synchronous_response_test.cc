// The Bode plot of a rotor with one mode has a closed form.
#include "native_model/linear/synchronous_response.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "native_model/linear/steady_orbit.h"
#include "tests/support/jeffcott.h"
#include "tests/support/oracles/shafts.h"

namespace rotorub {
namespace {

using Phasor = std::complex<double>;
constexpr double kMass = 2.0, kOmega = 200.0, kEccentricity = 30e-6;

scene::Scene unbalanced(double zeta, double phase = 0.0) {
  scene::Scene s = test::make_scene({.mass = kMass,
                                     .damping = 2.0 * zeta * kMass * kOmega,
                                     .stiffness = kMass * kOmega * kOmega,
                                     .speed = 150.0});
  scene::Force f;
  f.kind = scene::ForceKind::kUnbalance;
  f.static_moment = kMass * kEccentricity;
  f.phase = phase;
  s.forces.push_back(f);
  return s;
}

Phasor closed_form(double speed, double zeta) {
  const double r = speed / kOmega;
  return kEccentricity * r * r / Phasor(1.0 - r * r, 2.0 * zeta * r);
}

TEST(SynchronousResponse, IsThatOfOneMode) {
  constexpr double kZeta = 0.02;
  const auto response = synchronous_response(unbalanced(kZeta), 2.0 * kOmega);
  ASSERT_TRUE(response);
  EXPECT_FALSE(response->forces);
  EXPECT_TRUE(response->same_planes);
  ASSERT_EQ(response->probes.size(), 1u);
  const ProbeResponse& probe = response->probes[0];
  for (std::size_t k = 0; k < response->speed.size(); ++k) {
    const Phasor exact = closed_form(response->speed[k], kZeta);
    EXPECT_LT(std::abs(probe.deflection[k] - exact), 1e-12 * std::abs(exact)) << response->speed[k];
  }
  EXPECT_NEAR(std::arg(closed_form(1.0, kZeta)), 0.0, 1e-3) << "with the mark below";
  EXPECT_LT(std::arg(probe.deflection.back()), -3.0) << "against it above: it lags";
}

// Straight lines between the speeds equal the curve to a few thousandths.
TEST(SynchronousResponse, IsDrawnAsItIs) {
  constexpr double kZeta = 0.001;
  const auto response = synchronous_response(unbalanced(kZeta), 2.0 * kOmega);
  ASSERT_TRUE(response);
  const auto& at = response->speed;
  for (std::size_t k = 1; k < at.size(); ++k) {
    for (const double share : {0.3, 0.5, 0.8}) {
      const auto& x = response->probes[0].deflection;
      const Phasor line = (1.0 - share) * x[k - 1] + share * x[k],
                   exact = closed_form(at[k - 1] + share * (at[k] - at[k - 1]), kZeta);
      EXPECT_LT(std::abs(line - exact), 0.004 * std::abs(exact)) << at[k];
    }
  }
  EXPECT_LT(at.size(), 1500u);
}

// |X| of the closed form is greatest at r = 1/sqrt(1 - 2 zeta^2), e/(2 zeta sqrt(1 - zeta^2)), and
// at 1/sqrt 2 of that where u = 1/r^2 solves u^2 - 2 (1 - 2 zeta^2) u + 1 = 8 zeta^2 (1 - zeta^2).
TEST(SynchronousResponse, HasThePeakAndTheAmplificationOfOneMode) {
  for (const double zeta : {0.005, 0.05, 0.2}) {
    const auto response = synchronous_response(unbalanced(zeta), 8.0 * kOmega);
    ASSERT_TRUE(response);
    ASSERT_EQ(response->probes[0].peaks.size(), 1u);
    const ResponsePeak& peak = response->probes[0].peaks[0];
    const double z2 = zeta * zeta, middle = 1.0 - 2.0 * z2;
    EXPECT_NEAR(peak.speed * std::sqrt(middle) / kOmega, 1.0, 1e-6);
    const double most = kEccentricity / (2.0 * zeta * std::sqrt(1.0 - z2));
    EXPECT_NEAR(std::abs(peak.deflection) / most, 1.0, 1e-9);
    const double half = std::sqrt(middle * middle - 1.0 + 8.0 * z2 * (1.0 - z2));
    const double first = kOmega / std::sqrt(middle + half),
                 second = kOmega / std::sqrt(middle - half);
    ASSERT_TRUE(peak.amplification);
    EXPECT_NEAR(*peak.amplification * (second - first) / peak.speed, 1.0, 1e-6);
  }
  const auto sharp = synchronous_response(unbalanced(0.005), 2.0 * kOmega);
  EXPECT_NEAR(sharp->probes[0].peaks[0].amplification.value() * 2.0 * 0.005, 1.0, 1e-3)
      << "1 / (2 zeta)";
}

TEST(SynchronousResponse, AsksForTheMarginsOfApi617) {
  EXPECT_FALSE(required_margin(2.49, true)) << "critically damped";
  EXPECT_DOUBLE_EQ(required_margin(2.5, false).value(), 0.0);
  EXPECT_DOUBLE_EQ(required_margin(2.5, true).value(), 0.1);
  EXPECT_DOUBLE_EQ(required_margin(11.5, false).value(), 0.153);
  EXPECT_DOUBLE_EQ(required_margin(11.5, true).value(), 0.253);
}

TEST(SynchronousResponse, FollowsThePhaseAndTheSense) {
  constexpr double kZeta = 0.05;
  scene::Scene s = unbalanced(kZeta, 0.7);
  const auto turned = synchronous_response(s, kOmega);
  s.rotor.speed = -150.0;
  const auto backwards = synchronous_response(s, kOmega);
  ASSERT_TRUE(turned && backwards);
  const Phasor exact = closed_form(kOmega, kZeta);
  const Phasor ahead = std::polar(1.0, 0.7);
  EXPECT_LT(std::abs(turned->probes[0].deflection.back() - exact * ahead), 1e-9 * std::abs(exact));
  EXPECT_LT(std::abs(backwards->probes[0].deflection.back() - exact * std::conj(ahead)),
            1e-9 * std::abs(exact))
      << "ahead of the mark is behind it when it turns the other way";
}

// `modes` gives the orbit at the scene's speed; here it follows from the equations in another way.
TEST(SynchronousResponse, AgreesWithTheFreeOrbit) {
  scene::Scene s = unbalanced(0.03);
  s.rotor.modal->stiffness_y = {1.5 * kMass * kOmega * kOmega};
  const auto response = synchronous_response(s, 150.0);
  ASSERT_TRUE(response);
  EXPECT_FALSE(response->same_planes);
  ASSERT_EQ(response->probes.size(), 2u);
  const FreeOrbit orbit = free_response(s, prepare(s), 150.0).orbits.front();
  // The larger half-axis of the ellipse that both probes see.
  const Phasor x = response->probes[0].deflection.back(),
               y = response->probes[1].deflection.back() * Phasor(0.0, -1.0);
  const double half =
      0.5 * (std::abs(x + Phasor(0.0, 1.0) * y) + std::abs(x - Phasor(0.0, 1.0) * y));
  EXPECT_NEAR(half / orbit.largest.value(), 1.0, 1e-6);
}

// A force that turns with the spin acts as unbalance.
TEST(SynchronousResponse, TakesAForceThatTurnsWithTheSpin) {
  constexpr double kZeta = 0.05;
  scene::Scene s = unbalanced(kZeta);
  s.forces.clear();
  EXPECT_FALSE(synchronous_response(s, kOmega)) << "nothing turns";
  test::add_rotating_force(s, kMass * kEccentricity * 150.0 * 150.0, 150.0);
  const auto response = synchronous_response(s, kOmega);
  ASSERT_TRUE(response);
  EXPECT_TRUE(response->forces);
  const Phasor exact = closed_form(kOmega, kZeta);
  EXPECT_LT(std::abs(response->probes[0].deflection.back() - exact), 1e-12 * std::abs(exact));
  s.forces[0].frequency = 149.0;
  EXPECT_FALSE(synchronous_response(s, kOmega)) << "it does not turn with the spin";
}

// A start of rotor and ring that fits only both together.
TEST(SynchronousResponse, AsksForNoStart) {
  scene::Scene s = unbalanced(0.05);
  test::add_ring(s, 1.0, 200.0, 1e5);
  s.initial.x = {2e-3};
  s.first().stator->position = {1.8e-3, 0.0};
  const auto response = synchronous_response(s, kOmega);
  ASSERT_TRUE(response);
  EXPECT_LT(std::abs(response->probes[0].deflection.back() - closed_form(kOmega, 0.05)), 1e-12);
}

TEST(SynchronousResponse, OfAShaftIsSeenAtItsStations) {
  scene::Scene s;
  s.rotor.speed = 50.0;
  s.rotor.geometry = oracle::friswell_rotor();
  s.rotor.geometry->damping_ratio = 0.02;
  s.rotor.geometry->discs[0].eccentricity = 10e-6;
  const auto response = synchronous_response(s, 100.0);
  ASSERT_TRUE(response);
  ASSERT_EQ(response->probes.size(), 4u) << "two discs, two bearings";
  EXPECT_EQ(response->probes[1].name, "disc 1");
  ASSERT_EQ(response->probes[1].peaks.size(), 1u);
  EXPECT_NEAR(response->probes[1].peaks[0].speed, 86.96, 0.1) << "its first critical speed";
}

// Unstable from twice the critical speed on: rotating damping as strong as external damping.
TEST(SynchronousResponse, HasNothingWhereItIsUnstable) {
  scene::Scene s = unbalanced(0.05);
  s.rotor.modal->internal_damping = s.rotor.modal->damping;
  const auto response = synchronous_response(s, 3.0 * kOmega);
  ASSERT_TRUE(response);
  for (std::size_t k = 0; k < response->speed.size(); ++k) {
    if (std::abs(response->speed[k] - 2.0 * kOmega) < 1e-6) continue;
    EXPECT_EQ(std::isnan(response->probes[0].deflection[k].real()),
              response->speed[k] > 2.0 * kOmega)
        << response->speed[k];
  }
}

}  // namespace
}  // namespace rotorub
