// Sobol's sequence: points of scipy.stats.qmc (1.10, unscrambled), and what makes it even.
#include "compare/sweep/sample.h"

#include <cmath>
#include <set>

#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

double unit(std::uint64_t bits) { return static_cast<double>(bits) * 0x1p-64; }

TEST(Sobol, HasThePointsOfAnotherProgram) {
  const Sobol sobol(5);
  const struct {
    std::int64_t index;
    double point[5];
  } known[] = {{0, {0.0, 0.0, 0.0, 0.0, 0.0}},
               {1, {0.5, 0.5, 0.5, 0.5, 0.5}},
               {1000, {0.2197265625, 0.0966796875, 0.5185546875, 0.6767578125, 0.2802734375}}};
  for (const auto& k : known) {
    const auto point = sobol.at(k.index);
    for (std::size_t d = 0; d < 5; ++d) EXPECT_EQ(unit(point[d]), k.point[d]) << k.index << d;
  }
}

// The first 256 points of two keys, drawn with a seed, have one point in each of the 256 boxes of
// 2^-j by 2^-(8-j), for every j: they form a (0, 8, 2)-net, which the digital shift keeps.
TEST(Sobol, HasOnePointInEveryElementaryBox) {
  const test::StudyFolder folder;
  const Study study = folder.study(test::of_ring() + R"([sample]
kind = "sobol"
runs = 256
seed = 11
[[vary]]
key = "contact.friction"
from = 0
to = 1
[[vary]]
key = "contact.restitution"
from = 0
to = 1
)");
  const Sample sample(study);
  for (int j = 0; j <= 8; ++j) {
    std::set<std::pair<int, int>> boxes;
    for (std::int64_t i = 0; i < sample.size(); ++i) {
      const auto point = sample.at(i);
      boxes.emplace(static_cast<int>(std::ldexp(*point[0].number, j)),
                    static_cast<int>(std::ldexp(*point[1].number, 8 - j)));
    }
    EXPECT_EQ(boxes.size(), 256u) << j;
  }
}

}  // namespace
}  // namespace rotorub::sweep
