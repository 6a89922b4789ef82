// Packed tracks: the samples that a reader gets back, and the number of knots.
#include "compare/report/pack/track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "tests/compare/report/unpacked_track.h"

namespace rotorub {
namespace {

using test::take_column;
using test::UnpackedTrack;

using Values = std::vector<double>;

// The largest error at the samples, in tolerances. Of two samples of one time the later counts.
double worst(const Samples& samples, const Track& track) {
  const UnpackedTrack unpacked(track);
  double most = 0.0;
  for (std::size_t i = 0; i < samples.t.size(); ++i) {
    if (i + 1 < samples.t.size() && samples.t[i + 1] == samples.t[i]) continue;
    double square = 0.0;
    for (std::size_t c = 0; c < samples.value.size(); ++c) {
      square += std::pow(unpacked.at(samples.t[i], c) - samples.value[c][i], 2);
    }
    most = std::max(most, std::sqrt(square) / samples.tolerance[i]);
  }
  return most;
}

// A circle of 0.5 mm at `w` rad/s, n rows at a spacing, from `start` on.
Samples circle(double w, double spacing, std::size_t n, double start) {
  constexpr double kRadius = 5e-4;
  Samples s;
  s.value.resize(2);
  s.rate.resize(2);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = start + static_cast<double>(i) * spacing;
    s.t.push_back(t);
    s.value[0].push_back(kRadius * std::cos(w * t));
    s.value[1].push_back(kRadius * std::sin(w * t));
    s.rate[0].push_back(-kRadius * w * std::sin(w * t));
    s.rate[1].push_back(kRadius * w * std::cos(w * t));
    s.tolerance.push_back(1e-6);
  }
  return s;
}

TEST(WholeNumbers, ComeBack) {
  using Limits = std::numeric_limits<std::int64_t>;
  std::vector<std::int64_t> numbers{0, 63, -64, 64, -65, 8191, 8192, -1, 1LL << 40, 5};
  numbers.insert(numbers.end(), {Limits::max() / 2, Limits::min() / 2});
  std::string bytes = "x";
  put_column(numbers, bytes);
  put_column({7}, bytes);
  std::size_t at = 1;
  EXPECT_EQ(take_column(bytes, at, numbers.size()), numbers);
  EXPECT_EQ(take_column(bytes, at, 1), std::vector<std::int64_t>{7});
  EXPECT_EQ(at, bytes.size());
}

// As its header describes them: zigzag, seven bits a byte.
TEST(WholeNumbers, AreOfTheStatedBytes) {
  std::string bytes;
  put_column({1, 0, 300}, bytes);  // differences 1, -1, 300 -> 2, 1, 600 = 4 * 128 + 88
  EXPECT_EQ(bytes, std::string("\x02\x01\xd8\x04", 4));
}

TEST(Track, IsWithinItsToleranceAtEverySample) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  for (const TrackKind kind : {TrackKind::kLinear, TrackKind::kHermite, TrackKind::kHold}) {
    for (const double size : {1e-9, 1.0, 1e6}) {
      Samples s;
      s.value.resize(2);
      if (kind == TrackKind::kHermite) s.rate.resize(2);
      double t = -3.0, walk = 0.0;
      for (int i = 0; i < 2000; ++i) {
        t += std::exp(2.0 * noise(random)) * 1e-4;  // spacings over four decades
        walk += i % 100 < 50 ? 0.01 * noise(random) : 0.0;
        s.t.push_back(t);
        for (auto& column : s.value) column.push_back(size * (i % 300 == 0 ? 40.0 : walk));
        for (auto& column : s.rate) column.push_back(size * noise(random));
        s.tolerance.push_back(size * 0.01 * (1.0 + std::abs(walk)));
      }
      const Track track = pack(kind, s);
      EXPECT_LE(worst(s, track), 1.0) << to_string(kind) << size;
      EXPECT_LE(track.knots, s.t.size());
    }
  }
}

// The error of a cubic Hermite over h is h^4 max |f''''| / 384, of a line h^2 max |f''| / 8: what
// the least number of knots follows from.
TEST(Track, HasFewKnotsWhereItIsSmooth) {
  const double w = 314.0;
  Samples s = circle(w, 1e-5, 50001, 0.0);
  const double span = 0.5;
  const Track cubic = pack(TrackKind::kHermite, s);
  const double cubic_least = span / std::pow(384.0 * 1e-6 / (5e-4 * std::pow(w, 4)), 0.25);
  EXPECT_LE(worst(s, cubic), 1.0);
  EXPECT_GE(static_cast<double>(cubic.knots), cubic_least);
  EXPECT_LE(static_cast<double>(cubic.knots), 1.5 * cubic_least + 2.0);
  s.rate.clear();
  const Track line = pack(TrackKind::kLinear, s);
  EXPECT_LE(worst(s, line), 1.0);
  EXPECT_LE(static_cast<double>(line.knots),
            1.5 * span / std::sqrt(8.0 * 1e-6 / (5e-4 * w * w)) + 2.0);
  EXPECT_GT(line.knots, 3 * cubic.knots);
}

// After an hour a float32 does not resolve times closer than 0.24 ms: half a radian of this whirl.
TEST(Track, IsAsFineLateInALongRun) {
  const Samples s = circle(2000.0, 1e-5, 20001, 3600.0);
  EXPECT_LE(worst(s, pack(TrackKind::kHermite, s)), 1.0);
  Samples whole = circle(2000.0, 1e-5, 2001, 3600.0);
  whole.t.insert(whole.t.begin(), 0.0);
  for (auto& column : whole.value) column.insert(column.begin(), 0.0);
  for (auto& column : whole.rate) column.insert(column.begin(), 0.0);
  whole.tolerance.insert(whole.tolerance.begin(), 1e-5);
  for (double& tolerance : whole.tolerance) tolerance = 1e-5;  // a tick is 3.4 us
  EXPECT_LE(worst(whole, pack(TrackKind::kHermite, whole)), 1.0);
}

TEST(Track, JumpsWhereTwoSamplesShareATime) {
  const Samples s{{0.0, 1.0, 1.0, 2.0}, {{0.0, 0.0, 5.0, 5.0}}, {}, {1e-3, 1e-3, 1e-3, 1e-3}};
  const UnpackedTrack track(pack(TrackKind::kLinear, s));
  EXPECT_NEAR(track.at(1.0 - 1e-6, 0), 0.0, 1e-3);
  EXPECT_NEAR(track.at(1.0, 0), 5.0, 1e-3);
  EXPECT_NEAR(track.at(1.5, 0), 5.0, 1e-3);
}

TEST(Track, HoldsFromItsSampleOn) {
  const double third = 1.0 / 3.0;
  const Samples s{{0.1, third, 0.7}, {{0.0, 2.0, 1.0}}, {}, {4.0, 4.0, 4.0}};
  const UnpackedTrack track(pack(TrackKind::kHold, s));
  EXPECT_EQ(track.at(third - 1e-6, 0), 0.0);
  EXPECT_EQ(track.at(third, 0), 2.0);
  EXPECT_EQ(track.at(0.7, 0), 1.0);
}

// A run that diverged: values that large need not be distinguished, but must not overflow.
TEST(Track, MayBeHuge) {
  const Samples s{
      {0.0, 1e-5, 2e-5}, {{1e-9, 1.0, -1e300}}, {{0.0, 1e5, 1e305}}, {3e-8, 1e-2, 1e298}};
  const UnpackedTrack track(pack(TrackKind::kHermite, s));
  EXPECT_NEAR(track.at(2e-5, 0), -1e300, 1e298);
  EXPECT_TRUE(std::isfinite(track.at(1e-5, 0)));
}

TEST(Track, MayHaveOneSampleOrNone) {
  const Track one = pack(TrackKind::kLinear, {{2.0}, {{3.0}}, {}, {1e-3}});
  EXPECT_EQ(one.knots, 1U);
  for (const double t : {0.0, 2.0, 9.0}) EXPECT_NEAR(UnpackedTrack(one).at(t, 0), 3.0, 1e-3);
  const Track none = pack(TrackKind::kHold, {{}, {{}}, {}, {}});
  EXPECT_EQ(none.knots, 0U);
  EXPECT_EQ(UnpackedTrack(none).at(1.0, 0), 0.0);
}

}  // namespace
}  // namespace rotorub
