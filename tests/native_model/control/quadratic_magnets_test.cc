// LQR and LQG of a ring whose rotor is held by magnetic bearings with filters, amplifiers and
// sampled controls: the runs obey the equations of the design.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "native_model/model/linear_plant.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "tests/support/hung_rotors.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using test::Hanging;
using test::levitated;

QuadraticDesign design_of(const scene::Scene& s) {
  return quadratic_design(s, 0, plant_of(prepare(s), 0, s.rotor.speed));
}

// The state of a run at t = 0.
Eigen::VectorXd start_of(const scene::Scene& s, const LinearPlant& p) {
  const Model m = prepare(s);
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
  for (const Hanging& loop : test::hung_rotors()) {
    for (const std::string kind : {"lqr", "lqg"}) {
      SCOPED_TRACE(loop.name + ", " + kind);
      scene::Scene s = levitated(loop, kind);
      if (loop.sampled) s.initial.vx = {0.03, 0.01};
      if (loop.sampled) s.initial.x = {};
      Recursion exact(s);
      const Trajectory t = test::run_event(s);
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

// A sampled derivative begins with what its sensor shows first, so that it is 0 there: the first
// command knows it, and so does that of a bearing that is switched on later. It took 0 for what the
// sensor had shown.
TEST(QuadraticWithMagnets, TheFirstCommandKnowsWhatASampledDerivativeBeginsWith) {
  scene::Scene s = levitated(test::hung_rotors()[1], "lqr");
  Recursion exact(s);
  const LinearPlant& p = exact.design.plant;
  // The memory of each axis is the integral, then the sensor's value at the sample before; shape
  // (0.8, 0.3).
  const double shown = 0.8 * s.initial.x[0] + 0.3 * s.initial.x[1];
  const auto at = std::ranges::find(p.memory_names, "control_2") - p.memory_names.begin();
  ASSERT_LT(at, std::ssize(p.memory_names));
  exact.x[2 * p.half() + at] = shown;
  const Eigen::Vector2d first = -exact.design.gain * exact.x;
  ASSERT_GT(first.norm(), 1.0);
  for (const auto integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
    const Trajectory t = test::run_with(s, integrator, 1e-5);
    EXPECT_NEAR(t.column("control_x")[0], first.x(), 1e-9 * first.norm());
    EXPECT_NEAR(t.column("control_y")[0], first.y(), 1e-9 * first.norm());
  }
  const Trajectory t = test::run_event(s);
  for (std::size_t k = 0; k < 200; ++k, exact.step()) {
    const Eigen::VectorXd y = p.c * exact.x;
    ASSERT_NEAR(t.column("rotor_x")[k], y[0], 2e-12) << k;
    ASSERT_NEAR(t.column("stator_x")[k], y[2], 2e-12) << k;
  }
}

TEST(QuadraticWithMagnets, FixedStepsComeToTheSame) {
  for (const Hanging& loop : test::hung_rotors()) {
    for (const std::string kind : {"lqr", "lqg"}) {
      SCOPED_TRACE(loop.name + ", " + kind);
      scene::Scene s = levitated(loop, kind);
      const Trajectory exact = test::run_event(s);
      // lqr reads velocities, which `verlet` has at a sample's instant to first order alone: the
      // force of the magnets jumps there.
      const double reads = loop.sampled && kind == "lqr" ? 0.9 : 1.8;
      for (const auto& [integrator, order] : {std::pair(scene::Integrator::kVerlet, reads),
                                              std::pair(scene::Integrator::kEuler, 0.8)}) {
        const auto error = [&](double step) {
          const Trajectory t = test::run_with(s, integrator, step);
          double most = 0.0;
          for (std::size_t k = 0; k < t.rows(); ++k)
            most = std::max(most, std::abs(t.column("stator_x")[k] - exact.column("stator_x")[k]));
          return most;
        };
        const auto c = test::convergence({2.5e-5, 1.25e-5, 6.25e-6, 3.125e-6}, error);
        EXPECT_GT(c.order(), order) << static_cast<int>(integrator) << ": " << c.text();
      }
    }
  }
}

// P = A' P A - A' P B (R + B' P B)^-1 B' P A + Q, by no code of the solver's; what is released and
// what is guessed decay.
TEST(QuadraticWithMagnets, GainsSolveTheRiccatiEquation) {
  for (const Hanging& loop : test::hung_rotors()) {
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
    for (const Eigen::MatrixXd& closed : {(a - b * d.gain).eval(), (a - a * d.filter * c).eval()}) {
      const auto poles = real_eigenvalues(closed).value();
      for (const auto& z : poles) EXPECT_LT(std::abs(z), 1.0);
    }
  }
}

// The gains of rotor and ring, with what the memory of a slow motion is put in its place.
double distance(const QuadraticDesign& d, const QuadraticDesign& old, const Eigen::MatrixXd& slow) {
  const Eigen::Index n = 2 * old.plant.half();
  return (d.gain.leftCols(n) + d.gain.rightCols(d.gain.cols() - n) * slow - old.gain).norm() /
         old.gain.norm();
}

// An amplifier without lag and a control without delay: the gains of the law without their states,
// in first order. The current is then -P s - D s', the command -P s.
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
  const auto amplifiers = test::convergence({2e-5, 1e-5, 5e-6, 2.5e-6}, [&](double lag) {
    Hanging late = plain;
    late.amplifier = "amplifier = {bandwidth = " + std::to_string(1.0 / lag) + "}";
    return distance(design_of(levitated(late, "lqr")), old, first_of(old, 3000.0, 2.0));
  });
  EXPECT_NEAR(amplifiers.order(), 1.0, 0.1) << amplifiers.text();
  const Hanging stiff{"", "derivative = 0.0", "", "derivative = 1.0"};
  const QuadraticDesign asked = design_of(levitated(stiff, "lqg"));
  const auto samples = test::convergence({10e-6, 5e-6, 2.5e-6, 1.25e-6}, [&](double every) {
    Hanging held = stiff;
    held.first += ", sample_time = " + std::to_string(1e6 * every) + "e-6";
    QuadraticDesign d = design_of(levitated(held, "lqg"));
    // Only the command of its memory counts: a law without derivative and integral needs nothing
    // else.
    d.gain = d.gain.leftCols(14).eval();
    return distance(d, asked, first_of(asked, 3000.0, 0.0));
  });
  EXPECT_NEAR(samples.order(), 1.0, 0.1) << samples.text();
}

// States after those of rotor and ring, in the order in which they act, x before y.
TEST(QuadraticWithMagnets, ThePlantNamesWhatTheBearingsRemember) {
  const scene::Scene s = levitated(test::hung_rotors()[0], "lqr");
  const LinearPlant p = plant_of(prepare(s), 0, s.rotor.speed);
  const std::vector<std::string> names{"bearing_integral_x", "bearing_integral_y",
                                       "bearing_rate_x",     "bearing_rate_y",
                                       "bearing_current_x",  "bearing_current_y"};
  EXPECT_EQ(p.memory_names, names);
  EXPECT_EQ(p.a.rows(), 12 + 6);
  // k_i of the first bearing over the first mode's mass, through its shape.
  EXPECT_NEAR(p.a(6, 16), 40.0 * 0.9 / 2.0, 1e-12);
  EXPECT_NEAR(p.a(16, 12), -8000.0, 1e-9) << "the current follows what is stored";
}

TEST(QuadraticWithMagnets, RefusesSamplesThatDoNotMeetItsOwn) {
  const auto why = [](const Hanging& loop, const std::string& kind) {
    return test::message_of<scene::SceneError>([&] { prepare(levitated(loop, kind)); });
  };
  const Hanging sampled = test::hung_rotors()[1];
  EXPECT_EQ(why(sampled, "lqr"), "");
  EXPECT_EQ(why(sampled, "lqg"), "");
  Hanging beside = sampled;
  beside.first = "derivative = 2.0, sample_time = 0.7e-4";
  EXPECT_TRUE(test::contains(why(beside, "lqg"), "not a whole multiple"));
  beside.first = "derivative = 2.0, sample_time = 1e-4";
  beside.second = "derivative = 1.0, sample_time = 5e-5";
  EXPECT_TRUE(test::contains(why(beside, "lqg"), "a different sample time"));
}

}  // namespace
}  // namespace rotorub
