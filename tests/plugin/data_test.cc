// All state is in mjData: threads get the same bits. (Resets and copies: torture_test.cc.)
#include <gtest/gtest.h>

#include <thread>

#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

// A sampled controller that is on from the start: the plugin's memory is in use.
scene::Scene controlled() {
  return shipped("paper_sliding",
                 {"controller.on=0.0", "controller.sample_time=1e-4", "force[0].on=0.0",
                  "initial.steady=false", "contact.clearance=0.1 mm", "rotor.modes=2"});
}

class DataTest : public HookedTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(DataTest, ThreadsGetTheSameBits) {
  constexpr int kSteps = 4000;
  const std::string name = GetParam();
  const ModelPointer m = load(mjcf(name == "controlled" ? controlled() : shipped(name)));
  const std::vector<double> alone = state_after(m.get(), kSteps);
  std::vector<double> results[4];
  std::vector<std::thread> threads;
  for (auto& result : results) {
    threads.emplace_back([&] { result = state_after(m.get(), kSteps); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DataTest,
                         ::testing::Values("bench_ring", "paper_passive", "controlled"));

}  // namespace
}  // namespace rotorub::test
