// All state is in mjData: resets, copies and threads behave.
#include <gtest/gtest.h>

#include <thread>

#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "plugin/user_data.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

// A sampled controller that is on from the start: the plugin's memory is in use.
scene::Scene controlled() {
  return shipped("paper_sliding",
                 {"controller.on=0.0", "controller.sample_time=1e-4", "force[0].on=0.0",
                  "initial.steady=false", "contact.clearance=0.1 mm", "rotor.modes=2"});
}

class DataTest : public MujocoTest, public ::testing::WithParamInterface<const char*> {
 protected:
  DataTest() : model_(load(mjcf(scene()))) {}
  static scene::Scene scene() {
    return std::string(GetParam()) == "controlled" ? controlled() : shipped(GetParam());
  }
  void steps(mjData* d, int count) const {
    for (int k = 0; k < count; ++k) mj_step(model_.get(), d);
  }
  plugin::Hooks hooks_;
  ModelPointer model_;
};

constexpr int kDataSteps = 4000;

TEST_P(DataTest, ResetStartsAnew) {
  const DataPointer d = start(model_.get());
  steps(d.get(), kDataSteps);
  const std::vector<double> first = state_of(model_.get(), d.get());
  mj_resetDataKeyframe(model_.get(), d.get(), 0);
  steps(d.get(), kDataSteps);
  EXPECT_EQ(state_of(model_.get(), d.get()), first);
}

TEST_P(DataTest, CopyGoesOnAlike) {
  const DataPointer d = start(model_.get());
  steps(d.get(), kDataSteps);
  const DataPointer copy(mj_makeData(model_.get()));
  mj_copyData(copy.get(), model_.get(), d.get());
  steps(d.get(), kDataSteps);
  steps(copy.get(), kDataSteps);
  EXPECT_EQ(state_of(model_.get(), copy.get()), state_of(model_.get(), d.get()));
}

TEST_P(DataTest, ThreadsGetTheSameBits) {
  const std::vector<double> alone = state_after(model_.get(), kDataSteps);
  std::vector<double> results[4];
  std::vector<std::thread> threads;
  for (auto& result : results) {
    threads.emplace_back([&] { result = state_after(model_.get(), kDataSteps); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

TEST_P(DataTest, StepInTwoHalvesIsTheSame) {
  const std::vector<double> whole = state_after(model_.get(), kDataSteps);
  const DataPointer d = start(model_.get());
  for (int k = 0; k < kDataSteps; ++k) {
    mj_step1(model_.get(), d.get());
    mj_step2(model_.get(), d.get());
  }
  EXPECT_EQ(state_of(model_.get(), d.get()), whole);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DataTest,
                         ::testing::Values("bench_ring", "paper_passive", "controlled"));

}  // namespace
}  // namespace rotorub::test
