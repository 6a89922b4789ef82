#include "native_model/rotor/modal_rotor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

using test::add_contact;
using test::pinned_shaft;
using test::scene_of;

constexpr double kTorsionMesh = 1e-10;  // relative

scene::Scene with_torsion(const scene::RotorGeometry& geometry, int modes) {
  scene::Scene s = scene_of(geometry);
  s.rotor.torsion.emplace();
  s.rotor.torsion->modes = modes;
  s.rotor.torsion->damping_ratio = 0.01;
  return s;
}

double frequency(const TorsionModes& modes, Eigen::Index j) {
  return std::sqrt(modes.stiffness[j] / modes.inertia[j]);
}

// Wave speed of the uniform shaft.
double wave_speed(const scene::RotorGeometry& g) { return std::sqrt(g.G / g.rho); }

TEST(Torsion, UniformShaftHeldAtTheLeftEnd) {
  const scene::RotorGeometry g = pinned_shaft(1);
  scene::Scene s = with_torsion(g, 4);
  add_contact(s, 1.0);
  const TorsionModes modes = torsion_modes(s);
  for (int n = 0; n < 4; ++n) {
    // sin((n + 1/2) pi z / L), 1 or -1 at the free end.
    const double omega = (n + 0.5) * std::numbers::pi * wave_speed(g);
    EXPECT_NEAR(frequency(modes, n) / omega, 1.0, kTorsionMesh);
    EXPECT_NEAR(modes.inertia[n] / (0.5 * spin_inertia(s)), 1.0, kTorsionMesh);
    EXPECT_NEAR(modes.damping[n] / (0.02 * modes.inertia[n] * omega), 1.0, kTorsionMesh);
    EXPECT_EQ(modes.drive_shape[n], 0.0);
    EXPECT_EQ(modes.contacts.front()[n], 1.0);
  }
}

TEST(Torsion, UniformFreeShaft) {
  const scene::RotorGeometry g = pinned_shaft(1);
  scene::Scene s = with_torsion(g, 4);
  s.drive.emplace();  // without inertia, at z = 0
  add_contact(s, 0.5);
  const TorsionModes modes = torsion_modes(s);
  for (int n = 1; n <= 4; ++n) {
    // cos(n pi z / L): odd ones have a node at mid span.
    EXPECT_NEAR(frequency(modes, n - 1) / (n * std::numbers::pi * wave_speed(g)), 1.0,
                kTorsionMesh);
    EXPECT_EQ(modes.contacts.front()[n - 1], n % 2 == 0 ? 1.0 : 0.0);
    const double at_drive = n % 4 == 2 ? -1.0 : 1.0;
    EXPECT_NEAR(modes.drive_shape[n - 1], at_drive, 1e-8);
  }
}

// Motor and disc on a light shaft: omega^2 = k (1/J_1 + 1/J_2), J_1 theta_1 + J_2 theta_2 = 0.
TEST(Torsion, TwoMasses) {
  scene::RotorGeometry g = pinned_shaft(1);
  g.rho = 1e-3;
  g.discs = {{.z = 0.8, .mass = 5.0, .Jp = 0.04}};
  scene::Scene s = with_torsion(g, 1);
  s.drive.emplace();
  s.drive->station = 0.1;
  s.drive->inertia = 0.01;
  add_contact(s, 0.8);
  const TorsionModes modes = torsion_modes(s);
  constexpr double kShaftInertia = 1e-6;  // relative: of the light shaft
  const double stiffness = g.G * 2.0 * test::kShaft.inertia() / 0.7;
  EXPECT_NEAR(frequency(modes, 0) / std::sqrt(stiffness * (1.0 / 0.01 + 1.0 / 0.04)), 1.0,
              kShaftInertia);
  EXPECT_NEAR(modes.drive_shape[0], -4.0, 4.0 * kShaftInertia);
  EXPECT_NEAR(modes.inertia[0] / (0.04 + 16.0 * 0.01), 1.0, kShaftInertia);
  EXPECT_NEAR(spin_inertia(s), 0.05, 0.05 * kShaftInertia);
}

TEST(Torsion, SpinInertiaOfEverythingThatTurns) {
  scene::RotorGeometry g = pinned_shaft(1);
  g.discs = {{.z = 0.5, .mass = 2.0, .Jp = 3e-3}};
  scene::Scene s = scene_of(g);
  const double shaft = g.rho * 2.0 * test::kShaft.inertia() * g.length;
  EXPECT_NEAR(spin_inertia(s) / (shaft + 3e-3), 1.0, kTorsionMesh);
  s.drive.emplace().inertia = 2e-3;
  EXPECT_NEAR(spin_inertia(s) / (shaft + 5e-3), 1.0, kTorsionMesh);
}

}  // namespace
}  // namespace rotorub
