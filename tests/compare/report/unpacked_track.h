// The reader's side of a packed track, written from the description in track.h as the page's
// tracks.js is.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "compare/report/pack/track.h"

namespace rotorub::test {

// Reads `count` numbers from `at` on, which it moves.
inline std::vector<std::int64_t> take_column(std::string_view bytes, std::size_t& at,
                                             std::size_t count) {
  std::vector<std::int64_t> numbers;
  std::int64_t number = 0;
  while (numbers.size() < count) {
    std::uint64_t zigzag = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(bytes.at(at++));
      zigzag |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 128) break;
    }
    number += static_cast<std::int64_t>(zigzag >> 1) ^ -static_cast<std::int64_t>(zigzag & 1);
    numbers.push_back(number);
  }
  return numbers;
}

class UnpackedTrack {
 public:
  explicit UnpackedTrack(const Track& track) : track_(track) {
    std::size_t at = 0;
    ticks_ = take_column(track.bytes, at, track.knots);
    const auto columns = [&](double quantum) {
      std::vector<std::vector<double>> all(track.components);
      for (auto& column : all) {
        for (const std::int64_t n : take_column(track.bytes, at, track.knots))
          column.push_back(static_cast<double>(n) * quantum);
      }
      return all;
    };
    value_ = columns(track.quantum);
    if (track.kind == TrackKind::kHermite) rate_ = columns(track.rate_quantum);
  }

  // Of a component; t is clamped to the knots' range. At a jump the value after it. 0 without
  // knots.
  double at(double t, std::size_t component) const {
    if (ticks_.empty()) return 0.0;
    const std::int64_t now = std::llround((t - track_.start) / track_.tick);
    const auto& y = value_[component];
    const auto after = std::upper_bound(ticks_.begin(), ticks_.end(), now);
    if (after == ticks_.begin()) return y.front();
    const auto i = static_cast<std::size_t>(after - ticks_.begin()) - 1;
    if (track_.kind == TrackKind::kHold || i + 1 == ticks_.size()) return y[i];
    const auto ticks = static_cast<double>(ticks_[i + 1] - ticks_[i]);
    const double s = static_cast<double>(now - ticks_[i]) / ticks, r = 1.0 - s;
    if (track_.kind == TrackKind::kLinear) return r * y[i] + s * y[i + 1];
    const double h = ticks * track_.tick;
    const auto& v = rate_[component];
    const double cubic = r * r * ((1.0 + 2.0 * s) * y[i] + s * h * v[i]) +
                         s * s * ((3.0 - 2.0 * s) * y[i + 1] - r * h * v[i + 1]);
    return track_.floored ? std::max(cubic, std::min({y[i], y[i + 1], 0.0})) : cubic;
  }

 private:
  Track track_;
  std::vector<std::int64_t> ticks_;
  std::vector<std::vector<double>> value_, rate_;
};

}  // namespace rotorub::test
