// Sampled controls of magnetic bearings: between two samples the loop is a linear plant under a
// constant current, and the run a product of exact matrices. What is refused beside them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using test::run_event;
using test::run_with;

constexpr double kRotor = 2.0, kNegative = 1e5, kGain = 80.0;  // kg, N/m, N/A
constexpr double kProp = 4000.0, kInt = 6e4, kDer = 2.0;       // A/m, A/(m s), A s/m
constexpr double kRateFilter = 2e-4, kEvery = 1e-4;            // s
constexpr double kAmplifier = 9000.0;                          // rad/s

// One axis under a held current: the plant x' = A x + b i, of which the controller measures x_0.
class HeldLoop {
 public:
  using Law = std::function<double(int sample, double seen)>;
  HeldLoop(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& start,
           double every, double end, const Law& law)
      : every_(every) {
    const Eigen::Index n = a.rows();
    whole_ = Eigen::MatrixXd::Zero(n + 1, n + 1);
    whole_.topLeftCorner(n, n) = a;
    whole_.topRightCorner(n, 1) = b;
    Eigen::VectorXd x(n + 1);
    x << start, 0.0;
    const Eigen::MatrixXd step = matrix_exp(whole_ * every);
    for (int k = 0; k * every < end + every; ++k) {
      x[n] = law(k, x[0]);
      states_.push_back(x);
      x = step * x;
    }
  }
  // m, of the rotor; A, what holds, just before t.
  double place(double t) const { return at(t)[0]; }
  double current(double t) const { return at(t)[whole_.rows() - 1]; }

 private:
  Eigen::VectorXd at(double t) const {
    const auto k = static_cast<std::size_t>(std::max(0.0, std::ceil(t / every_ - 1e-6) - 1.0));
    return matrix_exp(whole_ * (t - static_cast<double>(k) * every_)) * states_[k];
  }
  double every_;
  Eigen::MatrixXd whole_;
  std::vector<Eigen::VectorXd> states_;
};

struct PlantMatrices {
  Eigen::MatrixXd a;
  Eigen::VectorXd b;
};
PlantMatrices without_amplifier() {
  return {Eigen::Matrix2d{{0.0, 1.0}, {kNegative / kRotor, 0.0}},
          Eigen::Vector2d(0.0, kGain / kRotor)};
}
PlantMatrices behind_amplifier() {
  return {Eigen::Matrix3d{
              {0.0, 1.0, 0.0}, {kNegative / kRotor, 0.0, kGain / kRotor}, {0.0, 0.0, -kAmplifier}},
          Eigen::Vector3d(0.0, 0.0, kAmplifier)};
}

// The sampled PID as a difference equation.
HeldLoop::Law pid(int delay, double limit = 1e300) {
  struct Memory {
    double stored = 0.0, rate = 0.0, before = 0.0;
    std::vector<double> asked;
  };
  auto memory = std::make_shared<Memory>();
  return [=](int k, double seen) {
    Memory& m = *memory;
    if (k == 0) m.before = seen;
    m.rate = (kRateFilter * m.rate + seen - m.before) / (kRateFilter + kEvery);
    m.before = seen;
    const double asked = -(kProp * seen + kDer * m.rate + m.stored);
    const double given = std::clamp(asked, -limit, limit);
    m.stored += kEvery * kInt * (seen + (asked - given) / kProp);
    m.asked.push_back(given);
    return k < delay ? 0.0 : m.asked[static_cast<std::size_t>(k - delay)];
  };
}

scene::Scene sampled_scene() {
  scene::Scene s = test::make_scene({.mass = kRotor, .clearance = 0.5e-3});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, kNegative}};
  s.magnetic_bearings[0].control = scene::BearingControl{.force_per_current = kGain,
                                                         .proportional = kProp,
                                                         .integral = kInt,
                                                         .derivative = kDer,
                                                         .derivative_lag = kRateFilter,
                                                         .sample_time = kEvery};
  s.initial.x = {1e-4};
  s.initial.vy = {0.03};
  s.run.end = 0.05;
  s.run.output_step = 0.77e-3;
  return s;
}

// `event` to round-off, fixed steps of second order.
void expect_product(const scene::Scene& s, const HeldLoop& x, const HeldLoop& y) {
  const auto exact = [&](double t) { return std::complex<double>(x.place(t), y.place(t)); };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-13);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  test::expect_order_of_steps(
      s, {1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6}, 1.9,
      [&](const Trajectory& run) { return test::orbit_error(run, exact); }, 1e-8);
}

TEST(SampledMagneticControl, PidIsAProductOfMatrices) {
  const auto [a, b] = without_amplifier();
  for (const int delay : {0, 1, 3}) {
    SCOPED_TRACE(delay);
    scene::Scene s = sampled_scene();
    s.magnetic_bearings[0].control->delay = delay * kEvery;
    const HeldLoop x(a, b, Eigen::Vector2d(1e-4, 0.0), kEvery, s.run.end, pid(delay));
    const HeldLoop y(a, b, Eigen::Vector2d(0.0, 0.03), kEvery, s.run.end, pid(delay));
    expect_product(s, x, y);
    const Trajectory t = run_event(s);
    for (std::size_t k = 1; k < t.rows(); ++k) {
      const double at = t.column("t")[k] / kEvery;
      if (std::abs(at - std::round(at)) < 1e-6)
        continue;  // a row at a sample is before or after it
      EXPECT_NEAR(t.column("bearing_current_x")[k], x.current(t.column("t")[k]), 1e-9) << k;
    }
  }
}

TEST(SampledMagneticControl, BehindAnAmplifierToo) {
  scene::Scene s = sampled_scene();
  s.magnetic_bearings[0].amplifier = scene::Amplifier{.bandwidth = kAmplifier};
  const auto [a, b] = behind_amplifier();
  expect_product(s, HeldLoop(a, b, Eigen::Vector3d(1e-4, 0.0, 0.0), kEvery, s.run.end, pid(0)),
                 HeldLoop(a, b, Eigen::Vector3d(0.0, 0.03, 0.0), kEvery, s.run.end, pid(0)));
}

// The integrator subtracts the part that the limit cuts off.
TEST(SampledMagneticControl, PidKeepsItsLimit) {
  constexpr double kLimit = 0.31;
  scene::Scene s = sampled_scene();
  s.magnetic_bearings[0].control->current_limit = kLimit;
  const auto [a, b] = without_amplifier();
  expect_product(s, HeldLoop(a, b, Eigen::Vector2d(1e-4, 0.0), kEvery, s.run.end, pid(0, kLimit)),
                 HeldLoop(a, b, Eigen::Vector2d(0.0, 0.03), kEvery, s.run.end, pid(0, kLimit)));
}

// i_k = -(b_0 r_k + b_1 r_{k-1} + ..) - a_1 i_{k-1} - .., with a_0 = 2 to be divided by.
TEST(SampledMagneticControl, TransferFunctionIsItsDifferenceEquation) {
  const std::vector<double> numerator{5.6e4, -6.4e4, 1.72e4}, denominator{2.0, -0.9, 0.1, 0.02};
  scene::Scene s = sampled_scene();
  scene::BearingControl& control = *s.magnetic_bearings[0].control;
  control.form = scene::ControlForm::kTransferFunction;
  control.numerator = numerator;
  control.denominator = denominator;
  const auto law = [&] {
    auto seen = std::make_shared<std::vector<double>>(), given = seen;
    given = std::make_shared<std::vector<double>>();
    return [=](int k, double now) {
      seen->push_back(now);
      double sum = 0.0;
      for (int i = 0; i < 3 && i <= k; ++i) {
        sum -= numerator[static_cast<std::size_t>(i)] * (*seen)[static_cast<std::size_t>(k - i)];
      }
      for (int i = 1; i < 4 && i <= k; ++i) {
        sum -= denominator[static_cast<std::size_t>(i)] * (*given)[static_cast<std::size_t>(k - i)];
      }
      given->push_back(sum / denominator[0]);
      return given->back();
    };
  };
  const auto [a, b] = without_amplifier();
  const HeldLoop x(a, b, Eigen::Vector2d(1e-4, 0.0), kEvery, s.run.end, law());
  ASSERT_LT(std::abs(x.place(s.run.end)), 0.2e-4);  // it holds
  expect_product(s, x, HeldLoop(a, b, Eigen::Vector2d(0.0, 0.03), kEvery, s.run.end, law()));
}

// Two modes, two bearings, one of them sensed elsewhere, under one law of all four axes that
// couples them: a dense product.
TEST(SampledMagneticControl, OneLawForAllAxes) {
  const std::string text = R"(
[run]
end = 0.03
output_step = 0.77e-3
[rotor]
speed = 200.0
[rotor.modal]
mass = [2.0, 0.7]
stiffness = [1e5, 9e5]
damping = [30.0, 20.0]
gyroscopic = [0.05, 0.02]
[magnetic_control]
sample_time = 2e-4
delay = 2e-4
state_matrix = [0.5, 0.1, -0.2, 0.3]
input_matrix = [1.0, 0.2, 0.0, -0.4, 0.1, 1.0, 0.3, 0.0]
output_matrix = [150.0, -40.0, 30.0, 160.0, -120.0, 20.0, 50.0, 60.0]
feedthrough = [2500.0, 0.0, 200.0, 30.0, 0.0, 2500.0, -30.0, 200.0,
               150.0, 0.0, 1800.0, 0.0, 0.0, 150.0, 0.0, 1800.0]
[[magnetic_bearing]]
shape = [0.9, 0.4]
sensor_shape = [0.8, -0.3]
negative_stiffness = 3e4
[magnetic_bearing.control]
kind = "shared"
force_per_current = 40.0
[[magnetic_bearing]]
shape = [0.5, -0.6]
negative_stiffness = 2e4
[magnetic_bearing.control]
kind = "shared"
force_per_current = 60.0
[initial]
x = [1e-4, -2e-5]
vy = [0.05, 0.02]
)";
  const scene::Scene s = scene::parse_scene(text, "shared.toml", {});
  // y = (x_1, x_2, y_1, y_2), its rates, four currents.
  const Eigen::Vector2d mass(2.0, 0.7), u1(0.9, 0.4), s1(0.8, -0.3), u2(0.5, -0.6);
  const Eigen::Matrix2d inverse = mass.cwiseInverse().asDiagonal();
  const Eigen::Matrix2d k = Eigen::Vector2d(1e5, 9e5).asDiagonal().toDenseMatrix() -
                            3e4 * u1 * u1.transpose() - 2e4 * u2 * u2.transpose();
  const Eigen::Matrix2d d = Eigen::Vector2d(30.0, 20.0).asDiagonal();
  const Eigen::Matrix2d g = 200.0 * Eigen::Vector2d(0.05, 0.02).asDiagonal().toDenseMatrix();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(12, 12), seen = Eigen::MatrixXd::Zero(4, 12);
  a.block(0, 4, 4, 4).setIdentity();
  for (int plane = 0; plane < 2; ++plane) {
    a.block(4 + 2 * plane, 2 * plane, 2, 2) = -inverse * k;
    a.block(4 + 2 * plane, 4 + 2 * plane, 2, 2) = -inverse * d;
    a.block(4 + 2 * plane, 8 + plane, 2, 1) = 40.0 * inverse * u1;
    a.block(4 + 2 * plane, 10 + plane, 2, 1) = 60.0 * inverse * u2;
    seen.block(plane, 2 * plane, 1, 2) = s1.transpose();
    seen.block(2 + plane, 2 * plane, 1, 2) = u2.transpose();
  }
  a.block(4, 6, 2, 2) = -inverse * g;
  a.block(6, 4, 2, 2) = inverse * g;
  const auto matrix = [](const std::vector<double>& from, int rows, int columns) {
    return Eigen::MatrixXd(
        Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
            from.data(), rows, columns));
  };
  const scene::ControlMatrices& m = s.magnetic_control->matrices;
  const Eigen::MatrixXd ca = matrix(m.state, 2, 2), cb = matrix(m.input, 2, 4),
                        cc = matrix(m.output, 4, 2), cd = matrix(m.feedthrough, 4, 4);
  constexpr double kSample = 2e-4;
  const Eigen::MatrixXd step = matrix_exp(a * kSample);
  Eigen::VectorXd y = Eigen::VectorXd::Zero(12), memory = Eigen::VectorXd::Zero(2),
                  next = Eigen::VectorXd::Zero(4);
  y.head(2) << 1e-4, -2e-5;
  y.segment(6, 2) << 0.05, 0.02;
  std::vector<Eigen::VectorXd> held;
  for (int sample = 0; sample * kSample < s.run.end + kSample; ++sample) {
    const Eigen::VectorXd r = seen * y;
    y.tail(4) = next;  // one sample late
    next = -(cc * memory + cd * r);
    memory = (ca * memory + cb * r).eval();
    held.push_back(y);
    y = step * y;
  }
  const auto exact = [&](double t) -> std::complex<double> {
    const auto at = static_cast<std::size_t>(std::max(0.0, std::ceil(t / kSample - 1e-6) - 1.0));
    const Eigen::VectorXd now = matrix_exp(a * (t - static_cast<double>(at) * kSample)) * held[at];
    return {now[0] + now[1], now[2] + now[3]};
  };
  const Trajectory t = run_event(s);
  EXPECT_LT(test::orbit_error(t, exact), 1e-13);
  test::expect_order_of_steps(s, {1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6}, 1.9,
                              [&](const Trajectory& run) { return test::orbit_error(run, exact); });
}

// Switched off, it commands nothing and loses its state; switched on again, it begins as at its
// first sample, without a kick of the derivative.
TEST(SampledMagneticControl, BeginsAnewWhenItReturns) {
  constexpr double kOn = 20.0 * kEvery, kFails = 150.0 * kEvery, kReturns = 155.5 * kEvery;
  scene::Scene s = sampled_scene();
  s.first().contact.reset();
  scene::BearingControl& control = *s.magnetic_bearings[0].control;
  control.works_from = kOn;
  control.fails_at = kFails;
  control.returns_at = kReturns;
  s.initial.x = {};
  s.initial.vy = {1e-3};
  s.run.end = 0.03;
  // Free flight, the loop, free flight, magnets without a current up to the next sample, the loop.
  const auto [a, b] = without_amplifier();
  const Eigen::Matrix2d free{{0.0, 1.0}, {0.0, 0.0}};
  const auto flight = [&](const Eigen::Vector2d& x, double time) -> Eigen::Vector2d {
    return matrix_exp(free * time) * x;
  };
  const Eigen::Vector2d start(0.0, 1e-3), on = flight(start, kOn);
  const HeldLoop first(a, b, on, kEvery, kFails - kOn, pid(0));
  const double h = 1e-7, end = kFails - kOn;
  const Eigen::Vector2d fails(
      first.place(end),
      (3.0 * first.place(end) - 4.0 * first.place(end - h) + first.place(end - 2.0 * h)) /
          (2.0 * h));
  const Eigen::Vector2d returns = flight(fails, kReturns - kFails);
  const Eigen::Vector2d again = matrix_exp(a * 0.5 * kEvery) * returns;
  const HeldLoop second(a, b, again, kEvery, s.run.end - kReturns, pid(0));
  const auto exact = [&](double t) -> std::complex<double> {
    if (t <= kOn) return {0.0, flight(start, t)[0]};
    if (t <= kFails) return {0.0, first.place(t - kOn)};
    if (t <= kReturns) return {0.0, flight(fails, t - kFails)[0]};
    const double since = t - kReturns - 0.5 * kEvery;
    if (since <= 0.0) return {0.0, (matrix_exp(a * (t - kReturns)) * returns)[0]};
    return {0.0, second.place(since)};
  };
  EXPECT_LT(test::orbit_error(run_event(s), exact), 1e-12);
  EXPECT_LT(test::orbit_error(run_with(s, scene::Integrator::kVerlet, 2.5e-6), exact), 2e-9);
}

// ---------------------------------------------------------------- what is refused
TEST(SampledMagneticControl, StepsMeetItsSamples) {
  scene::Scene s = sampled_scene();
  const Trajectory t = test::attempt_with(s, scene::Integrator::kVerlet, 3e-5);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_TRUE(test::contains(t.message, "does not divide the sample time"));
  s.initial = {};
  s.initial.steady = true;
  EXPECT_THROW(prepare(s), scene::SceneError);
}

TEST(SampledMagneticControl, SaysWhatItNeeds) {
  const std::string text = R"(
[run]
end = 0.01
[rotor.modal]
mass = [2.0]
stiffness = [1e5]
[[magnetic_bearing]]
negative_stiffness = 3e4
control = {force_per_current = 40.0, proportional = 3000.0, sample_time = "0.1 ms"}
)";
  const auto reason = [&](const std::string& control, const std::string& shared) {
    std::vector<std::string> overrides{"magnetic_bearing[0].control={force_per_current=40.0," +
                                       control + "}"};
    if (!shared.empty()) overrides.push_back("magnetic_control={" + shared + "}");
    return test::message_of<scene::SceneError>(
        [&] { scene::parse_scene(text, "bad.toml", overrides); });
  };
  const std::string four = "input_matrix=[1,0],output_matrix=[1,0],feedthrough=[3e3,0,0,3e3]";
  EXPECT_EQ(reason("kind='shared'", "sample_time=1e-4,state_matrix=[0.5]," + four), "");
  EXPECT_EQ(reason("kind='transfer_function',sample_time=1e-4,numerator=[3e3],denominator=[1]", ""),
            "");
  const struct {
    std::string control, shared;
    const char* expected;
  } cases[] = {
      {"kind='shared'", "", "needs [magnetic_control]"},
      {"proportional=3e3", "sample_time=1e-4,state_matrix=[0.5]," + four,
       "no magnetic bearing has a control of kind \"shared\""},
      {"kind='shared'", "sample_time=1e-4,state_matrix=[0.5,1]," + four,
       "expected n times n values"},
      {"kind='shared'", "sample_time=1e-4,state_matrix=[1,2,3,4]," + four,
       "expected 4 values, 2 times 2"},
      {"kind='shared'", "sample_time=1e-4,delay=1.5e-4,state_matrix=[0.5]," + four,
       "a whole number of them"},
      {"derivative=1", "", "missing: expected a current per length"},
      {"proportional=3e3,delay=1e-4", "", "needs magnetic_bearing[0].control.sample_time"},
      {"kind='transfer_function',numerator=[3e3],denominator=[1]", "",
       "missing: expected a time in s, > 0"},
      {"kind='transfer_function',sample_time=1e-4,numerator=[3e3],denominator=[0,1]", "",
       "a first value that is not 0"},
      {"kind='state_space',sample_time=1e-4,state_matrix=[0.5],input_matrix=[1,2],"
       "output_matrix=[1],feedthrough=[3e3]",
       "", "expected 1 values, 1 times 1"},
      {"kind='state_space',sample_time=1e-4,state_matrix=[0.5],input_matrix=[1],output_matrix=[1],"
       "feedthrough=[3e3],derivative=1",
       "", "derivative"},
  };
  for (const auto& c : cases) {
    EXPECT_TRUE(test::contains(reason(c.control, c.shared), c.expected)) << c.control;
  }
}

}  // namespace
}  // namespace rotorub
