// Every pair of a machine's parts, by every fixed-step scheme against `event`: the error must fall
// with the step at the scheme's order. Terms that each work alone and go wrong together (unbalance,
// gyroscopics and a free spin, say) show as an order lost.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/ensemble.h"
#include "tests/native_model/hard/orders.h"

namespace rotorub::test {
namespace {

// The ensemble is `verlet` run by run, whatever the parts: what converges there converges here.
void expect_ensemble_is_run_by_run(const std::vector<Pair>& pairs) {
  constexpr double kRounding = 1e-15;  // m: rows are interpolated, also at the end of a step
  for (const Pair& pair : pairs) {
    const scene::Scene scene = pair.scene();
    const Model model = make_model(scene);
    // A scene with a compliant contact, or with a ring on a mount, is run by itself.
    if (refused(Integrator::kVerlet, pair.parts) || !scene.fits_lanes()) {
      EXPECT_THROW(Ensemble({model}, 1e-5), std::invalid_argument) << scene.name;
      continue;
    }
    for (const int n : {30, 450}) {
      const auto count = static_cast<std::int64_t>(std::llround(scene.run.end * 1e3 * n));
      const EnsembleRun run = Ensemble({model}, 1e-3 / n).run(count).front();
      const Trajectory alone = run_with(scene, Integrator::kVerlet, 1e-3 / n);
      ASSERT_EQ(run.status, alone.status) << scene.name;
      const Eigen::Vector2d end{alone.column("rotor_x").back(), alone.column("rotor_y").back()};
      EXPECT_LT((rotor_point(model, run.q.data()) - end).norm(), kRounding) << scene.name;
    }
  }
}

class LongPairs : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Pair> pairs() const { return pairs_from(GetParam(), Pairs::kEveryFourth); }
};

TEST_P(LongPairs, VerletIsOfSecondOrder) {
  expect_order(pairs(), Integrator::kVerlet, kVerletOrder);
}

TEST_P(LongPairs, EnsembleIsRunByRun) { expect_ensemble_is_run_by_run(pairs()); }

class NightlyPairs : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Pair> pairs() const { return pairs_from(GetParam(), Pairs::kAll); }
};

TEST_P(NightlyPairs, VerletIsOfSecondOrder) {
  expect_order(pairs(), Integrator::kVerlet, kVerletOrder);
}

TEST_P(NightlyPairs, EnsembleIsRunByRun) { expect_ensemble_is_run_by_run(pairs()); }

INSTANTIATE_TEST_SUITE_P(From, NightlyPairs, ::testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });
INSTANTIATE_TEST_SUITE_P(From, LongPairs, ::testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });

}  // namespace
}  // namespace rotorub::test
