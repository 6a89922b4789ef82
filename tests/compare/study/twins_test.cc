// Runs that start almost alike.
#include "compare/study/twins.h"

#include <gtest/gtest.h>

#include "tests/support/native_run.h"

namespace rotorub {
namespace {

class TwinRuns : public testing::Test {
 protected:
  const scene::Scene scene_ = test::shipped("bench_ring", {"run.end=0.02"});
  const std::unique_ptr<Engine> event_ = native_engine(scene::Integrator::kEvent);
};

TEST(Twins, StartOnBothSides) {
  std::vector<int> ulps;
  for (int k = 0; k < 4; ++k) ulps.push_back(twin_ulps(k));
  EXPECT_EQ(ulps, (std::vector<int>{1, -1, 2, -2}));
}

// Whichever thread ran it, a twin is the run of its start, to the bit.
TEST_F(TwinRuns, AreTheRunsOfTheirStarts) {
  const Trajectory original = event_->run(scene_, {});
  TwinParameters parameters;
  parameters.count = 5;
  parameters.output_times = {0.01, 0.02};
  const Twins twins = run_twins(*event_, scene_, original, 1e-6, parameters);
  ASSERT_EQ(twins.metrics.size(), 5U);
  for (int k = 0; k < parameters.count; ++k) {
    RunRequest request;
    request.perturbation_ulps = twin_ulps(k);
    request.output_times = parameters.output_times;
    const Trajectory alone = event_->run(scene_, request);
    const auto at = static_cast<std::size_t>(k);
    EXPECT_EQ(twins.metrics[at].impulse_total, alone.statistics.impulse_total);
    EXPECT_EQ(twins.metrics[at].peak_force, alone.statistics.peak_force);
    EXPECT_FALSE(twins.divergences[at].time) << "bench_ring is not chaotic";
  }
}

TEST_F(TwinRuns, AnInterruptLeavesNone) {
  const Trajectory original = event_->run(scene_, {});
  const std::atomic<bool> stop{true};
  TwinParameters parameters;
  parameters.output_times = {0.02};
  parameters.interrupt = &stop;
  EXPECT_TRUE(run_twins(*event_, scene_, original, 1e-6, parameters).metrics.empty());
}

}  // namespace
}  // namespace rotorub
