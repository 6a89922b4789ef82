// Eigen splits products of matrices by the sizes of the processor's caches, and each split has its
// own order of sums. By default the states of a magnetic bearing differed in their last bits
// between processors with 48 kB and 32 kB of first-level cache.
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
