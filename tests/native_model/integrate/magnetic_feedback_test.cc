// A magnetic bearing that holds the rotor by its own feedback, against exact answers: its current
// at the limit, its integrator, the fall after it has failed.
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/model/model.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

using Complex = std::complex<double>;

constexpr double kHeld = 2.0, kNegative = 1e5;               // kg, N/m
constexpr double kForce = 80.0, kProportional = 4000.0;      // N/A, A/m
constexpr double kDerivative = 2.0;                          // A s/m
constexpr double kNet = kForce * kProportional - kNegative;  // N/m
constexpr double kGravity = 9.81;                            // m/s^2

// A rigid mode that only the bearing holds.
scene::Scene levitated() {
  scene::Scene s = test::make_scene({.mass = kHeld, .clearance = 0.5e-3});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kNegative}};
  s.magnetic_bearings[0].control = scene::BearingControl{
      .force_per_current = kForce, .proportional = kProportional, .derivative = kDerivative};
  s.run.end = 0.05;
  s.run.output_step = 1e-3;
  return s;
}

// The current as in the linear law, and its force at the limit.
TEST(MagneticFeedback, CurrentIsAColumn) {
  scene::Scene s = levitated();
  s.initial.x = {1e-4};
  s.initial.vy = {0.03};
  s.magnetic_bearings[0].control->current_limit = 0.2;
  s.magnetic_bearings[0].control->fails_at = 0.0205;
  const Trajectory t = run_event(s);
  const auto current = [](double r, double rate) {
    return std::clamp(-(kProportional * r + kDerivative * rate), -0.2, 0.2);
  };
  bool limited = false, linear = false;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const bool works = t.column("t")[k] < 0.0205;
    const double x = current(t.column("rotor_x")[k], t.column("rotor_vx")[k]);
    const double y = current(t.column("rotor_y")[k], t.column("rotor_vy")[k]);
    EXPECT_EQ(t.column("bearing_current_x")[k], works ? x : 0.0) << k;
    EXPECT_EQ(t.column("bearing_current_y")[k], works ? y : 0.0) << k;
    limited = limited || std::abs(x) == 0.2;
    linear = linear || (x != 0.0 && std::abs(x) < 0.1);
  }
  EXPECT_TRUE(limited && linear);
  EXPECT_FALSE(run_event(test::make_scene({.stiffness = 2e5})).has("bearing_current_x"));
}

// At the limit I the force is constant: a parabola of -k_i I / m; once |P x| < I, the spring k_i P.
TEST(MagneticFeedback, AtTheLimitTheForceIsConstant) {
  constexpr double kLimit = 0.5, kStart = 4e-4;
  scene::Scene s = levitated();
  s.magnetic_bearings[0].negative_stiffness = 0.0;
  s.magnetic_bearings[0].control->derivative = 0.0;
  s.magnetic_bearings[0].control->current_limit = kLimit;
  s.initial.x = {kStart};
  const double a = kForce * kLimit / kHeld, border = kLimit / kProportional;
  const double reached = std::sqrt(2.0 * (kStart - border) / a), speed = -a * reached;
  const double omega = std::sqrt(kForce * kProportional / kHeld);
  const auto exact = [&](double t) -> Complex {
    if (t < reached) return kStart - 0.5 * a * t * t;
    const double since = t - reached;
    return border * std::cos(omega * since) + speed / omega * std::sin(omega * since);
  };
  s.run.output_step = 1e-4;
  s.run.end = 0.005;
  ASSERT_LT(s.run.end, reached);
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    EXPECT_LT(test::orbit_error(run_with(s, integrator), exact), 1e-12 * kStart)
        << static_cast<int>(integrator);
  }
  // In the linear range the current has a kink there, but does not jump.
  s.run.end = 0.006;
  ASSERT_LT(reached, 0.9 * s.run.end);
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-9 * kStart);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  // The error at the kink depends on its place in the step, so neighbouring steps scatter.
  test::expect_order_of_steps(
      s, {2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6, 2e-6}, 1.85,
      [&](const Trajectory& run) { return test::orbit_error(run, exact); }, 1e-3 * kStart);
}

// After the failure the rotor falls freely from where it was to the ring.
TEST(MagneticFeedback, FailsAndTheRotorFalls) {
  constexpr double kFails = 3.3e-3;
  scene::Scene s = levitated();
  s.first().contact->restitution = 0.5;
  s.gravity = scene::Gravity{{0.0, -kGravity}, {}};
  s.initial.steady = true;
  s.magnetic_bearings[0].control->fails_at = kFails;
  s.run.output_step = 1e-4;
  const double sag = kHeld * kGravity / kNet, fall = s.first().contact->clearance - sag;
  const double touch = kFails + std::sqrt(2.0 * fall / kGravity);
  s.run.end = touch - 1e-4;
  const auto exact = [&](double t) {
    const double since = std::max(0.0, t - kFails);
    return Complex(0.0, -sag - 0.5 * kGravity * since * since);
  };
  EXPECT_LT(test::orbit_error(run_event(s), exact), 1e-9 * s.first().contact->clearance);
  s.run.end = touch + 1e-3;
  const Trajectory t = run_event(s);
  ASSERT_FALSE(t.impacts.empty());
  EXPECT_NEAR(t.impacts[0].t, touch, 1e-9 * touch);
  EXPECT_NEAR(t.impacts[0].gap_rate_before, -std::sqrt(2.0 * kGravity * fall), 1e-9);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  const Trajectory stepped = run_with(s, scene::Integrator::kVerlet);
  ASSERT_FALSE(stepped.impacts.empty());
  EXPECT_NEAR(stepped.impacts[0].t, touch, 1e-5);
}

// Stable by Hurwitz while k_i D (k_i P - k_s) > m k_i I.
TEST(MagneticIntegral, TooMuchOfItHasNoSteadyOrbit) {
  scene::Scene s = levitated();
  s.gravity = scene::Gravity{{0.0, -9.81}, {}};
  s.initial.steady = true;
  const double border = kDerivative * kNet / kHeld;
  s.magnetic_bearings[0].control->integral = 0.999 * border;
  EXPECT_NO_THROW(prepare(s));
  s.magnetic_bearings[0].control->integral = 1.001 * border;
  EXPECT_THROW(prepare(s), scene::SceneError);
}

// Against classical Runge-Kutta steps of its three equations, written down here once more.
TEST(MagneticIntegral, TheLimitTakesBackWhatItCutsOff) {
  static constexpr double kLimit = 0.3, kIntegral = 6e4;     // A, A/(m s)
  constexpr double kPush = 25.0, kOff = 0.05, kStep = 1e-6;  // N, s, s
  scene::Scene s = levitated();
  s.first().contact.reset();
  s.run.end = 0.1;
  s.magnetic_bearings[0].negative_stiffness = 0.0;
  s.magnetic_bearings[0].control->integral = kIntegral;
  s.magnetic_bearings[0].control->current_limit = kLimit;
  s.forces = {
      {.kind = scene::ForceKind::kConstant, .vector = {kPush, 0.0}, .off = kOff, .shape = {1.0}}};
  ASSERT_GT(kPush, kForce * kLimit);  // it is pushed away
  using Axis = std::array<double, 3>;
  const auto slope = [](const Axis& y, double force) {
    const double asked = -(kProportional * y[0] + kDerivative * y[1] + y[2]),
                 i = std::clamp(asked, -kLimit, kLimit);
    return Axis{y[1], (force + kForce * i) / kHeld,
                kIntegral * y[0] + (asked - i) * kIntegral / kProportional};
  };
  Axis y{};
  std::vector<double> exact{0.0};
  const auto moved = [](const Axis& from, const Axis& by, double h) {
    return Axis{from[0] + h * by[0], from[1] + h * by[1], from[2] + h * by[2]};
  };
  double held = 0.0;
  for (int k = 0; k < 100'000; ++k) {
    const double force = k * kStep < kOff - 0.5 * kStep ? kPush : 0.0;
    const Axis a = slope(y, force), b = slope(moved(y, a, 0.5 * kStep), force);
    const Axis c = slope(moved(y, b, 0.5 * kStep), force), d = slope(moved(y, c, kStep), force);
    for (int i = 0; i < 3; ++i) y[i] += kStep / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    held = std::max(held, y[2]);
    if ((k + 1) % 1000 == 0) exact.push_back(y[0]);
  }
  EXPECT_LT(std::abs(held), 3.0 * kLimit);  // it does not wind up
  const Trajectory t = run_event(s);
  ASSERT_EQ(t.rows(), exact.size());
  double size = 0.0;
  for (const double x : exact) size = std::max(size, std::abs(x));
  ASSERT_GT(size, 1e-5);
  for (std::size_t k = 0; k < exact.size(); ++k)
    EXPECT_NEAR(t.column("rotor_x")[k], exact[k], 1e-8 * size) << k;
  EXPECT_LT(test::rotor_error(run_with(s, scene::Integrator::kVerlet, 1e-5), t), 1e-4 * size);
}

// ---------------------------------------------------------------- sensors elsewhere
// A magnetic bearing whose sensor stands elsewhere: against the matrix of its linear law.

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

// A sensor beyond a node of the mode that the bearing damps makes the mode grow.
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
