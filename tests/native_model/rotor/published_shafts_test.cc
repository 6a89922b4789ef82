// Shafts whose whirl, critical speeds or torsion others have published.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "native_model/linear/mode_shapes.h"
#include "native_model/rotor/modal_rotor.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

constexpr double kHz = 2.0 * std::numbers::pi, kRpm = std::numbers::pi / 30.0;  // rad/s

// Friswell, Penny, Garvey, Lees, "Dynamics of Rotating Machines": the rotor of example 5.9.1 with
// both bearings replaced by `bearing`. The book's elements have shear and are 0.25 m long, which
// makes its frequencies up to 6e-4 too high.
scene::Scene on_bearings(const scene::ShaftBearing& bearing, scene::ShaftTheory theory) {
  scene::RotorGeometry g = oracle::friswell_rotor();
  g.theory = theory;
  for (scene::ShaftBearing& each : g.bearings) {
    const double z = each.z;
    each = bearing;
    each.z = z;
  }
  return test::scene_of(g);
}

// Tolerance in rpm.
void expect_critical_speeds(const scene::Scene& scene, const std::vector<double>& rpm,
                            double tolerance) {
  const std::vector<double> found = critical_speeds(whirl_system(scene));
  ASSERT_GE(found.size(), rpm.size());
  for (std::size_t j = 0; j < rpm.size(); ++j) {
    EXPECT_NEAR(found[j] / kRpm, rpm[j], tolerance) << j;
  }
}

// Example 5.9.4: cross-coupled bearings, near rest. The critical speeds are those of cubic elements
// without shear.
TEST(PublishedShafts, FriswellsCrossCoupledBearings) {
  const scene::ShaftBearing bearing{.stiffness = {1e6, 1e6}, .cross_stiffness = {0.5e6, 0.5e6}};
  const WhirlSpectrum spectrum = whirl_spectrum(
      whirl_system(on_bearings(bearing, scene::ShaftTheory::kTimoshenko)), 0.1 * kRpm);
  const std::vector<double> book{11.66, 14.80, 33.97, 49.19, 97.97, 126.61};  // Hz
  ASSERT_EQ(spectrum.modes.size(), book.size());
  for (std::size_t j = 0; j < book.size(); ++j) {
    const double found = std::abs(spectrum.modes[j].frequency) / kHz;
    EXPECT_NEAR(found / book[j], 1.0, 6e-4) << j << ": " << found;
  }
  expect_critical_speeds(on_bearings(bearing, scene::ShaftTheory::kEulerBernoulli),
                         {700.06, 888.71, 2026.97, 2974.86, 5139.14}, 0.0051);
}

// Example 5.9.5: damped bearings. Damping leaves |s| at rest nearly where the natural frequency is,
// and takes the third mode's Im s down by a quarter.
TEST(PublishedShafts, FriswellsDampedBearings) {
  const scene::ShaftBearing bearing{.stiffness = {1e6, 1e6}, .damping = {3e3, 3e3}};
  const WhirlSystem system = whirl_system(on_bearings(bearing, scene::ShaftTheory::kTimoshenko));
  const auto natural = [](const WhirlMode& mode) {  // Hz, |s|
    const double cosine = std::sqrt(1.0 - mode.damping_ratio * mode.damping_ratio);
    return std::abs(mode.frequency) / cosine / kHz;
  };
  constexpr double kMesh = 2e-3;
  const std::vector<WhirlMode> at_rest = whirl_spectrum(system, 0.0).modes;
  const double naturals[] = {13.91, 48.18, 137.06}, damped[] = {13.89, 46.54, 103.22};  // Hz
  ASSERT_EQ(at_rest.size(), 6u);
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(std::abs(at_rest[2 * j].frequency) / kHz / damped[j], 1.0, kMesh) << j;
    EXPECT_NEAR(natural(at_rest[2 * j]) / naturals[j], 1.0, kMesh) << j;
  }
  const std::vector<WhirlMode> turning = whirl_spectrum(system, 4000.0 * kRpm).modes;
  const double book[] = {13.70, 14.09, 43.61, 52.18};  // Hz, |s|
  for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(natural(turning[j]) / book[j], 1.0, kMesh) << j;
}

// Examples 6.8.1 and 6.9.1: an overhung disc on a shaft of 25 mm; the critical speeds are those of
// cubic elements without shear.
TEST(PublishedShafts, FriswellsOverhungDisc) {
  scene::RotorGeometry g = oracle::friswell_rotor();
  g.sections[0].diameter = 0.025;
  g.discs = {{.z = 1.5, .mass = 15.3, .Jt = 0.062, .Jp = 0.120}};
  g.bearings[1].z = 1.0;
  for (scene::ShaftBearing& bearing : g.bearings) bearing.stiffness = {1e7, 1e7};
  const std::vector<WhirlMode> turning =
      whirl_spectrum(whirl_system(test::scene_of(g)), 1000.0 * kRpm).modes;
  const double book[] = {42.250, 46.404, 389.801, 402.327};  // rad/s
  for (std::size_t j = 0; j < 4; ++j) {
    const double found = std::abs(turning[j].frequency);
    EXPECT_NEAR(found / book[j], 1.0, 1e-3) << j << ": " << found;
  }
  for (scene::ShaftBearing& bearing : g.bearings) bearing.stiffness = {0.2e6, 0.4e6};
  expect_critical_speeds(test::scene_of(g), {358.51, 389.46, 2124.07, 2659.76, 3118.97}, 0.0051);
}

// A drill string, free at its drive: a tube with inertias at its ends, whose torsion obeys
//   (J_1 + J_2) w b = (J_1 J_2 w^2 - b^2) tan(w L / c),  b = rho I_p c, c^2 = G / rho.
TEST(PublishedShafts, TorsionOfADrillString) {
  scene::RotorGeometry g;
  g.length = 800.0;
  g.E = 200e9;
  g.G = 75e9;
  g.rho = 8000.0;
  g.modes = 1;
  g.sections = {{.from = 0.0, .to = g.length, .diameter = 0.78, .inner_diameter = 0.65}};
  g.discs = {{.z = 0.0, .mass = 1.0, .Jt = 0.0, .Jp = 200.0},
             {.z = g.length, .mass = 1.0, .Jt = 0.0, .Jp = 10.0}};
  g.bearings = {{.z = 0.0, .stiffness = {1e6, 1e6}}, {.z = g.length, .stiffness = {1e6, 1e6}}};
  scene::Scene s = test::scene_of(g);
  s.drive.emplace();
  s.rotor.torsion.emplace().modes = 2;
  const std::vector<WhirlMode> modes = torsion_frequencies(modal_rotor(s));
  ASSERT_EQ(modes.size(), 2u);
  const double speed = std::sqrt(g.G / g.rho);
  const double polar = std::numbers::pi / 32.0 * (std::pow(0.78, 4) - std::pow(0.65, 4));
  const double b = g.rho * polar * speed, first = 200.0, last = 10.0;
  const double published[] = {1.9103, 3.8207};  // Hz
  for (std::size_t j = 0; j < 2; ++j) {
    const double w = modes[j].frequency;
    EXPECT_NEAR(w / kHz, published[j], 5e-5);
    const double angle = w * g.length / speed;
    EXPECT_NEAR((first + last) * w * b * std::cos(angle),
                (first * last * w * w - b * b) * std::sin(angle), 1e-9 * b * b)
        << j;
  }
}

}  // namespace
}  // namespace rotorub
