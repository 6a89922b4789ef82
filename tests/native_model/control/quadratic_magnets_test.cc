// LQR and LQG of a ring whose rotor hangs in magnetic bearings with filters, amplifiers and sampled
// controls: what the design promises is what a run does.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "native_model/system/linear_plant.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

// Two modes in two magnetic bearings, released with the ring off its middle, far from contact.
constexpr const char* kLevitated = R"(
[run]
end = 0.02
output_step = 1e-4
[rotor]
speed = 314.0
[rotor.modal]
mass = [2.0, 0.8]
stiffness = [2e5, 3e6]
damping = [40.0, 60.0]
gyroscopic = [0.05, -0.02]
[contact]
radius = 0.05
clearance = 0.01
friction = 0.1
restitution = 0.5
[stator]
mass = 1.5
damping = 30.0
stiffness = 2e5
[initial]
x = [1e-4, 2e-5]
stator = [-1e-4, 5e-5]
[[magnetic_bearing]]
shape = [0.9, 0.4]
sensor_shape = [0.8, 0.3]
negative_stiffness = 3e4
control = {force_per_current = 40.0, proportional = 3000.0, FIRST}
AMPLIFIER
[[magnetic_bearing]]
shape = [0.5, -0.6]
negative_stiffness = 2e4
control = {force_per_current = 60.0, proportional = 1500.0, SECOND}
[controller]
kind = "KIND"
sample_time = 1e-4
)";

struct Hanging {
  std::string name, first, amplifier, second;
  bool sampled = false;
};
std::vector<Hanging> loops() {
  const std::string amplifier = "amplifier = {bandwidth = 8000.0}";
  return {
      {"filter, integrator, amplifier", "derivative = 2.0, derivative_lag = 2e-4, integral = 3e4",
       amplifier, "derivative = 1.0"},
      {"sampled together with the ring's, two samples late",
       "derivative = 2.0, integral = 3e4, sample_time = 1e-4, delay = 2e-4", "",
       "derivative = 1.0, derivative_lag = 1e-4", true},
      {"sampled twice as often, behind an amplifier",
       "kind = 'transfer_function', numerator = [5000.0, -2000.0], denominator = [1.0, -0.2], "
       "sample_time = 5e-5, delay = 5e-5",
       amplifier, "derivative = 1.0, sample_time = 5e-5", true},
  };
}

std::string with(std::string text, const std::string& word, const std::string& by) {
  return text.replace(text.find(word), word.size(), by);
}
scene::Scene levitated(const Hanging& loop, const std::string& kind) {
  std::string text = with(kLevitated, "FIRST", loop.first);
  text = with(with(text, "AMPLIFIER", loop.amplifier), "SECOND", loop.second);
  return scene::parse_scene(with(text, "KIND", kind), "levitated.toml", {});
}

QuadraticDesign design_of(const scene::Scene& s) {
  return quadratic_design(s, plant_of(make_model(s), 0, s.rotor.speed));
}

// The state of a run at t = 0.
Eigen::VectorXd start_of(const scene::Scene& s, const LinearPlant& p) {
  const Model m = make_model(s);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(p.a.rows());
  for (Eigen::Index i = 0; i < p.half(); ++i) {
    const int k = p.coordinates[static_cast<std::size_t>(i)];
    x[i] = m.q0[k];
    x[p.half() + i] = m.v0[k];
  }
  return x;
}

// x_{k+1} of a step under the law, the estimate with it where there is one.
struct Recursion {
  explicit Recursion(const scene::Scene& s)
      : design(design_of(s)), x(start_of(s, design.plant)), guess(0.0 * x) {}
  void step() {
    const LinearPlant& p = design.plant;
    const bool estimates = design.filter.size() > 0;
    if (estimates) guess += design.filter * p.c * (x - guess);
    const Eigen::Vector2d u = -design.gain * (estimates ? guess : x);
    x = (p.a * x + p.b * u).eval();
    guess = (p.a * guess + p.b * u).eval();
  }
  QuadraticDesign design;
  Eigen::VectorXd x, guess;
};

// All that the design knows is in a run, to round-off: matrices of the closed loop, sample by
// sample. The memory of a sampled law begins with what its sensors show first, which is no linear
// map of a memory before: such a run begins with its rotor in the middle, in motion.
TEST(QuadraticWithMagnets, ARunIsTheClosedLoopOfTheDesign) {
  for (const Hanging& loop : loops()) {
    for (const std::string kind : {"lqr", "lqg"}) {
      SCOPED_TRACE(loop.name + ", " + kind);
      scene::Scene s = levitated(loop, kind);
      if (loop.sampled) s.initial.vx = {0.03, 0.01};
      if (loop.sampled) s.initial.x = {};
      Recursion exact(s);
      const Trajectory t = test::run_event(s);
      ASSERT_EQ(t.status, Status::kOk) << t.message;
      for (std::size_t k = 0; k < 200; ++k, exact.step()) {
        const Eigen::VectorXd y = exact.design.plant.c * exact.x;
        ASSERT_NEAR(t.column("rotor_x")[k], y[0], 2e-12) << k;
        ASSERT_NEAR(t.column("rotor_y")[k], y[1], 2e-12) << k;
        ASSERT_NEAR(t.column("stator_x")[k], y[2], 2e-12) << k;
        ASSERT_NEAR(t.column("stator_y")[k], y[3], 2e-12) << k;
      }
    }
  }
}

TEST(QuadraticWithMagnets, FixedStepsComeToTheSame) {
  for (const Hanging& loop : loops()) {
    for (const std::string kind : {"lqr", "lqg"}) {
      SCOPED_TRACE(loop.name + ", " + kind);
      scene::Scene s = levitated(loop, kind);
      const Trajectory exact = test::run_event(s);
      // lqr reads velocities, which `verlet` has at a sample's instant to first order alone: the
      // force of the magnets jumps there.
      const double reads = loop.sampled && kind == "lqr" ? 0.9 : 1.8;
      for (const auto& [integrator, order] : {std::pair(scene::Integrator::kVerlet, reads),
                                              std::pair(scene::Integrator::kMidpoint, 1.8),
                                              std::pair(scene::Integrator::kEuler, 0.8)}) {
        test::Convergence c;
        for (const double step : {2.5e-5, 1.25e-5, 6.25e-6, 3.125e-6}) {
          const Trajectory t = test::run_with(s, integrator, step);
          ASSERT_EQ(t.status, Status::kOk) << t.message;
          double most = 0.0;
          for (std::size_t k = 0; k < t.rows(); ++k)
            most = std::max(most, std::abs(t.column("stator_x")[k] - exact.column("stator_x")[k]));
          c.steps.push_back(step);
          c.errors.push_back(most);
        }
        EXPECT_GT(c.order(), order) << static_cast<int>(integrator) << ": " << c.text();
      }
    }
  }
}

// The slowest pair of the loop that the design promises is what is left of a run.
TEST(QuadraticWithMagnets, ARunDecaysAsThePromisedEigenvalues) {
  for (const Hanging& loop : loops()) {
    SCOPED_TRACE(loop.name);
    scene::Scene s = levitated(loop, "lqg");
    s.run.end = 0.6;
    const QuadraticDesign d = design_of(s);
    const auto ring = real_eigenvalues(d.plant.a - d.plant.b * d.gain).value();
    const auto estimate = real_eigenvalues(d.plant.a - d.plant.a * d.filter * d.plant.c).value();
    const auto slowest = [](const std::vector<std::complex<double>>& all) {
      return *std::ranges::max_element(all, {}, [](const auto& z) { return std::abs(z); });
    };
    for (const auto& all : {ring, estimate}) EXPECT_LT(std::abs(slowest(all)), 1.0);
    const Trajectory t = test::run_event(s);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    const auto size = [&](std::size_t from) {
      double square = 0.0;
      for (std::size_t k = from; k < from + 2000; ++k)
        square += std::pow(t.column("rotor_x")[k], 2) + std::pow(t.column("rotor_y")[k], 2);
      return std::sqrt(square);
    };
    // Of both whirls of that pair, which decay a little apart.
    const double rate = std::log(size(3500) / size(1500)) / 2000.0;
    std::vector<double> promised;
    for (const auto& z : ring) promised.push_back(std::log(std::abs(z)));
    std::ranges::sort(promised, std::greater());
    EXPECT_LT(rate, promised[0] + 1e-4 * std::abs(promised[0]));
    EXPECT_GT(rate, promised[3] - 1e-2 * std::abs(promised[3]));
  }
}

// P = A' P A - A' P B (R + B' P B)^-1 B' P A + Q, by no code of the solver's.
TEST(QuadraticWithMagnets, GainsSolveTheRiccatiEquation) {
  for (const Hanging& loop : loops()) {
    SCOPED_TRACE(loop.name);
    const scene::Scene s = levitated(loop, "lqg");
    const QuadraticDesign d = design_of(s);
    const scene::Controller& given = *s.first().controller;
    const Eigen::MatrixXd &a = d.plant.a, &b = d.plant.b, &c = d.plant.c;
    const Eigen::MatrixXd apart = (c.topRows(2) - c.bottomRows(2)) / given.allowed_error;
    const Eigen::MatrixXd travel = c.bottomRows(2) / given.allowed_travel;
    const Eigen::MatrixXd q = apart.transpose() * apart + travel.transpose() * travel;
    const Eigen::MatrixXd r = Eigen::Matrix2d::Identity() / std::pow(given.allowed_force, 2);
    const Eigen::MatrixXd p = solve_riccati(a, b, q, r).value();
    const Eigen::MatrixXd inner = r + b.transpose() * p * b;
    const Eigen::MatrixXd rest = a.transpose() * p * a + q - p -
                                 a.transpose() * p * b * inner.inverse() * b.transpose() * p * a;
    EXPECT_LT(rest.norm(), 1e-10 * p.norm());
    EXPECT_LT((d.gain - inner.inverse() * b.transpose() * p * a).norm(), 1e-9 * d.gain.norm());
  }
}

// The gains of rotor and ring, with what the memory of a slow motion is put in its place.
double distance(const QuadraticDesign& d, const QuadraticDesign& old, const Eigen::MatrixXd& slow) {
  const Eigen::Index n = 2 * old.plant.half();
  return (d.gain.leftCols(n) + d.gain.rightCols(d.gain.cols() - n) * slow - old.gain).norm() /
         old.gain.norm();
}

// An amplifier that follows at once, a control that is asked at once: the gains of old, in first
// order. The current is then -P s - D s', the command -P s.
TEST(QuadraticWithMagnets, FastAmplifiersAndSamplesGiveTheGainsWithoutThem) {
  const auto first_of = [](const QuadraticDesign& d, double p, double rate) {
    Eigen::MatrixXd slow = Eigen::MatrixXd::Zero(2, 2 * d.plant.half());
    const Eigen::RowVector2d sensor(0.8, 0.3);
    for (Eigen::Index plane = 0; plane < 2; ++plane) {
      slow.block(plane, 2 * plane, 1, 2) = -p * sensor;
      slow.block(plane, d.plant.half() + 2 * plane, 1, 2) = -rate * sensor;
    }
    return slow;
  };
  const Hanging plain{"", "derivative = 2.0", "", "derivative = 1.0"};
  const QuadraticDesign old = design_of(levitated(plain, "lqr"));
  EXPECT_EQ(old.gain.cols(), 12);
  test::Convergence amplifiers, samples;
  for (const double lag : {2e-5, 1e-5, 5e-6, 2.5e-6}) {
    Hanging late = plain;
    late.amplifier = "amplifier = {bandwidth = " + std::to_string(1.0 / lag) + "}";
    amplifiers.steps.push_back(lag);
    amplifiers.errors.push_back(
        distance(design_of(levitated(late, "lqr")), old, first_of(old, 3000.0, 2.0)));
  }
  EXPECT_NEAR(amplifiers.order(), 1.0, 0.1) << amplifiers.text();
  const Hanging stiff{"", "derivative = 0.0", "", "derivative = 1.0"};
  const QuadraticDesign asked = design_of(levitated(stiff, "lqg"));
  for (const int parts : {10, 20, 40, 80}) {
    Hanging held = stiff;
    held.first += ", sample_time = " + std::to_string(100.0 / parts) + "e-6";
    QuadraticDesign d = design_of(levitated(held, "lqg"));
    // Of its memory the command alone: a law without derivative and integral acts by nothing else.
    d.gain = d.gain.leftCols(14).eval();
    samples.steps.push_back(1e-4 / parts);
    samples.errors.push_back(distance(d, asked, first_of(asked, 3000.0, 0.0)));
  }
  EXPECT_NEAR(samples.order(), 1.0, 0.1) << samples.text();
}

TEST(QuadraticWithMagnets, RefusesSamplesThatDoNotMeetItsOwn) {
  const auto why = [](const Hanging& loop, const std::string& kind) -> std::string {
    try {
      make_model(levitated(loop, kind));
    } catch (const scene::SceneError& error) {
      return error.what();
    }
    return "";
  };
  const Hanging sampled = loops()[1];
  EXPECT_EQ(why(sampled, "lqr"), "");
  EXPECT_EQ(why(sampled, "lqg"), "");
  Hanging beside = sampled;
  beside.first = "derivative = 2.0, sample_time = 0.7e-4";
  EXPECT_NE(why(beside, "lqg").find("no whole multiple"), std::string::npos) << why(beside, "lqg");
  beside.first = "derivative = 2.0, sample_time = 1e-4";
  beside.second = "derivative = 1.0, sample_time = 5e-5";
  EXPECT_NE(why(beside, "lqg").find("another sample time"), std::string::npos)
      << why(beside, "lqg");
}

}  // namespace
}  // namespace rotorub
