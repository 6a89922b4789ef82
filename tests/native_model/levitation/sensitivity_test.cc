// Poles and sensitivities of magnetic bearings' loops, against closed forms and dense responses.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "native_model/linear/levitation.h"
#include "native_model/linear/linear_loop.h"
#include "native_model/model/linear_parts.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using Phasor = std::complex<double>;

constexpr double kMass = 2.0, kPullOf = 1e5, kForceOf = 80.0;  // kg, N/m, N/A
constexpr double kStiff = 4000.0, kDamps = 2.0;                // A/m, A s/m

scene::Scene hung(const scene::BearingControl& control) {
  scene::Scene s = test::make_scene({.mass = kMass});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kPullOf}};
  s.magnetic_bearings[0].control = control;
  s.magnetic_bearings[0].control->force_per_current = kForceOf;
  return s;
}

double relative(Phasor a, Phasor b) { return std::abs(a - b) / std::abs(b); }

// S = (-m w^2 - k_s) / (-m w^2 + i w k_i D + k_i P - k_s).
TEST(Levitation, OneMassHasItsClosedForm) {
  const Model m = prepare(hung({.proportional = kStiff, .derivative = kDamps}));
  const auto exact = [](double w) {
    const double plant = -kMass * w * w - kPullOf;
    return plant / (plant + kForceOf * Phasor(kStiff, w * kDamps));
  };
  const LoopResponse response(m, 0.0);
  double peak = 0.0, where = 0.0;
  for (double w = 1.0; w < 1e5; w *= 1.0001) {
    if (std::abs(exact(w)) > peak) peak = std::abs(exact(w)), where = w;
  }
  for (double w = 1.0; w < 1e5; w *= 1.7) {
    EXPECT_LT(relative(response.sensitivity(w)(0, 0), exact(w)), 1e-12) << w;
    EXPECT_EQ(response.sensitivity(w)(0, 1), 0.0);
  }
  const Levitation all = levitation(m, 0.0);
  ASSERT_EQ(all.loops.size(), 2u);
  for (const LoopSensitivity& loop : all.loops) {
    EXPECT_GE(loop.peak, peak);
    EXPECT_LT(loop.peak, (1.0 + 1e-6) * peak);
    EXPECT_NEAR(loop.frequency, where, 1e-3 * where);
  }
  ASSERT_EQ(all.poles.size(), 4u);
  const double delta = 0.5 * kForceOf * kDamps / kMass;
  const double spring = (kForceOf * kStiff - kPullOf) / kMass;
  for (const Phasor& s : all.poles) {
    EXPECT_NEAR(s.real(), -delta, 1e-10 * delta);
    EXPECT_NEAR(std::abs(s), std::sqrt(spring), 1e-10 * std::sqrt(spring));
  }
  EXPECT_TRUE(all.stable());
}

TEST(Levitation, ZonesAreThoseOfIso14839) {
  EXPECT_EQ(sensitivity_zone(2.99), 'A');
  EXPECT_EQ(sensitivity_zone(3.0), 'B');
  EXPECT_EQ(sensitivity_zone(4.0), 'C');
  EXPECT_EQ(sensitivity_zone(5.0), 'D');
  // 9.5, 12 and 14 dB.
  EXPECT_NEAR(20.0 * std::log10(3.0), 9.5, 0.05);
  EXPECT_NEAR(20.0 * std::log10(4.0), 12.0, 0.05);
  EXPECT_NEAR(20.0 * std::log10(5.0), 14.0, 0.05);
}

// Two modes of a turning rotor, two bearings, all that a loop may have: against loops opened one by
// one in a state space written here.
TEST(Levitation, LoopsOpenedOneByOne) {
  const std::string text = R"(
[run]
end = 0.02
[rotor]
speed = 200.0
[rotor.modal]
mass = [2.0, 0.7]
stiffness = [1e5, 9e5]
damping = [30.0, 20.0]
gyroscopic = [0.05, 0.02]
[[magnetic_bearing]]
shape = [0.9, 0.4]
sensor_shape = [0.8, 0.3]
negative_stiffness = 3e4
[magnetic_bearing.control]
force_per_current = 40.0
proportional = 3000.0
integral = 3e4
derivative = 2.0
derivative_lag = 2e-4
current_limit = 1.0
[magnetic_bearing.amplifier]
bandwidth = 8000.0
[[magnetic_bearing]]
shape = [0.5, -0.6]
negative_stiffness = 2e4
[magnetic_bearing.control]
force_per_current = 60.0
proportional = 1500.0
derivative = 1.0
fails_at = 5.0
)";
  const Model m = prepare(scene::parse_scene(text, "loops.toml", {}));
  // (q, v) of (x_1, x_2, y_1, y_2), then of the first bearing j, d, i on x and on y. input: what
  // each port's control is shown beside its sensor.
  const Eigen::Vector2d mass(2.0, 0.7), u1(0.9, 0.4), s1(0.8, 0.3), u2(0.5, -0.6);
  const Eigen::Matrix2d inverse = mass.cwiseInverse().asDiagonal();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(14, 14), seen = Eigen::MatrixXd::Zero(4, 14);
  Eigen::MatrixXd rate = seen, input = Eigen::MatrixXd::Zero(14, 4), slope = input;
  a.block(0, 4, 4, 4).setIdentity();
  const Eigen::Matrix2d k = Eigen::Vector2d(1e5, 9e5).asDiagonal().toDenseMatrix() -
                            3e4 * u1 * u1.transpose() - 2e4 * u2 * u2.transpose();
  const Eigen::Matrix2d g = 200.0 * Eigen::Vector2d(0.05, 0.02).asDiagonal().toDenseMatrix();
  for (int plane = 0; plane < 2; ++plane) {
    const int q = 2 * plane, v = 4 + q, j = 8 + 3 * plane;
    a.block(v, q, 2, 2) = -inverse * k;
    a.block(v, v, 2, 2) = -inverse * Eigen::Vector2d(30.0, 20.0).asDiagonal().toDenseMatrix();
    a.block(v, j + 2, 2, 1) = 40.0 * inverse * u1;
    seen.block(plane, q, 1, 2) = rate.block(plane, v, 1, 2) = s1.transpose();
    seen.block(2 + plane, q, 1, 2) = rate.block(2 + plane, v, 1, 2) = u2.transpose();
    a(j + 1, j + 1) = -1.0 / 2e-4;
    a.row(j + 2).segment(j, 3) = -8000.0 * Eigen::RowVector3d(1.0, 2.0, 1.0);
    // Input from the port's deflection and its rate.
    input(j, plane) = 3e4;
    input(j + 2, plane) = -8000.0 * 3000.0;
    slope(j + 1, plane) = 1.0 / 2e-4;
    input.col(2 + plane).segment(v, 2) = -60.0 * 1500.0 * inverse * u2;
    slope.col(2 + plane).segment(v, 2) = -60.0 * 1.0 * inverse * u2;
  }
  a.block(4, 6, 2, 2) = -inverse * g;
  a.block(6, 4, 2, 2) = inverse * g;
  const Eigen::MatrixXd closed = a + input * seen + slope * rate;
  const LoopResponse response(m, 200.0);
  ASSERT_EQ(response.ports(), 4);
  std::vector<double> peaks(4, 0.0);
  for (double w = 3.0; w < 3e4; w *= 1.002) {
    const Eigen::MatrixXcd at = response.sensitivity(w);
    for (Eigen::Index port = 0; port < 4; ++port) {
      // Without its own feedback, and what goes round then: L = -y / (what the control is shown).
      const Eigen::MatrixXd open =
          closed - input.col(port) * seen.row(port) - slope.col(port) * rate.row(port);
      const Eigen::MatrixXcd turned =
          Phasor(0.0, w) * Eigen::MatrixXcd::Identity(14, 14) - open.cast<Phasor>();
      const Eigen::VectorXcd shown =
          input.col(port).cast<Phasor>() + Phasor(0.0, w) * slope.col(port).cast<Phasor>();
      const Phasor loop = -(seen.row(port).cast<Phasor>() * lu_solve(turned, shown))(0);
      EXPECT_LT(relative(at(port, port), 1.0 / (1.0 + loop)), 1e-9) << w << " " << port;
      auto& peak = peaks[static_cast<std::size_t>(port)];
      peak = std::max(peak, std::abs(at(port, port)));
    }
  }
  const Levitation all = levitation(m, 200.0);
  for (std::size_t port = 0; port < 4; ++port) {
    EXPECT_GE(all.loops[port].peak, peaks[port] * (1.0 - 1e-12)) << port;
    EXPECT_LT(all.loops[port].peak, peaks[port] * 1.001) << port;
    EXPECT_EQ(all.loops[port].bearing, port / 2);
  }
  const std::vector<Phasor> poles = real_eigenvalues(closed).value();
  ASSERT_EQ(all.poles.size(), poles.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    EXPECT_LT(relative(all.poles[i], poles[i]), 1e-9) << i;
  }
}

// K(z) = P + D (1 - 1/z) / T, held over T and two samples late, before k_i / (-m w^2 - k_s); its
// poles are those of the map of one sample.
TEST(Levitation, SampledLoopHasItsHoldAndDelay) {
  static constexpr double kT = 1e-4;
  const Model m = prepare(
      hung({.proportional = kStiff, .derivative = kDamps, .sample_time = kT, .delay = 2.0 * kT}));
  const auto exact = [](double w) {
    const Phasor turn(0.0, w * kT), z = std::exp(turn);
    const Phasor law = (kStiff + kDamps * (1.0 - 1.0 / z) / kT) * (1.0 - 1.0 / z) / turn / (z * z);
    return 1.0 / (1.0 + kForceOf * law / (-kMass * w * w - kPullOf));
  };
  const LoopResponse response(m, 0.0);
  double peak = 0.0;
  for (double w = 10.0; w < std::numbers::pi / kT; w *= 1.0002) {
    peak = std::max(peak, std::abs(exact(w)));
  }
  for (double w = 10.0; w < std::numbers::pi / kT; w *= 1.3) {
    EXPECT_LT(relative(response.sensitivity(w)(1, 1), exact(w)), 1e-11) << w;
  }
  const Levitation all = levitation(m, 0.0);
  EXPECT_GE(all.loops[0].peak, peak);
  EXPECT_LT(all.loops[0].peak, (1.0 + 1e-5) * peak);
  EXPECT_EQ(all.sample_time, kT);
  // r'' = (k_s r + k_i i) / m over a sample by cosh and sinh; then (r, v, r before, i held, next).
  const double k = std::sqrt(kPullOf / kMass), c = std::cosh(k * kT), s = std::sinh(k * kT);
  // Currents in 10 kA, so that no entry is far from the others.
  constexpr double kUnit = 1e4;
  const double push = kUnit * kForceOf / kPullOf;  // where k_i i holds against k_s
  Eigen::MatrixXd sample = Eigen::MatrixXd::Zero(6, 6), move = sample;
  // At each sample the queue moves first: held, next, last; r stays as the one before.
  sample(0, 0) = sample(1, 1) = 1.0;
  sample(2, 0) = 1.0;
  sample(3, 4) = 1.0;
  sample(4, 5) = 1.0;
  sample(5, 0) = -(kStiff + kDamps / kT) / kUnit;
  sample(5, 2) = kDamps / kT / kUnit;
  move.setIdentity();
  move.topLeftCorner(2, 2) << c, s / k, s * k, c;
  move(0, 3) = push * (c - 1.0);
  move(1, 3) = push * s * k;
  std::vector<Phasor> poles;
  const std::vector<Phasor> turns = real_eigenvalues(move * sample).value();
  for (const Phasor& z : turns) {
    if (std::abs(z) > 1e-3) poles.push_back(std::log(z) / kT);
  }
  // The same on both axes.
  ASSERT_EQ(all.poles.size(), 2 * poles.size());
  for (const Phasor& pole : poles) {
    const auto near = std::ranges::count_if(
        all.poles, [&](const Phasor& other) { return relative(other, pole) < 1e-6; });
    EXPECT_EQ(near, 2) << pole;
  }
}

// rad/s, sum of the real parts of the poles to the right of the imaginary axis, with all loops
// open.
double unstable_poles(Model open, double speed) {
  for (StationFeedback& f : open.feedbacks) f.law.proportional = f.law.derivative = 0.0;
  const LinearParts parts = linear_parts(open, speed);
  const Eigen::Index n = parts.mass.size();
  const Eigen::MatrixXd inverse = parts.mass.cwiseInverse().asDiagonal();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  a.topRightCorner(n, n).setIdentity();
  a.bottomLeftCorner(n, n) = -inverse * parts.stiffness;
  a.bottomRightCorner(n, n) = -inverse * parts.damping;
  double sum = 0.0;
  const std::vector<Phasor> poles = real_eigenvalues(a).value();
  for (const Phasor& s : poles) sum += std::max(0.0, s.real());
  return sum;
}

// Bode's integral over all w > 0 (J. S. Freudenberg, D. P. Looze, "Frequency domain properties of
// scalar and multivariable feedback systems", 1988): with the open loops L,
//   int ln |det S| dw = pi (sum of L's unstable poles) - (pi / 2) lim s tr L(s).
// The limit is 0 if L falls by two orders. Sampled laws work continuously here.
TEST(Levitation, BodesIntegralOfEveryMagneticScene) {
  for (const char* name : {"amb_machine", "drop", "relevitation", "touchdown"}) {
    SCOPED_TRACE(name);
    scene::Scene s = test::shipped(name);
    for (scene::MagneticBearing& bearing : s.magnetic_bearings) {
      if (bearing.control) bearing.control->sample_time = bearing.control->delay = 0.0;
    }
    const Model m = prepare(s);
    const double speed = s.rotor.speed;
    const LoopResponse response(m, speed);
    const auto integrand = [&](double w) {
      return -std::log(std::abs(response.return_difference(w).determinant()));
    };
    // Evenly spaced in ln w, closest where the weakly damped modes are; beyond the last frequency
    // the integrand falls with the square.
    struct Range {
      double from, to;  // rad/s
      int points;
    };
    constexpr double kLast = 1e7;
    double sum = kLast * integrand(kLast);
    for (const Range& range : {Range{0.1, 1e3, 400}, {1e3, 5e4, 1000}, {5e4, kLast, 150}}) {
      const double step = std::log(range.to / range.from) / range.points;
      for (int k = 0; k < range.points; ++k) {
        const double w = range.from * std::exp((k + 0.5) * step);
        sum += step * w * integrand(w);
      }
    }
    const Eigen::Index ports = response.ports();
    const Eigen::MatrixXcd open =
        response.return_difference(kLast) - Eigen::MatrixXcd::Identity(ports, ports);
    const double limit = (Phasor(0.0, kLast) * open.trace()).real();
    const double unstable = std::numbers::pi * unstable_poles(always_working(m), speed);
    EXPECT_GT(unstable, 1000.0);
    EXPECT_NEAR(sum, unstable - 0.5 * std::numbers::pi * limit, 2e-3 * unstable);
  }
}

// A control that never works has no loop.
TEST(Levitation, WithoutALoopSaysNothing) {
  scene::Scene s = hung({.proportional = kStiff, .derivative = kDamps});
  s.rotor.modal->stiffness = {2e5};
  s.magnetic_bearings[0].control->fails_at = 0.0;
  EXPECT_TRUE(levitation(prepare(s), 0.0).loops.empty());
  // One that is switched on later works.
  s.magnetic_bearings[0].control->works_from = 1.0;
  s.magnetic_bearings[0].control->fails_at = scene::kNever;
  EXPECT_EQ(levitation(prepare(s), 0.0).loops.size(), 2u);
}

// With i = -(P y + D y') the plant between the controls has the poles of the loop.
TEST(Levitation, PlantClosesToTheLoop) {
  const Model m = prepare(hung({.proportional = kStiff, .derivative = kDamps}));
  const MagneticPlant open = LoopResponse(m, 120.0).plant();
  ASSERT_EQ(open.b.cols(), 2);
  const Eigen::MatrixXd closed = open.a - open.b * (kStiff * open.c + kDamps * open.c * open.a);
  const auto poles = real_eigenvalues(closed);
  ASSERT_TRUE(poles);
  const Levitation loop = levitation(m, 120.0);
  ASSERT_EQ(poles->size(), loop.poles.size());
  for (std::size_t k = 0; k < poles->size(); ++k)
    EXPECT_LT(relative((*poles)[k], loop.poles[k]), 1e-9);
}

}  // namespace
}  // namespace rotorub
