#include "renders/framing.h"

#include <gtest/gtest.h>

#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

std::vector<Strike> strikes_at(const std::vector<double>& times) {
  std::vector<Strike> strikes;
  for (const double t : times) strikes.push_back({t, 1.0, {1.0, 0.0}});
  return strikes;
}

TEST(FilmClock, RunsEvenlyWithoutImpacts) {
  const FilmClock clock(0.1, 0.3, 8.0, {});
  EXPECT_EQ(clock.time(0.0), 0.1);
  EXPECT_DOUBLE_EQ(clock.time(0.5), 0.2);
  EXPECT_EQ(clock.time(1.0), 0.3);
  EXPECT_DOUBLE_EQ(clock.slow(0.2), 40.0);
}

TEST(FilmClock, StretchesAroundAnImpactInView) {
  const auto strikes = strikes_at({0.05, 0.2});  // the first is before the film
  const FilmClock clock(0.1, 0.3, 8.0, strikes);
  EXPECT_EQ(clock.impacts(), std::vector<double>{0.2});
  EXPECT_DOUBLE_EQ(clock.slow(0.2), 10.0 * clock.slow(0.12));
  EXPECT_DOUBLE_EQ(clock.slowest(), clock.slow(0.2));
  EXPECT_LT(clock.base(), 40.0) << "the film is as long as asked: the rest goes faster";
  EXPECT_EQ(clock.time(0.0), 0.1);
  EXPECT_EQ(clock.time(1.0), 0.3);
}

// slow(t) is what time(share) does: d(film)/d(run) by differences.
TEST(FilmClock, SaysHowSlowItIs) {
  const auto strikes = strikes_at({0.15, 0.2, 0.28});
  const double duration = 8.0;
  const FilmClock clock(0.1, 0.3, duration, strikes);
  double before = clock.time(0.0);
  constexpr int kFrames = 2000;
  for (int k = 1; k <= kFrames; ++k) {
    const double now = clock.time(static_cast<double>(k) / kFrames);
    ASSERT_GT(now, before) << "never stands, never goes back";
    const double slow = duration / kFrames / (now - before);
    EXPECT_NEAR(slow, clock.slow(0.5 * (now + before)), 0.02 * slow) << now;
    before = now;
  }
}

TEST(FilmClock, ManyImpactsShareHalfOfTheFilm) {
  std::vector<double> times;
  for (int k = 0; k < 700; ++k) times.push_back(0.1 + 0.2 * k / 700.0);
  auto strikes = strikes_at(times);
  strikes[350].impulse = 5.0;
  const FilmClock clock(0.1, 0.3, 8.0, strikes);
  EXPECT_EQ(clock.impacts().size(), 6U);
  EXPECT_EQ(clock.impacts().front(), strikes.front().t) << "the first touch";
  EXPECT_NEAR(clock.slow(strikes[350].t), clock.slowest(), 1e-9 * clock.slowest()) << "the hardest";
  // 8 s for 0.2 s would be 40 throughout; half of the film for impacts leaves 20 for the rest, and
  // a little more where they overlap or reach beyond the film.
  EXPECT_GE(clock.base(), 20.0);
  EXPECT_LT(clock.base(), 30.0);
}

}  // namespace
}  // namespace rotorub::renders
