// The scheme `midpoint` against the published states of bench_ring.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/native_run.h"

namespace rotorub {
namespace {

Eigen::Vector2d rotor(const Trajectory& t, std::size_t row) {
  return {t.column("rotor_x")[row], t.column("rotor_y")[row]};
}

// Published positions at 0.02 s and 0.5 s (two independent solvers, 1e-13).
TEST(MidpointBenchRing, ConvergesAtFirstOrderToThePublishedStates) {
  scene::Scene scene = test::shipped("bench_ring");
  scene.run.output_times = {0.02};
  const Eigen::Vector2d early{3.200529602935e-4, -1.197270224039e-3};
  const Eigen::Vector2d late{5.15768981628e-4, -2.036936721118e-3};
  double coarse = 0.0, finest = 0.0;
  for (const double step : {1e-4, 1e-5, 1e-6}) {
    const Trajectory t = test::run_with(scene, scene::Integrator::kMidpoint, step);
    const auto& times = t.column("t");
    const auto at =
        static_cast<std::size_t>(std::find(times.begin(), times.end(), 0.02) - times.begin());
    const double error = (rotor(t, at) - early).norm();
    EXPECT_LT(error, 0.05 * step) << "5e-7 m at 1e-5";
    EXPECT_LT((rotor(t, t.rows() - 1) - late).norm(), 0.05 * step);
    if (step == 1e-4) coarse = error;
    finest = error;
  }
  EXPECT_LT(finest, 0.05 * coarse) << "two decades of step, nearly two of error";
}

}  // namespace
}  // namespace rotorub
