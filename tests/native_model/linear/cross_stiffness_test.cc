// Bearings whose springs couple the planes: the motion must not depend on the axes in which its
// bearings are described.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/linear/whirl_system.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

scene::Scene scene_of(const std::string& text) { return scene::parse_scene(text, "made.toml"); }

constexpr double kRpm = 30.0 / std::numbers::pi;

// "[1, 2]", to the last bit.
std::string list(const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(17);
  for (const double value : values) text << (text.tellp() == 0 ? "[" : ", ") << value;
  return text.str() + "]";
}

// Principal stiffnesses of both bearings and how far their axes are turned.
struct Bearing {
  double first, second, angle;
  double mean() const { return 0.5 * (first + second); }
  double along() const { return 0.5 * (first - second) * std::cos(2.0 * angle); }
  double across() const { return 0.5 * (first - second) * std::sin(2.0 * angle); }

  std::string keys() const {
    return "stiffness = " + list({mean() + along(), mean() - along()}) +
           "\ncross_stiffness = " + list({across(), across()}) + "\n";
  }
  // The same over the speed, stiffer at higher speeds.
  std::string table() const {
    const auto rising = [](double value) { return list({value, 1.5 * value, 3.0 * value}); };
    return "table_speed = [0.0, 100.0, 250.0]\ntable_kxx = " + rising(mean() + along()) +
           "\ntable_kyy = " + rising(mean() - along()) + "\ntable_kxy = " + rising(across()) +
           "\ntable_kyx = " + rising(across()) + "\n";
  }
};

WhirlSystem shaft(const std::string& bearing) {
  return whirl_system(scene_of(R"(
[run]
end = 0.1
step = 1e-5
[rotor]
speed = 100.0
length = 1.5
E = 211e9
nu = 0.3
rho = 7810.0
modes = 4
[[rotor.section]]
from = 0.0
to = 1.5
diameter = 0.05
[[rotor.disc]]
z = 0.5
diameter = 0.28
inner_diameter = 0.05
thickness = 0.07
[[rotor.disc]]
z = 1.0
diameter = 0.35
inner_diameter = 0.05
thickness = 0.07
[[rotor.bearing]]
z = 0.0
)" + bearing + "[[rotor.bearing]]\nz = 1.5\n" +
                               bearing));
}

TEST(CrossStiffness, CriticalSpeedsAreThoseOfThePrincipalAxes) {
  const auto crossed = critical_speeds(shaft(Bearing{1.5e6, 0.5e6, std::numbers::pi / 4}.keys()));
  const auto principal = critical_speeds(shaft(Bearing{1.5e6, 0.5e6, 0.0}.keys()));
  ASSERT_EQ(crossed.size(), principal.size());
  for (std::size_t k = 0; k < crossed.size(); ++k) {
    EXPECT_NEAR(crossed[k] / principal[k], 1.0, 1e-9) << k;
  }
  const double expected[] = {700.06, 888.71, 2026.97, 2974.86};  // rpm
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(crossed[k] * kRpm, expected[k], 0.01) << k;
}

TEST(CrossStiffness, TurningTheBearingsChangesNoCriticalSpeedNorItsSense) {
  for (const bool follows : {false, true}) {
    const auto at = [follows](double angle) {
      const Bearing bearing{3e6, 0.7e6, angle};
      return shaft(follows ? bearing.table() : bearing.keys());
    };
    const WhirlSystem straight = at(0.0);
    const auto expected = critical_speeds(straight);
    const auto senses = critical_senses(straight, expected);
    for (const double angle : {0.1, 0.6, 1.3, 2.9}) {
      const WhirlSystem turned = at(angle);
      const auto found = critical_speeds(turned);
      ASSERT_EQ(found.size(), expected.size()) << follows << angle;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_NEAR(found[k] / expected[k], 1.0, 1e-8) << follows << angle << " " << k;
      }
      EXPECT_EQ(critical_senses(turned, found), senses) << follows << angle;
    }
  }
}

// k_xy = -k_yx does not conserve energy: it drives whirl, and changes no critical speed.
TEST(CrossStiffness, WhatDrivesWhirlMovesNoCriticalSpeed) {
  const auto plain = critical_speeds(shaft("stiffness = [1e6, 0.8e6]\n"));
  const auto driven =
      critical_speeds(shaft("stiffness = [1e6, 0.8e6]\ncross_stiffness = [2e5, -2e5]\n"));
  ASSERT_EQ(plain.size(), driven.size());
  for (std::size_t k = 0; k < plain.size(); ++k) EXPECT_NEAR(driven[k] / plain[k], 1.0, 1e-9);
}

// With r = x + i y the equations of both planes, [A, B; -B, A], are A - i B.
TEST(CrossStiffness, OfEqualPlanesIsTheSameInOneComplexEquation) {
  const std::string one = "stiffness = 1e6\ndamping = 500.0\n";
  const std::string film =
      "table_speed = [0.0, 250.0]\ntable_kxx = [1e6, 2e6]\ntable_kyy = [1e6, 2e6]\n"
      "table_kxy = [3e5, 5e5]\ntable_kyx = [-3e5, -5e5]\ntable_cxx = [900.0, 700.0]\n"
      "table_cyy = [900.0, 700.0]\ntable_cxy = [200.0, 300.0]\ntable_cyx = [-200.0, -300.0]\n";
  for (const std::string& bearing : {one, film}) {
    const WhirlSystem system = shaft(bearing);
    ASSERT_TRUE(system.isotropic);
    constexpr double kSpeed = 130.0;
    const WhirlMatrices complex = isotropic_matrices(system, kSpeed);
    const PlanesMatrices planes = planes_matrices(system, kSpeed);
    const Eigen::Index n = system.size();
    const auto joined = [n](const Eigen::MatrixXd& m) {
      const std::complex<double> i(0.0, 1.0);
      return Eigen::MatrixXcd(m.topLeftCorner(n, n) - i * m.topRightCorner(n, n));
    };
    EXPECT_LT((complex.damping - joined(planes.damping)).norm(), 1e-13 * planes.damping.norm());
    EXPECT_LT((complex.stiffness - joined(planes.stiffness)).norm(),
              1e-13 * planes.stiffness.norm());
  }
}

}  // namespace
}  // namespace rotorub::test
