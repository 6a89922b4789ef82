// The mass matrix and what follows from it, against dense algebra on a matrix that the tests take
// from the kinetic energy.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "native_model/model/dynamics.h"
#include "native_model/model/model_checks.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/scene.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

// Relative, of dense solves with a condition number of 1e4.
constexpr double kDense = 1e-10;

Eigen::VectorXd random_vector(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Eigen::VectorXd f(n);
  for (int i = 0; i < n; ++i) f[i] = 100.0 * unit(random);
  return f;
}

// The contact Jacobian, 3 x nq, from the kinematics: (relative x, relative y, spin at the contact).
Eigen::MatrixXd contact_jacobian(const Model& m, const State& s) {
  Eigen::MatrixXd j(3, m.nq());
  for (int i = 0; i < m.nq(); ++i) {
    const Eigen::VectorXd e = Eigen::VectorXd::Unit(m.nq(), i);
    const ContactPoint p = contact_point(m, s.q.data(), e.data());
    j.col(i) << p.dv.x(), p.dv.y(), p.spin - (m.layout.spin ? 0.0 : m.speed);
  }
  return j;
}

TEST(SolveMass, WithUnbalanceOnAFreeSpinAgainstDense) {
  const Model m = test::machine(true);
  ASSERT_TRUE(m.coupled_mass());
  double coupling = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const State s = test::random_state(m, seed);
    const Eigen::MatrixXd mass = test::mass_matrix(m, s);
    const Eigen::VectorXd f = random_vector(m.nq(), 100 + seed);
    const Eigen::VectorXd exact = Cholesky(mass).solve(f);
    Eigen::VectorXd a(m.nq()), in_place = f;
    solve_mass(m, s.t, s.q.data(), f.data(), a.data());
    EXPECT_LT((a - exact).norm(), kDense * exact.norm());
    solve_mass(m, s.t, s.q.data(), in_place.data(), in_place.data());
    EXPECT_EQ(in_place, a);
    const int phi = m.layout.phi();
    coupling = std::max(coupling, std::abs(f[phi] / m.mass[phi] / exact[phi] - 1.0));
  }
  EXPECT_GT(coupling, 0.1) << "without the coupling the spin would go another way";
}

// The bound on the spin's inertia, against a turn in small steps. (The machine's own spin inertia
// is above it.)
TEST(UnbalanceInertia, IsTheLargestOfATurn) {
  const Model m = test::machine(true);
  State s = test::random_state(m, 1);
  const int phi = m.layout.phi();
  double largest = 0.0, least = 1e300;
  constexpr int kSteps = 1440;
  for (int i = 0; i < kSteps; ++i) {
    s.q[phi] = 2.0 * std::numbers::pi * i / kSteps;
    const Eigen::MatrixXd mass = test::mass_matrix(m, s);
    Eigen::VectorXd b = mass.col(phi);
    b[phi] = 0.0;
    const double taken = b.cwiseAbs2().dot(m.mass.cwiseInverse());
    largest = std::max(largest, taken);
    least = std::min(least, taken);
  }
  EXPECT_LT(least, 0.99 * largest) << "anisotropic: it changes over a turn";
  EXPECT_NEAR(unbalance_inertia(m), largest, 1e-5 * largest);  // of a grid of 0.25 degrees
  EXPECT_GE(unbalance_inertia(m), largest * (1.0 - 1e-14));
  EXPECT_EQ(unbalance_inertia(test::machine(false)), 0.0);
}

TEST(SolveMass, AnotherDiagonalTakesThePlaceOfTheMasses) {
  const Model m = test::machine(true);
  const State s = test::random_state(m, 4);
  const Eigen::VectorXd diagonal = m.mass + 1e-3 * m.damping;
  Eigen::MatrixXd mass = test::mass_matrix(m, s);
  mass.diagonal() += diagonal - m.mass;
  const Eigen::VectorXd f = random_vector(m.nq(), 5), exact = Cholesky(mass).solve(f);
  Eigen::VectorXd a(m.nq());
  solve_mass(m, diagonal.data(), s.t, s.q.data(), f.data(), a.data());
  EXPECT_LT((a - exact).norm(), kDense * exact.norm());
}

TEST(ContactAdmittance, WithUnbalanceOnAFreeSpinAgainstDense) {
  Model m = test::machine(true);
  m.first().shape.x[0] = m.first().shape.y[1] = 0.0;  // modes with a node at the contact
  m.first().torsion_shape[1] = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const State s = test::random_state(m, seed);
    const Eigen::MatrixXd j = contact_jacobian(m, s);
    const Eigen::Matrix3d exact =
        j * Cholesky(test::mass_matrix(m, s)).solve(Eigen::MatrixXd(j.transpose()));
    const Eigen::Matrix3d a = contact_admittance(m, s.t, s.q.data());
    // Entries differ by orders of magnitude (1/kg beside 1/(kg m^2)): scaled by the diagonal.
    const Eigen::Vector3d scale = exact.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix3d error = scale.asDiagonal() * (a - exact) * scale.asDiagonal();
    EXPECT_LT(error.norm(), kDense);
    const Eigen::Matrix3d off = scale.asDiagonal() * exact * scale.asDiagonal();
    EXPECT_GT(std::abs(off(0, 2)) + std::abs(off(1, 2)), 0.05) << "spin and bending are coupled";
  }
}

TEST(ContactAdmittance, IsConstantWithoutThatCoupling) {
  for (const bool drive : {true, false}) {
    const Model m = prepare(test::machine_scene(drive));
    const State s = test::random_state(m, 8);
    const Eigen::MatrixXd j = contact_jacobian(m, s);
    const Eigen::Matrix3d exact = j * m.mass.cwiseInverse().asDiagonal() * j.transpose();
    EXPECT_LT((m.first().admittance - exact).norm(), kDense * exact.norm());
    EXPECT_EQ(contact_admittance(m, s.t, s.q.data()), m.first().admittance);
    // A held speed is an infinite inertia: only torsion lets the contact turn.
    const double torsion = 1.0 / 4e-4 + 1.0 / 1e-4;
    EXPECT_DOUBLE_EQ(m.first().admittance(2, 2), torsion + (drive ? 1.0 / 1e-3 : 0.0));
  }
}

TEST(ModeMatrix, CostsWhatItIsAndAgreesWithDense) {
  const Eigen::Matrix3d full{{1.0, 2.0, 0.0}, {-3.0, 4.0, 5.0}, {0.5, 0.0, -6.0}};
  const Eigen::Matrix3d diagonal = Eigen::Vector3d(1.0, 0.0, -2.0).asDiagonal();
  EXPECT_EQ(ModeMatrix(full).kind(), ModeMatrix::Kind::kFull);
  EXPECT_EQ(ModeMatrix(diagonal).kind(), ModeMatrix::Kind::kDiagonal);
  EXPECT_EQ(ModeMatrix(Eigen::Matrix3d::Zero()).kind(), ModeMatrix::Kind::kAbsent);
  EXPECT_TRUE(ModeMatrix(Eigen::MatrixXd()).absent());
  const Eigen::Vector3d in{0.3, -0.7, 1.1}, start{1.0, 2.0, 3.0};
  for (const Eigen::Matrix3d& a : {full, diagonal, Eigen::Matrix3d(Eigen::Matrix3d::Zero())}) {
    const ModeMatrix matrix(a);
    EXPECT_EQ(matrix.dense(3), a);
    Eigen::Vector3d out = start, transposed = start;
    matrix.add(-2.0, in.data(), out.data(), 3);
    matrix.add_transposed(-2.0, in.data(), transposed.data(), 3);
    EXPECT_LT((out - (start - 2.0 * a * in)).norm(), 1e-14);
    EXPECT_LT((transposed - (start - 2.0 * a.transpose() * in)).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace rotorub
