// Every pair of a machine's parts, by every fixed-step scheme against `event`: the error must fall
// with the step at the scheme's order. Terms that each work alone and go wrong together (unbalance,
// gyroscopics and a free spin, say) show as an order lost.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/native_model/hard/orders.h"

namespace rotorub::test {
namespace {

class LongPairs : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Pair> pairs() const { return pairs_from(GetParam(), Pairs::kEveryEighth); }
};

TEST_P(LongPairs, VerletIsOfSecondOrder) {
  expect_order(pairs(), Integrator::kVerlet, kVerletOrder);
}

class NightlyPairs : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Pair> pairs() const { return pairs_from(GetParam(), Pairs::kAll); }
};

TEST_P(NightlyPairs, VerletIsOfSecondOrder) {
  expect_order(pairs(), Integrator::kVerlet, kVerletOrder);
}

INSTANTIATE_TEST_SUITE_P(From, NightlyPairs, ::testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });
INSTANTIATE_TEST_SUITE_P(From, LongPairs, ::testing::ValuesIn(part_names()),
                         [](const auto& part) { return part.param; });

}  // namespace
}  // namespace rotorub::test
