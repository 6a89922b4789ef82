// Shafts with shear deformation and under an axial force, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/rotor/segment_chain.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::kShaft;
using test::scene_of;

constexpr double kExact = 1e-10;  // relative: what the mesh is made for, with the pins' own error

// A uniform spinning Timoshenko shaft under the tension `force` on two rigid pins. With
// u = U sin(l z) and psi = P cos(l z), l = n pi / L, circular whirl at w obeys
//   (rho A w^2 - k G A l^2 - N l^2) (rho I (w^2 - 2 Omega w) - E I l^2 - k G A) = (k G A l)^2.
struct PinnedTimoshenko {
  oracle::RayleighShaft shaft = kShaft;
  double shear_modulus = kShaft.E / 2.6;  // Pa
  double coefficient = 1.0;               // k
  double force = 0.0;                     // N

  double remainder(int n, double speed, double w) const {
    const double l2 = std::pow(n * std::numbers::pi / shaft.length, 2);
    const double A = shaft.area(), I = shaft.inertia(), shear = coefficient * shear_modulus * A;
    const double translation = shaft.rho * A * w * w - (shear + force) * l2;
    const double rotation = shaft.rho * I * (w * w - 2.0 * speed * w) - shaft.E * I * l2 - shear;
    return translation * rotation / (shear * shear * l2) - 1.0;
  }
};

// True if f changes its sign within the relative distance `width` of x.
bool root_near(const std::function<double(double)>& f, double x, double width) {
  return f(x * (1.0 - width)) * f(x * (1.0 + width)) < 0.0;
}

scene::RotorGeometry sheared(int modes, const oracle::RayleighShaft& shaft = kShaft) {
  scene::RotorGeometry g = test::pinned_shaft(modes, shaft);
  g.theory = scene::ShaftTheory::kTimoshenko;
  return g;
}

TEST(Shear, CowpersCoefficients) {
  EXPECT_NEAR(cowper_coefficient(0.3, 0.0), 7.8 / 8.8, 1e-15);
  // A thin tube: 2 (1 + nu) / (4 + 3 nu).
  EXPECT_NEAR(cowper_coefficient(0.3, 1.0), 2.6 / 4.9, 1e-15);
}

// 12 modes of a shaft of 20 diameters, of a tube and of a shaft of 4 diameters.
TEST(Shear, PinnedShaftsAtRest) {
  constexpr int kModes = 12;
  oracle::RayleighShaft tube = kShaft, thick = kShaft;
  tube.inner_diameter = 0.04;
  thick.diameter = 0.25;
  for (const oracle::RayleighShaft& shaft : {kShaft, tube, thick}) {
    const RotorModes modes = rotor_modes(scene_of(sheared(kModes, shaft)));
    PinnedTimoshenko exact{shaft};
    exact.coefficient = cowper_coefficient(0.3, shaft.inner_diameter / shaft.diameter);
    for (int n = 1; n <= kModes; ++n) {
      const auto f = [&](double w) { return exact.remainder(n, 0.0, w); };
      // The thick shaft's modes of shear lie among those of bending.
      bool found = false;
      for (int j = 0; j < kModes; ++j)
        found = found || root_near(f, modes.x.frequency[j], kExact * n);
      const bool above = f(modes.x.frequency[kModes - 1]) > 0.0;
      EXPECT_TRUE(found || above) << shaft.diameter << " m, mode " << n;
    }
  }
}

TEST(Shear, WhirlOfPinnedShafts) {
  scene::RotorGeometry g = sheared(4);
  g.shear_coefficient = 0.5;
  g.axial_force = 2e5;
  const double speed = 2000.0;
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(scene_of(g)), speed);
  PinnedTimoshenko exact;
  exact.coefficient = 0.5;
  exact.force = 2e5;
  ASSERT_EQ(spectrum.modes.size(), 8u);
  for (std::size_t j = 0; j < 8; ++j) {
    const int n = static_cast<int>(j) / 2 + 1;
    EXPECT_TRUE(root_near([&](double w) { return exact.remainder(n, speed, w); },
                          spectrum.modes[j].frequency, test::kTight))
        << j << ": " << spectrum.modes[j].frequency;
  }
}

// The symmetric modes of a shaft on two end springs, which carry the shear force.
TEST(Shear, ShaftOnEndSprings) {
  constexpr double kSpring = 3e7;  // N/m
  scene::RotorGeometry g = sheared(5);
  for (scene::ShaftBearing& bearing : g.bearings) bearing.stiffness = {kSpring, kSpring};
  const RotorModes modes = rotor_modes(scene_of(g));
  const auto remainder = [&](double w) {
    const test::SymmetricEnd end = test::symmetric_end(g, w);
    return end.force - kSpring * end.deflection;
  };
  for (int j : {0, 2, 4}) EXPECT_TRUE(root_near(remainder, modes.x.frequency[j], kExact)) << j;
}

// P L^3 / 48 E I + P L / 4 k G A.
TEST(Shear, StaticDeflectionUnderALoadInTheMiddle) {
  const scene::RotorGeometry g = sheared(1);
  const RitzBending ritz = ritz_bending(g, bending_mesh(g, {0.5}, 100.0));
  const Eigen::VectorXd u = ritz.basis.deflection(0.5).transpose();
  const double found = u.dot(Cholesky(ritz.stiffness_x).solve(u));
  const double shear = cowper_coefficient(0.3, 0.0) * g.G * kShaft.area();
  const double exact = 1.0 / (48.0 * g.E * kShaft.inertia()) + 0.25 / shear;
  EXPECT_NEAR(found / exact, 1.0, 1e-12);
}

// A mesh of six elements with linear curvatures and constant shear strains, nearly the book's
// elements (it ties the shear strain to the change of the curvature).
RitzBending six_elements(const scene::RotorGeometry& g) {
  std::vector<ShaftElement> mesh;
  for (int i = 0; i < 6; ++i) {
    mesh.push_back({0.25 * i, 0.25 * (i + 1), g.sections[0], 2, 1});
  }
  return ritz_bending(g, mesh);
}

// rad/s, |w| ascending, of M q'' - i Omega G q' + K q = 0 for isotropic planes.
std::vector<double> whirl_of(const RitzBending& r, double speed) {
  const Eigen::Index n = r.mass.rows();
  const Cholesky mass(r.mass);
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -mass.solve(r.stiffness_x);
  A.bottomRightCorner(n, n) =
      std::complex<double>(0.0, speed) * mass.solve(r.gyroscopic).cast<std::complex<double>>();
  std::vector<double> all;
  const auto eigenvalues = complex_eigenvalues(A).value();
  for (const std::complex<double>& s : eigenvalues) all.push_back(std::abs(s.imag()));
  std::sort(all.begin(), all.end());
  return all;
}

// Friswell, Penny, Garvey, Lees, "Dynamics of Rotating Machines", example 5.9.1, with shear, at
// rest. The book has six elements, whose frequencies are up to 3e-4 too high.
TEST(Shear, FriswellRotorAtRest) {
  scene::RotorGeometry g = oracle::friswell_rotor();
  g.theory = scene::ShaftTheory::kTimoshenko;
  const RotorModes modes = rotor_modes(scene_of(g));
  const double book[] = {86.66, 274.31, 716.78};
  for (int j = 0; j < 3; ++j) {
    EXPECT_LT(modes.x.frequency[j], book[j] + 0.005) << j;
    EXPECT_NEAR(modes.x.frequency[j] / book[j], 1.0, 4e-4) << j;
  }
  const std::vector<double> six = whirl_of(six_elements(g), 0.0);
  for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(six[2 * j], book[j], 0.01) << j;
}

// Examples 5.9.2 and 5.9.3, anisotropic bearings, and 5.9.9, an overhung disc: |w| in rad/s. The
// book's elements, 0.25 m long or longer, are too stiff by up to 6e-4.
struct FriswellExample {
  const char* name;
  scene::PlanePair stiffness;  // N/m, of both bearings
  double last_bearing;         // m
  bool overhung;               // without the first disc, the second at the end
  double speed;                // rpm
  std::vector<double> book;
};
class FriswellsExamples : public testing::TestWithParam<FriswellExample> {};

TEST_P(FriswellsExamples, WithShear) {
  const FriswellExample& example = GetParam();
  scene::RotorGeometry g = oracle::friswell_rotor();
  g.theory = scene::ShaftTheory::kTimoshenko;
  for (scene::ShaftBearing& bearing : g.bearings) bearing.stiffness = example.stiffness;
  g.bearings[1].z = example.last_bearing;
  if (example.overhung) {
    g.discs.erase(g.discs.begin());
    g.discs[0].z = g.length;
  }
  const WhirlSpectrum spectrum =
      whirl_spectrum(whirl_system(scene_of(g)), example.speed * std::numbers::pi / 30.0);
  for (std::size_t j = 0; j < example.book.size(); ++j) {
    EXPECT_NEAR(std::abs(spectrum.modes[j].frequency) / example.book[j], 1.0, 6e-4) << j;
  }
}
INSTANTIATE_TEST_SUITE_P(
    Of, FriswellsExamples,
    testing::Values(
        FriswellExample{
            "5.9.2", {1e6, 0.8e6}, 1.5, false, 0.0, {82.65, 86.66, 254.52, 274.31, 679.49}},
        FriswellExample{
            "5.9.2", {1e6, 0.8e6}, 1.5, false, 4000.0, {82.33, 86.86, 239.64, 287.25, 583.49}},
        FriswellExample{"5.9.3",
                        {1e6, 0.2e6},
                        1.5,
                        false,
                        4000.0,
                        {53.690, 86.520, 140.429, 276.837, 494.864, 756.495}},
        FriswellExample{
            "5.9.9", {1e7, 1e7}, 1.0, true, 0.0, {90.14, 90.14, 630.73, 630.73, 830.43, 830.43}},
        FriswellExample{"5.9.9",
                        {1e7, 1e7},
                        1.0,
                        true,
                        4000.0,
                        {76.19, 103.91, 565.99, 634.23, 647.75, 1174.2}}));

// Example 5.9.7: the same rotor under a tension of 100 kN, at 4000 rpm.
TEST(AxialForce, FriswellRotor) {
  scene::RotorGeometry g = oracle::friswell_rotor();
  g.theory = scene::ShaftTheory::kTimoshenko;
  g.axial_force = 100e3;
  const double speed = 4000.0 * std::numbers::pi / 30.0;
  const WhirlSpectrum spectrum = whirl_spectrum(whirl_system(scene_of(g)), speed);
  const std::vector<double> six = whirl_of(six_elements(g), speed);
  const double book[] = {93.416, 95.234, 267.475, 309.919, 634.408};
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_NEAR(std::abs(spectrum.modes[j].frequency) / book[j], 1.0, 2e-4) << j;
    EXPECT_NEAR(six[j], book[j], 0.001) << j;
  }
}

// (1 + r^2 l^2) rho A w^2 = E I l^4 + N l^2.
TEST(AxialForce, PinnedShaftWithoutShear) {
  for (const double force : {-4e5, 3e5, 4e7}) {
    scene::RotorGeometry g = test::pinned_shaft(8);
    g.axial_force = force;
    const RotorModes modes = rotor_modes(scene_of(g));
    for (int n = 1; n <= 8; ++n) {
      const double l = n * std::numbers::pi / g.length, w = kShaft.forward(n, 0.0);
      const double exact = w * std::sqrt(1.0 + force / (kShaft.E * kShaft.inertia() * l * l));
      EXPECT_NEAR(modes.x.frequency[n - 1] / exact, 1.0, kExact * n) << force << " " << n;
    }
  }
}

// Euler's load pi^2 E I / L^2, with shear Engesser's: 1 / (1 / Euler + 1 / k G A).
TEST(AxialForce, BucklingIsRefused) {
  const double euler = std::pow(std::numbers::pi, 2) * kShaft.E * kShaft.inertia();
  const double shear = cowper_coefficient(0.3, 0.0) * kShaft.E / 2.6 * kShaft.area();
  for (const auto& [g, load] : {std::pair{test::pinned_shaft(2), euler},
                                std::pair{sheared(2), 1.0 / (1.0 / euler + 1.0 / shear)}}) {
    scene::RotorGeometry pressed = g;
    pressed.axial_force = -load * (1.0 - 1e-6);
    EXPECT_GT(rotor_modes(scene_of(pressed)).x.frequency[0], 0.0);
    pressed.axial_force = -load * (1.0 + 1e-6);
    const auto refused = test::refusals([&] { rotor_modes(scene_of(pressed)); });
    ASSERT_EQ(refused.size(), 1u);
    EXPECT_EQ(refused[0].key, "rotor.axial_force");
    EXPECT_NE(refused[0].reason.find("buckle"), std::string::npos) << refused[0].reason;
  }
}

// Keys and refusals.

std::string scene_text(const std::string& rotor, const std::string& more = {}) {
  return "[rotor]\nlength = 1.0\nE = 2.1e11\nrho = 7850\nmodes = 2\n" + rotor +
         "[[rotor.section]]\nfrom = 0.0\nto = 1.0\ndiameter = 0.05\n"
         "[[rotor.bearing]]\nz = 0.0\nstiffness = 1e8\n"
         "[[rotor.bearing]]\nz = 1.0\nstiffness = 1e8\n" +
         more;
}

TEST(Shear, KeysOfAScene) {
  const scene::Scene plain = scene::parse_scene(scene_text(""), "s.toml");
  EXPECT_EQ(plain.rotor.geometry->theory, scene::ShaftTheory::kEulerBernoulli);
  const scene::Scene s =
      scene::parse_scene(scene_text("nu = 0.3\ntheory = \"timoshenko\"\nshear_coefficient = 0.9\n"
                                    "axial_force = \"-2 kN\"\n"),
                         "s.toml");
  EXPECT_EQ(s.rotor.geometry->theory, scene::ShaftTheory::kTimoshenko);
  EXPECT_EQ(s.rotor.geometry->shear_coefficient, 0.9);
  EXPECT_EQ(s.rotor.geometry->axial_force, -2000.0);
}

TEST(Shear, RefusedKeys) {
  const auto key_of = [](const std::string& text) {
    return test::refusals([&] { scene::parse_scene(text, "s.toml"); }).at(0).key;
  };
  EXPECT_EQ(key_of(scene_text("shear_coefficient = 0.9\n")), "rotor.shear_coefficient");
  EXPECT_EQ(key_of(scene_text("theory = \"timoshenko\"\n")), "rotor.nu");
  EXPECT_EQ(key_of(scene_text("theory = \"rayleigh\"\n")), "rotor.theory");
}

TEST(Shear, SegmentsAreRefused) {
  for (const char* rotor : {"nu = 0.3\ntheory = \"timoshenko\"\n", "axial_force = 10.0\n"}) {
    const scene::Scene s = scene::parse_scene(
        scene_text(rotor, "[mujoco]\nrotor = \"segments\"\nsegments = 12\n"), "s.toml");
    EXPECT_EQ(test::refusals([&] { segment_chain(s); }).at(0).key, "mujoco.rotor");
  }
}

}  // namespace
}  // namespace rotorub
