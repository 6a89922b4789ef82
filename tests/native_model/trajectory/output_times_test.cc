// When rows are written: multiples of the spacing, the end, and what was asked for beside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

scene::Run make_run(double end, double spacing, std::vector<double> times = {}) {
  scene::Run run;
  run.end = end;
  run.output_step = spacing;
  run.output_times = std::move(times);
  return run;
}

bool holds(const std::vector<double>& times, double t) {
  return std::find(times.begin(), times.end(), t) != times.end();
}

TEST(OutputTimes, AreMultiplesFromZeroToTheEnd) {
  const std::vector<double> times = output_times(make_run(0.5, 1e-3));
  ASSERT_EQ(times.size(), 501u);
  EXPECT_EQ(times.front(), 0.0);
  EXPECT_EQ(times[7], 7 * 1e-3);
  EXPECT_EQ(times.back(), 0.5);
}

TEST(OutputTimes, AThousandRowsByDefault) {
  scene::Run run;
  run.end = 0.3;
  const std::vector<double> times = output_times(run);
  EXPECT_EQ(times.size(), 1001u);
  EXPECT_EQ(times.back(), 0.3) << "the end itself, whatever 1000 times a thousandth comes to";
}

TEST(OutputTimes, TheEndCountsThoughItIsNoMultiple) {
  const std::vector<double> times = output_times(make_run(0.25, 0.1));
  EXPECT_EQ(times, (std::vector<double>{0.0, 0.1, 0.2, 0.25}));
  EXPECT_EQ(output_times(make_run(0.25, 1.0)), (std::vector<double>{0.0, 0.25}));
}

TEST(OutputTimes, TheEndIsMetOnceForAnySpacing) {
  // Where the last multiple is off the end by round-off, either way, it is the end.
  for (const double end : {0.1, 0.3, 0.7, 1.1, 2.3, 1.0 / 3.0}) {
    for (const int parts : {3, 7, 10, 30, 49, 1000}) {
      const std::vector<double> times = output_times(make_run(end, end / parts));
      ASSERT_EQ(times.size(), static_cast<std::size_t>(parts) + 1) << end << " / " << parts;
      EXPECT_EQ(times.back(), end);
    }
  }
}

TEST(OutputTimes, UnionInOrderWithoutDoubles) {
  const std::vector<double> times =
      output_times(make_run(0.4, 0.1, {0.1234, 0.2, 0.2, 0.0, 0.4, 0.35}));
  EXPECT_EQ(times.size(), 5u + 2u);
  EXPECT_TRUE(holds(times, 0.1234));
  EXPECT_TRUE(holds(times, 0.35));
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(std::adjacent_find(times.begin(), times.end()), times.end());
}

TEST(OutputTimes, ARequestedTimeStandsForTheMultipleThatIsItButForRoundOff) {
  // 3 * 0.1 is 0.30000000000000004: the same instant, asked for as 0.3.
  ASSERT_NE(3 * 0.1, 0.3);
  const std::vector<double> times = output_times(make_run(0.5, 0.1, {0.3}));
  EXPECT_EQ(times.size(), 6u);
  EXPECT_TRUE(holds(times, 0.3)) << "exactly as given";
  EXPECT_FALSE(holds(times, 3 * 0.1));
  // Two requests are two requests, however near.
  const double next = std::nextafter(0.3, 1.0);
  EXPECT_EQ(output_times(make_run(0.5, 0.1, {0.3, next})).size(), 7u);
}

}  // namespace
}  // namespace rotorub
