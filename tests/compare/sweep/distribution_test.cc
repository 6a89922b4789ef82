// Quantiles with closed forms, and what a study says of them.
#include "compare/sweep/distribution.h"

#include <cmath>

#include "compare/sweep/sample.h"
#include "tests/compare/sweep/studies.h"

namespace rotorub::sweep {
namespace {

using test::of_ring;
using test::StudyFolder;

constexpr double kShareError = 1e-13;  // relative

double normal_share(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

Distribution of(DistributionKind kind, double centre, double width) {
  Distribution d;
  d.kind = kind;
  d.centre = centre;
  d.width = width;
  return d;
}

TEST(Distribution, QuantilesAreTheInversesOfTheShares) {
  for (const double share : {1e-6, 0.05, 0.3, 0.5, 0.9, 1.0 - 1e-6}) {
    const double z = quantile(of(DistributionKind::kNormal, 0.0, 1.0), share);
    EXPECT_NEAR(normal_share(z), share, kShareError) << share;
    EXPECT_NEAR(quantile(of(DistributionKind::kNormal, 3.0, 0.5), share), 3.0 + 0.5 * z,
                kShareError * 5.0);
    const double log = quantile(of(DistributionKind::kLognormal, 2.0, 0.3), share);
    EXPECT_NEAR(log, 2.0 * std::exp(0.3 * z), kShareError * log);
    const double weibull = quantile(of(DistributionKind::kWeibull, 4.0, 2.0), share);
    EXPECT_NEAR(weibull, 4.0 * std::sqrt(-std::log1p(-share)), 1e-9 * weibull);
  }
}

// From 1 to 5, mode 2: a share of (x - 1)^2 / 4 below the mode, 1 - (5 - x)^2 / 12 above it.
TEST(Distribution, ATriangleIsTwoParabolas) {
  Distribution d = of(DistributionKind::kTriangular, 2.0, 1.0);
  d.from = 1.0;
  d.to = 5.0;
  EXPECT_NEAR(quantile(d, 0.09), 1.6, kShareError);
  EXPECT_NEAR(quantile(d, 0.25), 2.0, kShareError);
  EXPECT_NEAR(quantile(d, 0.97), 4.4, 1e-12);
}

// Within [a, b] the share F(x) is (P(x) - P(a)) / (P(b) - P(a)).
TEST(Distribution, EndsCutAndScaleUp) {
  Distribution d = of(DistributionKind::kNormal, 0.0, 1.0);
  d.from = -0.5;
  d.to = 2.0;
  const double a = normal_share(-0.5), b = normal_share(2.0);
  for (const double share : {0.01, 0.4, 0.99})
    EXPECT_NEAR((normal_share(quantile(d, share)) - a) / (b - a), share, kShareError);
  EXPECT_GE(quantile(d, 0.0), -0.5);
  EXPECT_LE(quantile(d, 1.0), 2.0);
}

TEST(Distribution, IsFiniteAtTheEnds) {
  for (const auto kind :
       {DistributionKind::kNormal, DistributionKind::kLognormal, DistributionKind::kWeibull}) {
    EXPECT_TRUE(std::isfinite(quantile(of(kind, 1.0, 1.0), 0.0)));
    EXPECT_TRUE(std::isfinite(quantile(of(kind, 1.0, 1.0), 1.0)));
  }
}

std::string drawn(const std::string& kind, const std::string& vary) {
  return of_ring() + "[sample]\nkind = \"" + kind + "\"\nruns = 64\nseed = 7\n[[vary]]\n" + vary;
}

TEST(DrawnStudy, HasWordsWholeNumbersAndDistributions) {
  const StudyFolder folder;
  for (const char* kind : {"random", "latin_hypercube", "sobol"}) {
    const Study study = folder.study(drawn(kind, R"(key = "contact.friction"
distribution = "normal"
mean = 0.3
deviation = 0.05
from = 0.2
[[vary]]
key = "run.integrator"
values = ["event", "verlet"]
[[vary]]
key = "controller.sensors.seed"
from = 1
to = 4
[[vary]]
key = "stator.stiffness"
from = "80 kN/m"
to = "120 kN/m"
)"));
    const Sample sample(study);
    ASSERT_EQ(sample.size(), 64);
    std::map<std::string, int> words;
    std::map<double, int> seeds;
    for (std::int64_t i = 0; i < sample.size(); ++i) {
      const auto point = sample.at(i);
      EXPECT_GE(*point[0].number, 0.2);
      ++words[point[1].text];
      ++seeds[*point[2].number];
      EXPECT_EQ(point[2].text.find('.'), std::string::npos) << "a whole number in digits";
      EXPECT_GE(*point[3].number, 8e4);
      EXPECT_LE(*point[3].number, 1.2e5);
    }
    ASSERT_EQ(words.size(), 2u) << kind;
    ASSERT_EQ(seeds.size(), 4u) << kind;
    EXPECT_EQ(seeds.begin()->first, 1.0);
    EXPECT_EQ(seeds.rbegin()->first, 4.0);
    if (std::string(kind) == "random") continue;
    for (const auto& [word, count] : words) EXPECT_EQ(count, 32) << kind << word;
    for (const auto& [seed, count] : seeds) EXPECT_EQ(count, 16) << kind << seed;
  }
}

// These points are fixed: a seed must always give them, or a sweep could not continue on another
// machine.
TEST(DrawnStudy, OfASeedIsTheSameEverywhere) {
  const StudyFolder folder;
  const std::string vary = "key = \"contact.friction\"\nfrom = 0\nto = 1\n";
  const Study random = folder.study(drawn("random", vary));
  EXPECT_EQ(Sample(random).at(5)[0].text, "0.4836041785327243");
  const Study sobol = folder.study(drawn("sobol", vary));
  EXPECT_EQ(Sample(sobol).at(5)[0].text, "0.9750788863334513");
}

TEST(GridStudy, OfWholeNumbersHasEachOrEvenlySpaced) {
  const StudyFolder folder;
  const auto grid = [&](const std::string& vary) {
    return of_ring() + "[sample]\nkind = \"grid\"\n[[vary]]\nkey = \"controller.sensors.seed\"\n" +
           vary;
  };
  const Study all = folder.study(grid("from = 3\nto = 7\n"));
  ASSERT_EQ(Sample(all).size(), 5);
  EXPECT_EQ(Sample(all).at(4)[0].text, "7");
  const Study even = folder.study(grid("from = 1\nto = 9\ncount = 3\n"));
  EXPECT_EQ(Sample(even).at(1)[0].text, "5");
  EXPECT_NE(folder.refusal(grid("from = 1\nto = 9\ncount = 4\n")).find("not all whole"),
            std::string::npos);
  EXPECT_NE(folder.refusal(grid("from = 1.5\nto = 9\n")).find("whole number"), std::string::npos);
  EXPECT_NE(folder.refusal(grid("from = 1\nto = 9\nspacing = \"log\"\n")).find("whole numbers"),
            std::string::npos);
}

TEST(DrawnStudy, SaysWhatADistributionLacks) {
  const StudyFolder folder;
  const std::string friction = "key = \"contact.friction\"\n";
  const struct {
    std::string vary, says;
  } cases[] = {
      {"distribution = \"normal\"\nmean = 0.3\n", "vary[0].deviation: missing"},
      {"distribution = \"normal\"\nmean = 0.3\ndeviation = 0\n", "above 0"},
      {"distribution = \"normal\"\nmean = 0.3\ndeviation = 0.1\nfrom = 2\nto = 1\n",
       "above `from`"},
      {"distribution = \"gauss\"\n", "choose from uniform, normal, lognormal, triangular, weibull"},
      {"distribution = \"uniform\"\nfrom = 0.1\nto = 0.2\nmode = 0.1\n",
       "belongs to distribution = \"triangular\""},
      {"distribution = \"triangular\"\nfrom = 0.1\nto = 0.2\nmode = 0.3\n", "between `from`"},
      {"distribution = \"lognormal\"\nmedian = -1\nlog_deviation = 0.1\n", "above 0"},
      {"mean = 0.3\nfrom = 0\nto = 1\n", "distribution: missing"},
      {"from = 0\nto = 1\ncount = 3\n", "only for a grid"},
      {"from = 0\nto = 1\ncolumn = \"mu\"\n", "needs the points' file"},
  };
  for (const auto& c : cases) {
    const std::string said = folder.refusal(drawn("random", friction + c.vary));
    EXPECT_NE(said.find(c.says), std::string::npos) << c.says << "\n" << said;
  }
}

}  // namespace
}  // namespace rotorub::sweep
