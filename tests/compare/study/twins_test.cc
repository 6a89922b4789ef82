// Runs that start almost alike.
#include "compare/study/twins.h"

#include <gtest/gtest.h>

#include "compare/base/in_parallel.h"
#include "compare/engine/mujoco_engine.h"
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

// On whichever thread it runs, a twin has the bits of the run of its start.
void expect_runs_of_their_starts(const Engine& engine, const scene::Scene& scene) {
  TwinParameters parameters;
  parameters.count = 6;
  parameters.output_times = {0.01, 0.02};
  const Twins twins = run_twins(engine, scene, engine.run(scene, {}), 1e-6, parameters);
  ASSERT_EQ(twins.metrics.size(), 6U);
  for (int k = 0; k < parameters.count; ++k) {
    RunRequest request;
    request.perturbation_ulps = twin_ulps(k);
    request.output_times = parameters.output_times;
    const Trajectory alone = engine.run(scene, request);
    const auto at = static_cast<std::size_t>(k);
    EXPECT_EQ(twins.metrics[at].impulse_total, alone.statistics.impulse_total);
    EXPECT_EQ(twins.metrics[at].peak_force, alone.statistics.peak_force);
    EXPECT_FALSE(twins.divergences[at].time) << "bench_ring is not chaotic";
  }
}

TEST_F(TwinRuns, AreTheRunsOfTheirStarts) { expect_runs_of_their_starts(*event_, scene_); }

// MuJoCo steps in several threads at a time: the bits are those of a run alone, also for
// `cone-coulomb` with its memory.
TEST_F(TwinRuns, OfMujocoAreTheRunsOfTheirStarts) {
  const MujocoInPlace mujoco;
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb,
                             scene::ContactModel::kConeCoulomb}) {
    SCOPED_TRACE(to_string(contact));
    expect_runs_of_their_starts(*mujoco_engine(contact), scene_);
  }
}

// Batches follow each other until there are enough, independently of the number of threads.
TEST_F(TwinRuns, EndWhereTheyAreEnough) {
  const Trajectory original = event_->run(scene_, {});
  TwinParameters parameters;
  parameters.count = 11;
  parameters.output_times = {0.02};
  const auto count = [&](std::size_t enough, Jobs jobs) {
    parameters.jobs = jobs;
    parameters.enough = [enough](const Twins& so_far) { return so_far.metrics.size() >= enough; };
    return run_twins(*event_, scene_, original, 1e-6, parameters).metrics.size();
  };
  for (const Jobs jobs : {1, 2, 3}) {
    EXPECT_EQ(count(0, jobs), 0U);
    EXPECT_EQ(count(1, jobs), 4U);
    EXPECT_EQ(count(5, jobs), 8U);
    EXPECT_EQ(count(100, jobs), 11U);
  }
}

// The result does not depend on the thread that finds it first.
TEST(InParallel, ThrowsTheFirstFailure) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    try {
      in_parallel(8, 0, nullptr, {}, [](std::size_t k) {
        if (k >= 1) throw std::runtime_error(std::to_string(k));
      });
      ADD_FAILURE();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "1");
    }
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
