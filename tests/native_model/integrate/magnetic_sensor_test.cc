// A magnetic bearing whose sensor stands elsewhere: against the matrix of its linear law.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

// Two modes of unequal planes, a magnetic bearing u with its sensor s and one where it stands.
constexpr const char* kTwoModes = R"(
[run]
end = 0.02
output_step = 1e-3
[rotor]
speed = 200.0
[rotor.modal]
mass = [2.0, 0.7]
stiffness = [1e5, 9e5]
damping = [30.0, 20.0]
gyroscopic = [0.05, 0.02]
[[magnetic_bearing]]
shape = [0.9, 0.4]
sensor_shape = [0.8, -0.3]
negative_stiffness = 3e4
[magnetic_bearing.control]
force_per_current = 40.0
proportional = 3000.0
derivative = 2.0
[[magnetic_bearing]]
shape = [0.5, -0.6]
negative_stiffness = 2e4
[magnetic_bearing.control]
force_per_current = 60.0
proportional = 1500.0
derivative = 1.0
[initial]
x = [1e-4, -2e-5]
vy = [0.05, 0.02]
)";

scene::Scene sensed_elsewhere(const std::vector<std::string>& overrides) {
  return scene::parse_scene(kTwoModes, "modes.toml", overrides);
}

// y' = A y of y = (x, y, x', y'), or with integrals (.., j_1x, j_2x, j_1y, j_2y).
Eigen::MatrixXd closed_loop(double integral) {
  const Eigen::Vector2d mass(2.0, 0.7);
  const Eigen::Vector2d u1(0.9, 0.4), s1(0.8, -0.3), u2(0.5, -0.6);
  const Eigen::Matrix2d k = Eigen::Vector2d(1e5, 9e5).asDiagonal().toDenseMatrix() -
                            3e4 * u1 * u1.transpose() + 40.0 * 3000.0 * u1 * s1.transpose() +
                            (60.0 * 1500.0 - 2e4) * u2 * u2.transpose();
  const Eigen::Matrix2d d = Eigen::Vector2d(30.0, 20.0).asDiagonal().toDenseMatrix() +
                            40.0 * 2.0 * u1 * s1.transpose() + 60.0 * u2 * u2.transpose();
  const Eigen::Matrix2d g = 200.0 * Eigen::Vector2d(0.05, 0.02).asDiagonal().toDenseMatrix();
  const Eigen::Matrix2d inverse = mass.cwiseInverse().asDiagonal();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(12, 12);
  a.block(0, 4, 4, 4).setIdentity();
  for (int plane = 0; plane < 2; ++plane) {
    const int q = 2 * plane, v = 4 + q, j = 8 + q;
    a.block(v, q, 2, 2) = -inverse * k;
    a.block(v, v, 2, 2) = -inverse * d;
    a.block(v, j, 2, 1) = -inverse * u1 * 40.0;
    a.block(v, j + 1, 2, 1) = -inverse * u2 * 60.0;
    a.block(j, q, 1, 2) = integral * s1.transpose();
    a.block(j + 1, q, 1, 2) = integral * u2.transpose();
  }
  a.block(4, 6, 2, 2) = -inverse * g;
  a.block(6, 4, 2, 2) = inverse * g;
  return integral > 0.0 ? a : Eigen::MatrixXd(a.topLeftCorner(8, 8));
}

TEST(MagneticSensor, ElsewhereGivesTheEigenvaluesOfItsMatrix) {
  const scene::Scene s = sensed_elsewhere({});
  const Eigen::VectorXcd exact = real_modes(closed_loop(0.0)).value().values;
  const std::vector<std::complex<double>> found = whirl_eigenvalues(whirl_system(s), 200.0);
  ASSERT_GE(found.size(), 4u);
  for (const std::complex<double>& value : found) {
    const double by = (exact.array() - value).abs().minCoeff();
    EXPECT_LT(by, 1e-10 * std::abs(value)) << value;
  }
}

// The linear law in closed form, y(t) = e^{A t} y(0), with the integrators too.
TEST(MagneticSensor, ElsewhereMovesTheRotorAsItsMatrixDoes) {
  for (const double integral : {0.0, 1e5}) {
    const scene::Scene s =
        sensed_elsewhere({"magnetic_bearing.control.integral=" + std::to_string(integral)});
    const Eigen::MatrixXd a = closed_loop(integral);
    const EigenModes modes = real_modes(a).value();
    Eigen::VectorXd start = Eigen::VectorXd::Zero(a.rows());
    start[0] = 1e-4;
    start[1] = -2e-5;
    start[6] = 0.05;
    start[7] = 0.02;
    const Eigen::VectorXcd shares =
        lu_solve(modes.vectors, Eigen::VectorXcd(start.cast<std::complex<double>>()));
    const Trajectory event = run_event(s);
    const auto exact = [&](double t) {
      const Eigen::VectorXcd decay = (modes.values * t).array().exp();
      return Eigen::VectorXd((modes.vectors * shares.cwiseProduct(decay)).real());
    };
    const auto error = [&](const Trajectory& t) {
      double most = 0.0;
      for (std::size_t k = 0; k < t.rows(); ++k) {
        const Eigen::VectorXd y = exact(t.column("t")[k]);
        most = std::max({most, std::abs(t.column("x_1")[k] - y[0]),
                         std::abs(t.column("x_2")[k] - y[1]), std::abs(t.column("y_2")[k] - y[3])});
      }
      return most;
    };
    EXPECT_LT(error(event), 1e-12) << integral;
    EXPECT_LT(event.statistics.energy_residual(), 1e-9);
    const double coarse = error(run_with(s, scene::Integrator::kVerlet, 2e-5)),
                 fine = error(run_with(s, scene::Integrator::kVerlet, 1e-5));
    EXPECT_LT(fine, 0.27 * coarse);
    EXPECT_LT(fine, 2e-8);
  }
}

// Beyond a node of the mode that it damps a sensor drives it.
TEST(MagneticSensor, BehindANodeMakesTheMachineUnstable) {
  const auto threshold = [](const char* shape) {
    return stability_threshold(
        whirl_system(
            sensed_elsewhere({std::string("magnetic_bearing[0].sensor_shape=") + shape,
                              "rotor.modal.damping=[0.0,0.0]", "rotor.modal.gyroscopic=[0.0,0.0]",
                              "magnetic_bearing[1].control.derivative=0"})),
        1.0);
  };
  EXPECT_EQ(threshold("[0.9,-0.4]"), 0.0);
  EXPECT_FALSE(threshold("[0.9,0.4]"));
}

}  // namespace
}  // namespace rotorub
