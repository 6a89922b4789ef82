// The integrator of a magnetic bearing's own feedback, against exact answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/system/model.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

#include <Eigen/Core>

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

using Complex = std::complex<double>;

constexpr double kHung = 2.0, kPull = 1e5, kPerAmpere = 80.0;  // kg, N/m, N/A
constexpr double kP = 4000.0, kI = 6e4, kD = 2.0;              // A/m, A/(m s), A s/m
constexpr double kSpring = kPerAmpere * kP - kPull;            // N/m
constexpr double kWeight = kHung * 9.81;                       // N

scene::Scene integrating() {
  scene::Scene s = test::make_scene({.mass = kHung, .clearance = 0.5e-3});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kPull}};
  s.magnetic_bearings[0].control = scene::BearingControl{
      .force_per_current = kPerAmpere, .proportional = kP, .integral = kI, .derivative = kD};
  s.run.end = 0.1;
  s.run.output_step = 1e-3;
  return s;
}

// The linear law's motion of one axis: (r, r', j) of m r'' + k_i D r' + (k_i P - k_s) r + k_i j =
// 0, j' = I r.
class LinearMotion {
 public:
  LinearMotion(double r, double rate) {
    Eigen::Matrix3d a;
    a << 0.0, 1.0, 0.0,                                                   //
        -kSpring / kHung, -kPerAmpere * kD / kHung, -kPerAmpere / kHung,  //
        kI, 0.0, 0.0;
    modes_ = real_modes(a).value();
    share_ = lu_solve(modes_.vectors, Eigen::VectorXcd(Eigen::Vector3cd(r, rate, 0.0)));
  }
  double at(double t) const {
    Complex sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += modes_.vectors(0, k) * share_[k] * std::exp(modes_.values[k] * t);
    return sum.real();
  }

 private:
  EigenModes modes_;
  Eigen::Vector3cd share_;
};

TEST(MagneticIntegral, LinearLawHasAThirdPole) {
  scene::Scene s = integrating();
  s.initial.x = {1e-4};
  s.initial.vy = {0.03};
  const LinearMotion x(1e-4, 0.0), y(0.0, 0.03);
  const auto exact = [&](double t) { return Complex(x.at(t), y.at(t)); };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-13);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);  // the integrator has no energy
  test::Convergence c;
  for (const double step : {2e-4, 1e-4, 5e-5, 2e-5, 1e-5}) {
    c.steps.push_back(step);
    c.errors.push_back(test::orbit_error(run_with(s, scene::Integrator::kVerlet, step), exact));
  }
  EXPECT_GT(c.order(), 1.95) << " " << c.text();
}

// What it is there for: under a weight that comes on it brings the rotor back to the middle.
TEST(MagneticIntegral, CarriesAWeightWithoutDeflection) {
  scene::Scene s = integrating();
  s.first().contact.reset();
  s.gravity = scene::Gravity{{0.0, -kWeight / kHung}, {}};
  s.run.end = 1.0;
  const Trajectory t = run_event(s);
  const auto& y = t.column("rotor_y");
  EXPECT_GT(-*std::min_element(y.begin(), y.end()), 0.9 * kWeight / kSpring);
  EXPECT_LT(std::abs(y.back()), 1e-6 * kWeight / kSpring);
  EXPECT_NEAR(t.column("bearing_current_y").back(), kWeight / kPerAmpere, 1e-6);
}

// From the steady orbit nothing settles: weight and a turning force, by the dynamic stiffness
// k_i P - k_s - m w^2 + i w k_i D + k_i I / (i w).
TEST(MagneticIntegral, StartsOnItsSteadyOrbit) {
  constexpr double kTurns = 200.0, kSize = 30.0;  // rad/s, N
  scene::Scene s = integrating();
  s.gravity = scene::Gravity{{0.0, -kWeight / kHung}, {}};
  s.forces = {{.kind = scene::ForceKind::kRotating,
               .amplitude = kSize,
               .frequency = kTurns,
               .shape = {1.0}}};
  s.initial.steady = true;
  const Complex stiffness = Complex(kSpring - kHung * kTurns * kTurns, kTurns * kPerAmpere * kD) +
                            kPerAmpere * kI / Complex(0.0, kTurns);
  const auto exact = [&](double t) { return kSize / stiffness * std::polar(1.0, kTurns * t); };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-12);
  const Complex current =
      -(kP + Complex(0.0, kTurns * kD) + kI / Complex(0.0, kTurns)) * kSize / stiffness;
  EXPECT_NEAR(t.column("bearing_current_x").front(), current.real(), 1e-12);
  EXPECT_NEAR(t.column("bearing_current_y").front(), current.imag() + kWeight / kPerAmpere, 1e-12);
}

// Stable by Hurwitz while k_i D (k_i P - k_s) > m k_i I.
TEST(MagneticIntegral, TooMuchOfItHasNoSteadyOrbit) {
  scene::Scene s = integrating();
  s.gravity = scene::Gravity{{0.0, -9.81}, {}};
  s.initial.steady = true;
  const double border = kD * kSpring / kHung;
  s.magnetic_bearings[0].control->integral = 0.999 * border;
  EXPECT_NO_THROW(make_model(s));
  s.magnetic_bearings[0].control->integral = 1.001 * border;
  EXPECT_THROW(make_model(s), scene::SceneError);
}

// Against classical Runge-Kutta steps of its three equations, written down here once more.
TEST(MagneticIntegral, TheLimitTakesBackWhatItCutsOff) {
  static constexpr double kLimit = 0.3;                      // A
  constexpr double kPush = 25.0, kOff = 0.05, kStep = 1e-6;  // N, s, s
  scene::Scene s = integrating();
  s.first().contact.reset();
  s.magnetic_bearings[0].negative_stiffness = 0.0;
  s.magnetic_bearings[0].control->current_limit = kLimit;
  s.forces = {
      {.kind = scene::ForceKind::kConstant, .vector = {kPush, 0.0}, .off = kOff, .shape = {1.0}}};
  ASSERT_GT(kPush, kPerAmpere * kLimit);  // it is pushed away
  using Axis = std::array<double, 3>;
  const auto slope = [](const Axis& y, double force) {
    const double asked = -(kP * y[0] + kD * y[1] + y[2]), i = std::clamp(asked, -kLimit, kLimit);
    return Axis{y[1], (force + kPerAmpere * i) / kHung, kI * y[0] + (asked - i) * kI / kP};
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
  const Trajectory stepped = run_with(s, scene::Integrator::kVerlet, 1e-5);
  EXPECT_LT(test::rotor_error(stepped, t), 1e-4 * size);
}

}  // namespace
}  // namespace rotorub
