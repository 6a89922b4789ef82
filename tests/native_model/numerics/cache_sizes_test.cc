// Eigen splits products of matrices by the sizes of the processor's caches, and each way to split
// them sums in its own order: left to itself it gave the states of a magnetic bearing other last
// bits on a processor with 48 kB of first cache than on one with 32.
#include <gtest/gtest.h>

#include <Eigen/Core>

namespace rotorub {
namespace {

TEST(CacheSizes, AreThoseOfNoProcessor) {
  EXPECT_EQ(Eigen::l1CacheSize(), 32 * 1024);
  EXPECT_EQ(Eigen::l2CacheSize(), 256 * 1024);
  EXPECT_EQ(Eigen::l3CacheSize(), 2 * 1024 * 1024);
}

}  // namespace
}  // namespace rotorub
