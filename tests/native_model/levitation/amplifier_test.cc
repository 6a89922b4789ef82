// Filter and amplifier of a magnetic bearing's feedback, switched on, off and on again, against
// exact answers.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using test::run_event;

using Complex = std::complex<double>;

constexpr double kHung = 2.0, kPull = 1e5, kPerAmpere = 80.0;  // kg, N/m, N/A
constexpr double kP = 4000.0, kI = 6e4, kD = 2.0;              // A/m, A/(m s), A s/m
constexpr double kFilter = 1e-4, kBandwidth = 9000.0;          // s, rad/s
constexpr double kWeight = kHung * 9.81;                       // N

scene::Scene amplified() {
  scene::Scene s = test::make_scene({.mass = kHung, .clearance = 0.5e-3});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kPull}};
  s.magnetic_bearings[0].control = scene::BearingControl{.force_per_current = kPerAmpere,
                                                         .proportional = kP,
                                                         .integral = kI,
                                                         .derivative = kD,
                                                         .derivative_lag = kFilter};
  s.magnetic_bearings[0].amplifier = scene::Amplifier{.bandwidth = kBandwidth};
  s.run.end = 0.1;
  s.run.output_step = 1e-3;
  return s;
}

// One axis: y' = A y of y = (r, r', j, d, i),
//   m r'' = k_s r + k_i i,  j' = I r,  T_d d' = r' - d,  i' = w_a (-(P r + D d + j) - i).
Eigen::MatrixXd one_axis() {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(5, 5);
  a(0, 1) = 1.0;
  a(1, 0) = kPull / kHung;
  a(1, 4) = kPerAmpere / kHung;
  a(2, 0) = kI;
  a(3, 1) = 1.0 / kFilter;
  a(3, 3) = -1.0 / kFilter;
  a.row(4) = -kBandwidth * Eigen::RowVectorXd{{kP, 0.0, 1.0, kD, 1.0}};
  return a;
}

// e^{A t} y_0 by the eigenvectors of A.
class LinearMotion {
 public:
  LinearMotion(const Eigen::MatrixXd& a, const Eigen::VectorXd& start)
      : modes_(real_modes(a).value()),
        share_(lu_solve(modes_.vectors, Eigen::VectorXcd(start.cast<Complex>()))) {}
  Eigen::VectorXd at(double t) const {
    return (modes_.vectors * (modes_.values * t).array().exp().matrix().cwiseProduct(share_))
        .real();
  }

 private:
  EigenModes modes_;
  Eigen::VectorXcd share_;
};

TEST(MagneticAmplifier, LinearLoopIsAMatrixExponential) {
  scene::Scene s = amplified();
  s.initial.x = {1e-4};
  s.initial.vy = {0.03};
  const LinearMotion x(one_axis(), Eigen::VectorXd::Unit(5, 0) * 1e-4);
  const LinearMotion y(one_axis(), Eigen::VectorXd::Unit(5, 1) * 0.03);
  const auto exact = [&](double t) { return Complex(x.at(t)[0], y.at(t)[0]); };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-13);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);  // of filter and coil there is no energy
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double time = t.column("t")[k];
    EXPECT_NEAR(t.column("bearing_current_x")[k], x.at(time)[4], 1e-9) << k;
    EXPECT_NEAR(t.column("bearing_current_y")[k], y.at(time)[4], 1e-9) << k;
  }
  test::expect_order_of_steps(
      s, {1e-4, 5e-5, 2e-5, 1e-5, 5e-6}, 1.95,
      [&](const Trajectory& run) { return test::orbit_error(run, exact); }, 1e-8);
}

// The dynamic stiffness -m w^2 - k_s + k_i H_a (P + i w D H_d + I / (i w)), H = 1 / (1 + i w T).
TEST(MagneticAmplifier, StartsOnItsSteadyOrbit) {
  constexpr double kTurns = 700.0, kSize = 30.0;  // rad/s, N
  scene::Scene s = amplified();
  s.gravity = scene::Gravity{{0.0, -kWeight / kHung}, {}};
  s.forces = {{.kind = scene::ForceKind::kRotating,
               .amplitude = kSize,
               .frequency = kTurns,
               .shape = {1.0}}};
  s.initial.steady = true;
  const Complex turns(0.0, kTurns);
  const Complex lag = 1.0 / (1.0 + turns / kBandwidth), filter = 1.0 / (1.0 + turns * kFilter);
  const Complex law = lag * (kP + turns * kD * filter + kI / turns);
  const Complex stiffness = kPerAmpere * law - kPull - kHung * kTurns * kTurns;
  const auto exact = [&](double t) { return kSize / stiffness * std::polar(1.0, kTurns * t); };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-12);
  const Complex current = -law * kSize / stiffness;
  EXPECT_NEAR(t.column("bearing_current_x").front(), current.real(), 1e-12);
  EXPECT_NEAR(t.column("bearing_current_y").front(), current.imag() + kWeight / kPerAmpere, 1e-12);
  // With a slow amplifier the motion grows, and there is no steady orbit.
  s.magnetic_bearings[0].amplifier->bandwidth = 50.0;
  EXPECT_THROW(prepare(s), scene::SceneError);
}

// As far as the whole voltage goes the current rises evenly, i = U t / L, and r = r_0 + k_i U t^3 /
// (6 L m).
TEST(MagneticAmplifier, TheVoltageBoundsTheRateOfTheCurrent) {
  constexpr double kVolts = 20.0, kHenry = 0.05, kStart = -4e-4;
  scene::Scene s = amplified();
  s.magnetic_bearings[0].negative_stiffness = 0.0;
  s.magnetic_bearings[0].control->integral = 0.0;
  s.magnetic_bearings[0].amplifier->voltage_limit = kVolts;
  s.magnetic_bearings[0].amplifier->inductance = kHenry;
  s.initial.x = {kStart};
  s.run.end = 2.5e-3;
  s.run.output_step = 1e-4;
  ASSERT_LT(kVolts / kHenry * s.run.end, 0.7 * kP * -kStart);  // it asks for more all the time
  const auto exact = [&](double t) -> Complex {
    return kStart + kPerAmpere * kVolts / kHenry * t * t * t / (6.0 * kHung);
  };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-15);
  EXPECT_NEAR(t.column("bearing_current_x").back(), kVolts / kHenry * s.run.end, 1e-12);
  test::expect_order_of_steps(s, {1e-4, 5e-5, 2.5e-5, 1.25e-5}, 1.95,
                              [&](const Trajectory& run) { return test::orbit_error(run, exact); });
  // With a resistance it ends at U / R.
  s.magnetic_bearings[0].amplifier->resistance = 50.0;
  s.run.end = 5e-3;
  const auto rises = [&](double time) {
    return kVolts / 50.0 * (1.0 - std::exp(-50.0 / kHenry * time));
  };
  const Trajectory slow = run_event(s);
  for (std::size_t k = 0; k < slow.rows(); ++k) {
    EXPECT_NEAR(slow.column("bearing_current_x")[k], rises(slow.column("t")[k]), 1e-11) << k;
  }
}

// ---------------------------------------------------------------- off, on and off again
// Switched on late, the rotor falls until then; failed and returned, it is the same loop again,
// from the state of that instant: three linear motions one after the other.
TEST(MagneticAmplifier, WorksFromOnToFailureAndFromItsReturn) {
  constexpr double kOn = 2.3e-3, kFails = 0.0217, kReturns = 0.0234, kFall = 9.81;
  scene::Scene s = amplified();
  s.first().contact.reset();
  s.gravity = scene::Gravity{{0.0, -kFall}, {}};
  scene::BearingControl& control = *s.magnetic_bearings[0].control;
  control.works_from = kOn;
  control.fails_at = kFails;
  control.returns_at = kReturns;
  s.run.end = 0.05;
  // The weight is a constant that the sixth state carries.
  const auto system = [](bool works) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(6, 6);
    a.topLeftCorner(5, 5) = one_axis();
    a(1, 5) = -kFall;
    if (works) return a;
    a(1, 0) = a(1, 4) = a(2, 0) = 0.0;
    a.row(4).setZero();
    a(4, 4) = -kBandwidth;
    return a;
  };
  // With an integrator at rest A has no full set of eigenvectors, so the exponential is a series of
  // short steps.
  const auto moved = [&](bool works, double by, const Eigen::VectorXd& from) {
    constexpr int kParts = 64, kTerms = 25;
    const Eigen::MatrixXd a = system(works) * (by / kParts);
    Eigen::VectorXd y = from;
    for (int part = 0; part < kParts; ++part) {
      Eigen::VectorXd term = y;
      for (int k = 1; k <= kTerms; ++k) y += term = (a * term / k).eval();
    }
    return y;
  };
  const Eigen::VectorXd start = Eigen::VectorXd::Unit(6, 5);
  const Eigen::VectorXd on = moved(false, kOn, start), fails = moved(true, kFails - kOn, on);
  const Eigen::VectorXd returns = moved(false, kReturns - kFails, fails);
  const auto exact = [&](double t) -> Complex {
    const Eigen::VectorXd y = t < kOn        ? moved(false, t, start)
                              : t < kFails   ? moved(true, t - kOn, on)
                              : t < kReturns ? moved(false, t - kFails, fails)
                                             : moved(true, t - kReturns, returns);
    return {0.0, y[0]};
  };
  const Trajectory run = run_event(s);
  EXPECT_LT(test::orbit_error(run, exact), 1e-13);
  // The coil's current, at work and as it decays.
  const std::vector<double>& current = run.column("bearing_current_y");
  EXPECT_NEAR(current[20], moved(true, 0.02 - kOn, on)[4], 1e-9);
  EXPECT_NEAR(current[22], moved(false, 0.022 - kFails, fails)[4], 1e-9);
  EXPECT_GT(std::abs(current[22]), 1e-3);
  test::expect_order_of_steps(
      s, {1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6}, 1.85,
      [&](const Trajectory& t) { return test::orbit_error(t, exact); }, 1e-8);
}

// ---------------------------------------------------------------- what is refused
TEST(MagneticAmplifier, SaysWhatItNeeds) {
  const std::string text = R"(
[run]
end = 0.01
[rotor.modal]
mass = [2.0]
stiffness = [1e5]
[magnetic_bearing]
negative_stiffness = 3e4
[magnetic_bearing.control]
force_per_current = 40.0
proportional = 3000.0
[magnetic_bearing.amplifier]
bandwidth = "1.5 kHz"
)";
  const scene::Scene good = scene::parse_scene(text, "good.toml", {});
  EXPECT_NEAR(good.magnetic_bearings[0].amplifier->bandwidth, 3000.0 * std::numbers::pi, 1e-9);
  const auto reason = [&](const std::vector<std::string>& overrides) {
    return test::message_of<scene::SceneError>(
        [&] { scene::parse_scene(text, "bad.toml", overrides); });
  };
  const std::string magnets =
      "magnetic_bearing={kind=\"electromagnet\",force_constant=1e-6,"
      "bias_current=2.0,air_gap=5e-4,control={proportional=3e4";
  EXPECT_EQ(reason({magnets + "}}"}), "");
  const struct {
    std::vector<std::string> overrides;
    const char* expected;
  } cases[] = {
      {{"magnetic_bearing.amplifier.voltage_limit=10"},
       "needs magnetic_bearing.amplifier.inductance"},
      {{"magnetic_bearing.amplifier.resistance=1"},
       "needs magnetic_bearing.amplifier.voltage_limit"},
      {{"magnetic_bearing.control=none"}, "needs magnetic_bearing.control"},
      {{"magnetic_bearing.control.force_per_current=none"},
       "missing: expected a force per current"},
      {{"magnetic_bearing.control.returns_at=1"}, "needs magnetic_bearing.control.fails_at"},
      {{"magnetic_bearing.control.fails_at=1", "magnetic_bearing.control.returns_at=0.5"},
       "must be after `fails_at` = 1 s"},
      {{"magnetic_bearing.control.on=2", "magnetic_bearing.control.fails_at=1"},
       "must not be before `on` = 2 s"},
      {{magnets + ",current_limit=2.5}}"}, "must be at most magnetic_bearing.bias_current = 2 A"},
      {{magnets + ",force_per_current=5}}"}, "belongs to kind = \"linear\""},
      {{"magnetic_bearing.air_gap=1e-3"}, "air_gap"},
  };
  for (const auto& c : cases) {
    const std::string why = reason(c.overrides);
    EXPECT_NE(why.find(c.expected), std::string::npos) << c.overrides[0] << "\n" << why;
  }
}

}  // namespace
}  // namespace rotorub
