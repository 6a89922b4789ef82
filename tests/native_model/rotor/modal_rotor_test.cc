#include "native_model/rotor/modal_rotor.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/diagnostic.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::add_contact;
using test::kShaft;
using test::pinned_shaft;
using test::scene_of;

constexpr double kModeValue = 1e-9;  // relative: mode values, one order looser than frequencies

Eigen::VectorXd frequencies(const PlaneModes& plane) {
  return plane.stiffness.cwiseQuotient(plane.mass).cwiseSqrt();
}

TEST(ModalRotor, PinnedShaftScaledAtMidSpan) {
  scene::Scene s = scene_of(pinned_shaft(5));
  add_contact(s, 0.5);
  const ModalRotor rotor = modal_rotor(s);
  for (int n = 1; n <= 5; ++n) {
    // sin(n pi z / L): 1 or -1 at mid span, or a node there and 1 at the largest deflection.
    const bool node = n % 2 == 0;
    EXPECT_EQ(rotor.contacts.front().x[n - 1], node ? 0.0 : 1.0);
    EXPECT_NEAR(rotor.x.mass[n - 1] / kShaft.modal_mass(n), 1.0, kModeValue);
    EXPECT_NEAR(frequencies(rotor.x)[n - 1] / kShaft.forward(n, 0.0), 1.0, kModeValue);
    // g = int 2 rho I u_z^2 for a slope amplitude of n pi / L
    const double lambda = n * std::numbers::pi / kShaft.length;
    const double g = kShaft.rho * kShaft.inertia() * lambda * lambda * kShaft.length;
    EXPECT_NEAR(rotor.gyroscopic(n - 1, n - 1) / g, 1.0, kModeValue);
    // int rho A sin = 2 rho A L / (n pi), with the sign of the scaling; the peaks of even modes
    // cancel.
    const double sign = n % 4 == 3 ? -1.0 : 1.0;
    const double load = 2.0 * kShaft.rho * kShaft.area() / lambda * sign;
    EXPECT_NEAR(rotor.gravity_x[n - 1], node ? 0.0 : load, kModeValue * 10.0);
  }
}

// The deflection at any station is the sum over modes: a static load against the beam formula.
TEST(ModalRotor, StaticSagOfManyModes) {
  scene::Scene s = scene_of(pinned_shaft(25));
  add_contact(s, 0.5);
  s.forces.resize(1);
  s.forces[0].station = 0.3;
  const ModalRotor rotor = modal_rotor(s);
  const double EI = kShaft.E * kShaft.inertia();

  // Weight: 5 rho A g L^4 / (384 E I) at mid span, modes beyond n leave n^-5.
  const double sag = rotor.contacts.front().x.dot(rotor.gravity_x.cwiseQuotient(rotor.x.stiffness));
  EXPECT_NEAR(sag / (5.0 * kShaft.rho * kShaft.area() / (384.0 * EI)), 1.0, 1e-6);

  // A point load at a = 0.3 L: a^2 b^2 / (3 E I L) under it, modes beyond n leave n^-3.
  const Eigen::VectorXd& u = rotor.force_shapes[0].x;
  const double flexibility = u.cwiseAbs2().cwiseQuotient(rotor.x.stiffness).sum();
  EXPECT_NEAR(flexibility / (0.09 * 0.49 / (3.0 * EI)), 1.0, 1e-4);
}

// A heavy disc on a shaft of hardly any mass: m a^2 b^2 / (3 E I L) under its own weight.
TEST(ModalRotor, StaticSagUnderADisc) {
  scene::RotorGeometry g = pinned_shaft(12);
  g.rho = 1.0;
  g.discs = {{.z = 0.3, .mass = 1e3, .Jt = 1e-6, .Jp = 1e-6}};
  scene::Scene s = scene_of(g);
  add_contact(s, 0.3);
  const ModalRotor rotor = modal_rotor(s);
  const double sag = rotor.contacts.front().x.dot(rotor.gravity_x.cwiseQuotient(rotor.x.stiffness));
  const double exact = 1e3 * 0.09 * 0.49 / (3.0 * kShaft.E * kShaft.inertia());
  EXPECT_NEAR(sag / exact, 1.0, 1e-5) << "the shaft weighs 2e-6 of the disc";
}

TEST(ModalRotor, IsotropicPlanesAreTheSameBits) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->internal_damping_ratio = 0.003;
  const ModalRotor rotor = modal_rotor(s);
  EXPECT_EQ(rotor.x.mass, rotor.y.mass);
  EXPECT_EQ(rotor.x.stiffness, rotor.y.stiffness);
  EXPECT_EQ(rotor.x.damping, rotor.y.damping);
  EXPECT_EQ(rotor.contacts.front().x, rotor.contacts.front().y);
  EXPECT_EQ(rotor.gravity_x, rotor.gravity_y);
  EXPECT_EQ(rotor.lines->x, rotor.lines->y);
  EXPECT_EQ(rotor.gyroscopic, rotor.gyroscopic.transpose());
  EXPECT_EQ(rotor.internal_xx, rotor.internal_yy);
  EXPECT_EQ(rotor.internal_xx, rotor.internal_xy);
  // Off-diagonal exactly zero.
  const Eigen::MatrixXd diagonal = rotor.internal_xx.diagonal().asDiagonal();
  EXPECT_EQ(rotor.internal_xx, diagonal);
}

TEST(ModalRotor, ReferenceRig) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->discs[0].phase = 0.7;
  const ModalRotor rotor = modal_rotor(s);
  const Eigen::VectorXd hertz = frequencies(rotor.x) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(hertz[0], 57.0, 0.5);
  EXPECT_NEAR(hertz[1], 394.0, 0.5);
  EXPECT_EQ(rotor.contacts.front().x, Eigen::VectorXd::Ones(3));
  for (int n = 0; n < 3; ++n) {
    EXPECT_DOUBLE_EQ(rotor.x.damping[n], 0.02 * std::sqrt(rotor.x.stiffness[n] * rotor.x.mass[n]));
  }
  // The eccentric disc sits where the first mode has its peak.
  ASSERT_EQ(rotor.unbalances.size(), 1u);
  EXPECT_DOUBLE_EQ(rotor.unbalances[0].static_moment, 2.0 * 20e-6);
  EXPECT_EQ(rotor.unbalances[0].phase, 0.7);
  EXPECT_GT(rotor.unbalances[0].shape.x[0], 1.0);
}

TEST(ModalRotor, StationsOfTheScene) {
  scene::Scene s = test::reference_rig();
  s.forces.resize(2);
  s.forces[0].station = 0.24;  // the contact's
  s.forces[1].station = 0.42;
  s.magnetic_bearings.emplace_back().station = 0.42;
  s.rotor.geometry->bearings[0].damping = {5.0, 7.0};
  const ModalRotor rotor = modal_rotor(s);
  ASSERT_EQ(rotor.force_shapes.size(), 2u);
  EXPECT_LT((rotor.force_shapes[0].x - Eigen::VectorXd::Ones(3)).cwiseAbs().maxCoeff(), 1e-12);
  ASSERT_EQ(rotor.magnets.size(), 1u);
  EXPECT_EQ(rotor.magnets[0].station.x, rotor.force_shapes[1].x);
  ASSERT_EQ(rotor.bearing_dampers.size(), 1u) << "a bearing without damping has no dashpot";
  EXPECT_EQ(rotor.bearing_dampers[0].damping, Eigen::Vector2d(5.0, 7.0));
  EXPECT_LT(std::abs(rotor.bearing_dampers[0].shape.x[0]), 0.1) << "near a stiff bearing";
}

TEST(ModalRotor, AnisotropicBearings) {
  const ModalRotor rotor = modal_rotor(test::anisotropic_rotor());
  scene::Scene soft = test::anisotropic_rotor();
  soft.rotor.geometry->bearings[1].stiffness = {0.6e6, 0.6e6};
  const ModalRotor as_y = modal_rotor(soft);
  // Each plane on its own is the isotropic rotor with that stiffness.
  EXPECT_LT((frequencies(rotor.y) - frequencies(as_y.y)).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((frequencies(rotor.x) - frequencies(modal_rotor(scene_of(oracle::friswell_rotor())).x))
                .cwiseAbs()
                .maxCoeff(),
            1e-7);
  // Modes of the two planes differ, so that rotation couples each with every other.
  EXPECT_GT(std::abs(rotor.gyroscopic(0, 1) - rotor.gyroscopic(1, 0)), 1e-3);
}

// The internal damping belongs to the shaft, not to a plane: as a quadratic form it is positive,
// and for bearings nearly isotropic it goes over into the diagonal.
TEST(ModalRotor, InternalDampingOfAnisotropicBearings) {
  scene::Scene s = test::anisotropic_rotor();
  s.rotor.geometry->internal_damping_ratio = 0.01;
  const ModalRotor rotor = modal_rotor(s);
  EXPECT_TRUE(Cholesky(rotor.internal_xx).positive());
  EXPECT_TRUE(Cholesky(rotor.internal_yy).positive());

  s.rotor.geometry->bearings[1].stiffness = {1e6, 1e6 * (1.0 + 1e-6)};
  const ModalRotor nearly = modal_rotor(s);
  s.rotor.geometry->bearings[1].stiffness = {1e6, 1e6};
  const ModalRotor exactly = modal_rotor(s);
  const double size = exactly.internal_xx.cwiseAbs().maxCoeff();
  EXPECT_LT((nearly.internal_xx - exactly.internal_xx).cwiseAbs().maxCoeff(), 1e-5 * size);
  EXPECT_LT((nearly.internal_xy - exactly.internal_xy).cwiseAbs().maxCoeff(), 1e-5 * size);
}

TEST(ModalRotor, RefusalsNameTheFile) {
  scene::Scene s = test::reference_rig();
  s.rotor.geometry->bearings.pop_back();
  const scene::Diagnostic one_bearing = test::refusals([&] { modal_rotor(s); }).at(0);
  EXPECT_EQ(one_bearing.file, "rotor.toml");
  EXPECT_EQ(one_bearing.key, "rotor.bearing");
}

}  // namespace
}  // namespace rotorub
