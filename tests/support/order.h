// Order of convergence from the errors at several steps.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "native_model/trajectory/trajectory.h"
#include "tests/support/native_run.h"

namespace rotorub::test {

// Largest distance of the rotor over all rows, m.
inline double rotor_error(const Trajectory& a, const Trajectory& b) {
  const auto &ax = a.column("rotor_x"), &ay = a.column("rotor_y");
  const auto &bx = b.column("rotor_x"), &by = b.column("rotor_y");
  double most = 0.0;
  for (std::size_t k = 0; k < std::min(a.rows(), b.rows()); ++k) {
    most = std::max(most, std::hypot(ax[k] - bx[k], ay[k] - by[k]));
  }
  return most;
}

// The same distance from the exact position, exact(t), as a complex number.
template <class Exact>
double orbit_error(const Trajectory& a, const Exact& exact) {
  const auto &x = a.column("rotor_x"), &y = a.column("rotor_y"), &time = a.column("t");
  double most = 0.0;
  for (std::size_t k = 0; k < a.rows(); ++k) {
    most = std::max(most, std::abs(std::complex<double>(x[k], y[k]) - exact(time[k])));
  }
  return most;
}

// Largest error over all rows, m: of the positions of rotor and ring, and of the angles of the spin
// and of a turning ring as arcs of `radius` (0: without them). The rows should be at ends of steps,
// because impacts between them are interpolated with first-order errors.
inline double trajectory_error(const Trajectory& a, const Trajectory& b, double radius = 0.0) {
  const auto point = [&](const char* x, const char* y, std::size_t k) {
    return std::hypot(a.column(x)[k] - b.column(x)[k], a.column(y)[k] - b.column(y)[k]);
  };
  double most = 0.0;
  for (std::size_t k = 0; k < std::min(a.rows(), b.rows()); ++k) {
    double turn = std::abs(a.column("spin_angle")[k] - b.column("spin_angle")[k]);
    if (a.has("ring_angle") && b.has("ring_angle")) {
      turn = std::max(turn, std::abs(a.column("ring_angle")[k] - b.column("ring_angle")[k]));
    }
    most = std::max(
        {most, point("rotor_x", "rotor_y", k), point("stator_x", "stator_y", k), radius * turn});
  }
  return most;
}

struct Convergence {
  std::vector<double> steps, errors;  // s, m

  // Slope of log error over log step by least squares, because impacts fall at random within their
  // steps and single errors scatter.
  double order() const {
    const auto n = static_cast<double>(steps.size());
    double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const double x = std::log(steps[k]), y = std::log(std::max(errors[k], 1e-300));
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  }
  // Without the errors that may be round-off.
  Convergence above(double floor) const {
    Convergence c;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      if (errors[k] <= floor) continue;
      c.steps.push_back(steps[k]);
      c.errors.push_back(errors[k]);
    }
    return c;
  }

  // "order 1.98: 3.1e-07 7.9e-08 ..."
  std::string text() const {
    char number[32];
    std::snprintf(number, sizeof number, "order %5.2f:", order());
    std::string out = number;
    for (const double e : errors) {
      std::snprintf(number, sizeof number, " %.1e", e);
      out += number;
    }
    return out;
  }
};

// Evaluates error(step) at each of the steps.
template <class Error>
Convergence convergence(const std::vector<double>& steps, const Error& error) {
  Convergence c;
  c.steps = steps;
  for (const double step : steps) c.errors.push_back(error(step));
  return c;
}

// Whether `verlet` has this order on a scene with a known motion.
// error(run): distance of the run from the known motion, m. last: upper limit of the error at the
// finest step.
template <class Error>
void expect_order_of_steps(const scene::Scene& scene, const std::vector<double>& steps,
                           double order, const Error& error,
                           double last = std::numeric_limits<double>::infinity()) {
  const Convergence c = convergence(
      steps, [&](double step) { return error(run_with(scene, scene::Integrator::kVerlet, step)); });
  EXPECT_GT(c.order(), order) << c.text();
  EXPECT_LT(c.errors.back(), last) << c.text();
}

}  // namespace rotorub::test
