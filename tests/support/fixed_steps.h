// The order of convergence of `verlet` on a scene with a known motion.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub::test {

// error(run): distance of the run from the known motion, m. last: upper limit of the error at the
// finest step.
template <class Error>
void expect_order_of_steps(const scene::Scene& scene, const std::vector<double>& steps,
                           double order, const Error& error,
                           double last = std::numeric_limits<double>::infinity()) {
  const Convergence c = convergence(steps, [&](double step) {
    const Trajectory run = run_with(scene, scene::Integrator::kVerlet, step);
    EXPECT_EQ(run.status, Status::kOk) << run.message;
    return error(run);
  });
  EXPECT_GT(c.order(), order) << c.text();
  EXPECT_LT(c.errors.back(), last) << c.text();
}

}  // namespace rotorub::test
