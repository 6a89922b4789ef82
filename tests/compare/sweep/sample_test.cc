#include "compare/sweep/sample.h"

#include <cmath>
#include <set>

#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

Vary range(const std::string& key, double from, double to, std::int64_t count) {
  Vary vary;
  vary.key = key;
  vary.from = from;
  vary.to = to;
  vary.count = count;
  return vary;
}

Study hypercube(std::int64_t runs, std::uint64_t seed) {
  Study study;
  study.kind = SampleKind::kLatinHypercube;
  study.runs = runs;
  study.seed = seed;
  study.vary = {range("a", 0.0, 1.0, 0), range("b", -2.0, 6.0, 0)};
  return study;
}

TEST(Sample, OfAGridTheLastKeyRunsFastest) {
  Study study;
  study.vary = {range("a", 0.0, 1.0, 2), range("b", 10.0, 30.0, 3)};
  const Sample sample(study);
  ASSERT_EQ(sample.size(), 6);
  EXPECT_EQ(sample.at(1)[0].number, 0.0);
  EXPECT_EQ(sample.at(1)[1].number, 20.0);
  EXPECT_EQ(sample.at(3)[0].number, 1.0);
  EXPECT_EQ(sample.at(5)[1].number, 30.0);
}

TEST(Sample, EndsAreExact) {
  Study study;
  study.vary = {range("a", 0.1, 0.7, 7)};
  study.vary[0].spacing = Spacing::kLog;
  const Sample sample(study);
  EXPECT_EQ(sample.at(0)[0].number, 0.1);
  EXPECT_EQ(sample.at(6)[0].number, 0.7);
  EXPECT_NEAR(*sample.at(3)[0].number, std::sqrt(0.07), 1e-15);
}

// Every order visits every place once, for powers of two, one more and one less.
TEST(Permutation, IsOne) {
  for (const std::uint64_t n : {1u, 2u, 3u, 4u, 5u, 63u, 64u, 65u, 1000u, 4097u}) {
    for (const std::uint64_t key : {0u, 1u, 77u}) {
      const Permutation order(n, key);
      std::set<std::uint64_t> seen;
      for (std::uint64_t i = 0; i < n; ++i) seen.insert(order.at(i));
      EXPECT_EQ(seen.size(), n);
      EXPECT_EQ(*seen.rbegin(), n - 1);
    }
  }
}

TEST(LatinHypercube, HasOnePointInEveryCellOfEveryKey) {
  const Study study = hypercube(257, 3);
  const Sample sample(study);
  for (std::size_t k = 0; k < study.vary.size(); ++k) {
    std::set<int> cells;
    for (std::int64_t i = 0; i < sample.size(); ++i) {
      const double share =
          (*sample.at(i)[k].number - study.vary[k].from) / (study.vary[k].to - study.vary[k].from);
      cells.insert(static_cast<int>(std::floor(share * 257.0)));
    }
    EXPECT_EQ(cells.size(), 257u);
  }
}

// The keys are independent: of 1000 points the correlation of two random orders is 0 within four
// standard deviations, 4 / sqrt(1000).
TEST(LatinHypercube, KeysAreNotCorrelated) {
  const Study study = hypercube(1000, 1);
  const Sample sample(study);
  double sum = 0.0;
  for (std::int64_t i = 0; i < sample.size(); ++i) {
    const auto point = sample.at(i);
    sum += (*point[0].number - 0.5) * ((*point[1].number + 2.0) / 8.0 - 0.5);
  }
  EXPECT_LT(std::abs(12.0 * sum / 1000.0), 4.0 / std::sqrt(1000.0));
}

// These points are fixed: a seed must always give them, or a sweep could not continue on another
// machine.
TEST(LatinHypercube, OfASeedIsTheSameEverywhere) {
  const Study study = hypercube(10, 42);
  const Sample sample(study);
  EXPECT_EQ(sample.at(0)[0].text, "0.44176126422697976");
  EXPECT_EQ(sample.at(9)[1].text, "1.7391527841610772");
  const Study again = hypercube(10, 43);
  const Sample other(again);
  EXPECT_NE(sample.at(0)[0].text, other.at(0)[0].text);
}

}  // namespace
}  // namespace rotorub::sweep
