// The error estimate of a step whose stages run away.
#include <gtest/gtest.h>

#include "native_model/numerics/dop853.h"

namespace rotorub {
namespace {

// A mass of 1 kg that is pressed into a wall with Hunt and Crossley's damping,
// p'' = -k p (1 + a p') - g, by steps much too long for it: each stage is about the square of the
// one before. Where the square of the third order's estimate was infinite and that of the fifth's
// was not, their blend was 0.
TEST(Dop853, AStepBeyondAllBoundsIsRefused) {
  const auto f = [](double, const double* y, double* dy) {
    constexpr double kStiffness = 1e7, kDamping = 300.0, kLoad = 100.0;
    dy[0] = y[1];
    dy[1] = -kStiffness * y[0] * (1.0 + kDamping * y[1]) - kLoad;
  };
  const double tolerance[] = {1e-16, 1e-12};
  for (const double speed : {0.05, 0.5}) {
    const double start[] = {0.0, speed};
    for (double h = 1e-4; h < 1.0; h *= 1.0005) {
      Dop853 step(2);
      f(0.0, start, step.first_slope());
      EXPECT_GT(step.trial(f, 0.0, start, h, tolerance), 1.0) << h << " s";
    }
  }
}

}  // namespace
}  // namespace rotorub
