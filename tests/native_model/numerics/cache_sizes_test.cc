// Eigen splits products of matrices by the sizes of the processor's caches, and each way to split
// them sums in its own order: left to itself it gave the states of a magnetic bearing other last
// bits on a processor with 48 kB of first cache than on one with 32.
#include <gtest/gtest.h>

#include <Eigen/Core>

#include "native_model/system/model.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

TEST(CacheSizes, AreThoseOfNoProcessor) {
  EXPECT_EQ(Eigen::l1CacheSize(), 32 * 1024);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 * 1024);
  EXPECT_EQ(Eigen::l3CacheSize(), 2 * 1024 * 1024);
}

// That the sizes matter, so that the test above can fail for a reason.
TEST(CacheSizes, AreSeenInTheBitsOfAState) {
  const scene::Scene scene = test::shipped("amb_machine");
  const Model usual = make_model(scene);
  Eigen::setCpuCacheSizes(48 * 1024, 2 * 1024 * 1024, 32 * 1024 * 1024);
  const Model other = make_model(scene);
  Eigen::setCpuCacheSizes(32 * 1024, 256 * 1024, 2 * 1024 * 1024);
  EXPECT_LT((usual.q0 - other.q0).norm(), 1e-12);
  EXPECT_EQ(usual.q0, make_model(scene).q0);
}

}  // namespace
}  // namespace rotorub
