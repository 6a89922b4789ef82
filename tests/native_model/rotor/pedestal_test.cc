// Bearings on pedestals.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/rotor_modes.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::kShaft;
using test::scene_of;

constexpr double kFilm = 3e7, kBase = 5e7, kMass = 40.0;  // N/m, N/m, kg

scene::RotorGeometry on_pedestals(int modes) {
  scene::RotorGeometry g = test::pinned_shaft(modes);
  g.theory = scene::ShaftTheory::kTimoshenko;
  for (scene::ShaftBearing& bearing : g.bearings) {
    bearing.stiffness = {kFilm, kFilm};
    bearing.pedestal = {.mass = kMass, .stiffness = {kBase, kBase}, .damping = {0.0, 0.0}};
  }
  return g;
}

// The symmetric modes of a shaft on two end springs (shear_test.cc) with the dynamic stiffness of
// spring and pedestal, k (K - M w^2) / (k + K - M w^2).
TEST(Pedestal, SymmetricModesOfAShaft) {
  const scene::RotorGeometry g = on_pedestals(8);
  const RotorModes modes = rotor_modes(scene_of(g));
  const auto remainder = [&](double w) {
    const test::SymmetricEnd end = test::symmetric_end(g, w);
    const double base = kBase - kMass * w * w;
    return (kFilm + base) * end.force - kFilm * base * end.deflection;
  };
  int roots = 0;
  for (int j = 0; j < 8; ++j) {
    const double w = modes.x.frequency[j];
    roots += remainder(w * (1.0 - 1e-9)) * remainder(w * (1.0 + 1e-9)) < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(roots, 4) << "every other mode is symmetric";
}

// A rigid bearing on a pedestal of nearly no mass is a bearing with the pedestal's spring and
// damper, in the whirl and in the reduced model.
TEST(Pedestal, WithoutMassIsABearing) {
  scene::Scene direct = scene_of(test::pinned_shaft(3)), carried = direct;
  const scene::PlanePair stiffness{2e7, 1e7}, damping{4e3, 2e3};
  for (scene::ShaftBearing& bearing : direct.rotor.geometry->bearings) {
    bearing.stiffness = stiffness;
    bearing.damping = damping;
  }
  for (scene::ShaftBearing& bearing : carried.rotor.geometry->bearings) {
    bearing.stiffness = {1e14, 1e14};
    bearing.pedestal = {.mass = 1e-6, .stiffness = stiffness, .damping = damping};
  }
  const auto a = whirl_eigenvalues(whirl_system(direct), 300.0),
             b = whirl_eigenvalues(whirl_system(carried), 300.0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t j = 0; j < a.size(); ++j) {
    EXPECT_LT(std::abs(a[j] - b[j]), 1e-6 * std::abs(a[j])) << j;
  }
  const ModalRotor one = modal_rotor(direct), other = modal_rotor(carried);
  const auto damping_of = [](const ModalRotor& rotor) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rotor.modes(), rotor.modes());
    for (const StationDamper& d : rotor.bearing_dampers)
      sum += d.damping.y() * d.shape.y * d.shape.y.transpose();
    return sum;
  };
  const Eigen::MatrixXd first = damping_of(one), second = damping_of(other);
  EXPECT_LT((first - second).norm(), 1e-5 * first.norm());
}

TEST(Pedestal, KeysOfAScene) {
  const auto text = [](const std::string& rotor, const std::string& more) {
    return "[rotor]\nlength = 1.0\nE = 2.1e11\nrho = 7850\nmodes = 2\n" + rotor +
           "[[rotor.section]]\nfrom = 0.0\nto = 1.0\ndiameter = 0.05\n"
           "[[rotor.bearing]]\nz = 0.0\nstiffness = 1e8\n"
           "[rotor.bearing.pedestal]\nmass = 12.0\nstiffness = [1e8, 2e8]\ndamping = 300.0\n"
           "[[rotor.bearing]]\nz = 1.0\nstiffness = 1e8\n" +
           more;
  };
  const scene::Scene s = scene::parse_scene(text("", ""), "s.toml");
  const auto& bearings = s.rotor.geometry->bearings;
  ASSERT_TRUE(bearings.at(0).pedestal);
  EXPECT_FALSE(bearings.at(1).pedestal);
  EXPECT_EQ(bearings[0].pedestal->mass, 12.0);
  EXPECT_EQ(bearings[0].pedestal->stiffness.y(), 2e8);
  EXPECT_EQ(bearings[0].pedestal->damping.x(), 300.0);
  const auto key_of = [&](const std::string& rotor, const std::string& more) {
    return test::refusals([&] { scene::parse_scene(text(rotor, more), "s.toml"); }).at(0).key;
  };
  EXPECT_EQ(key_of("internal_damping_ratio = 0.01\n", ""), "rotor.bearing[0].pedestal");
  EXPECT_EQ(key_of("", "[mujoco]\nrotor = \"segments\"\nsegments = 12\n"),
            "rotor.bearing[0].pedestal");
}

}  // namespace
}  // namespace rotorub
