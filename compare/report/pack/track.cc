#include "compare/report/pack/track.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/plot_points.h"
#include "native_model/numerics/hermite.h"

namespace rotorub {

namespace {

using Integers = std::vector<std::int64_t>;

constexpr double kTicks = 1073741824.0;  // per run, 2^30: half a nanosecond for half a second
constexpr double kMostQuanta = 1e15;     // of a value: whole numbers that a double can represent
constexpr double kQuantumShare = 0.25;   // relative to the smallest tolerance
constexpr double kRateSpan =
    1.0 / 256.0;  // of the run: over so long a rate's quantum moves a value by one

// Applies the floor of a floored track between the values a and b.
double lifted(double y, double a, double b) { return std::max(y, std::min({a, b, 0.0})); }

double largest(const std::vector<std::vector<double>>& columns) {
  double most = 0.0;
  for (const auto& column : columns) {
    for (const double value : column) most = std::max(most, std::abs(value));
  }
  return most;
}

// The samples as whole numbers, and the values that a reader would get between any two of them.
class Quantised {
 public:
  Quantised(TrackKind kind, const Samples& samples, const Track& track)
      : kind_(kind), samples_(samples), track_(track) {
    for (const double t : samples.t) ticks_.push_back(std::llround((t - track.start) / track.tick));
    for (const auto& column : samples.value) values_.push_back(whole(column, track.quantum));
    for (const auto& column : samples.rate) rates_.push_back(whole(column, track.rate_quantum));
  }

  // True if the piece between these two samples is within the tolerance of every sample in it.
  bool holds(std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i <= to; ++i) {
      double square = 0.0;
      for (std::size_t c = 0; c < values_.size(); ++c) {
        const double error = between(from, to, i, c) - samples_.value[c][i];
        square += error * error;
      }
      if (!(square <= samples_.tolerance[i] * samples_.tolerance[i])) return false;
    }
    return true;
  }

  void write(const std::vector<std::size_t>& kept, std::string& bytes) const {
    put_column(pick(ticks_, kept), bytes);
    for (const Integers& column : values_) put_column(pick(column, kept), bytes);
    for (const Integers& column : rates_) put_column(pick(column, kept), bytes);
  }

 private:
  static Integers whole(const std::vector<double>& column, double quantum) {
    Integers numbers;
    numbers.reserve(column.size());
    for (const double value : column) numbers.push_back(std::llround(value / quantum));
    return numbers;
  }
  static Integers pick(const Integers& column, const std::vector<std::size_t>& kept) {
    Integers numbers;
    for (const std::size_t i : kept) numbers.push_back(column[i]);
    return numbers;
  }
  double value(std::size_t c, std::size_t i) const {
    return static_cast<double>(values_[c][i]) * track_.quantum;
  }
  double rate(std::size_t c, std::size_t i) const {
    return static_cast<double>(rates_[c][i]) * track_.rate_quantum;
  }
  // Value at the time of sample i of the piece from sample a to sample b.
  double between(std::size_t a, std::size_t b, std::size_t i, std::size_t c) const {
    if (ticks_[b] == ticks_[a]) return value(c, b);
    const auto h = static_cast<double>(ticks_[b] - ticks_[a]);
    const double s = static_cast<double>(ticks_[i] - ticks_[a]) / h;
    if (kind_ == TrackKind::kHermite) {
      const double y =
          hermite(value(c, a), rate(c, a), value(c, b), rate(c, b), h * track_.tick, s);
      return track_.floored ? lifted(y, value(c, a), value(c, b)) : y;
    }
    return (1.0 - s) * value(c, a) + s * value(c, b);
  }

  TrackKind kind_;
  const Samples& samples_;
  const Track& track_;
  Integers ticks_;
  std::vector<Integers> values_, rates_;
};

// The farthest sample that one piece from `from` can reach, found by doubling and then halving.
std::size_t reach(const Quantised& q, std::size_t from, std::size_t last) {
  std::size_t good = from + 1, step = 1;
  while (good < last && q.holds(from, std::min(good + step, last))) {
    good = std::min(good + step, last);
    step *= 2;
  }
  for (; step > 0; step /= 2) {
    if (good + step <= last && q.holds(from, good + step)) good += step;
  }
  return good;
}

std::vector<std::size_t> knots_of(TrackKind kind, const Quantised& q, std::size_t count) {
  std::vector<std::size_t> kept{0};
  while (kept.back() + 1 < count) {
    kept.push_back(kind == TrackKind::kHold ? kept.back() + 1 : reach(q, kept.back(), count - 1));
  }
  return kept;
}

}  // namespace

void put_column(const std::vector<std::int64_t>& numbers, std::string& bytes) {
  std::int64_t before = 0;
  for (const std::int64_t number : numbers) {
    const std::int64_t difference = number - before;
    before = number;
    auto rest = (static_cast<std::uint64_t>(difference) << 1) ^
                static_cast<std::uint64_t>(difference >> 63);
    for (; rest >= 128; rest >>= 7) bytes += static_cast<char>(0x80 | (rest & 0x7f));
    bytes += static_cast<char>(rest);
  }
}

const char* to_string(TrackKind kind) {
  switch (kind) {
    case TrackKind::kLinear:
      return "linear";
    case TrackKind::kHermite:
      return "hermite";
    case TrackKind::kHold:
      return "hold";
  }
  return "";
}

Track pack(TrackKind kind, const Samples& samples, bool floored) {
  const std::size_t count = samples.t.size();
  assert(samples.tolerance.size() == count && std::is_sorted(samples.t.begin(), samples.t.end()));
  assert((kind == TrackKind::kHermite) == !samples.rate.empty());
  Track track;
  track.kind = kind;
  track.floored = floored;
  track.components = samples.value.size();
  if (count == 0) return track;
  const double span = samples.t.back() - samples.t.front();
  track.start = samples.t.front();
  track.tick = span > 0.0 ? span / kTicks : 1.0;
  track.quantum =
      kQuantumShare * *std::min_element(samples.tolerance.begin(), samples.tolerance.end());
  track.rate_quantum = span > 0.0 ? track.quantum / (kRateSpan * span) : 1.0;
  track.quantum = std::max(track.quantum, largest(samples.value) / kMostQuanta);
  track.rate_quantum = std::max(track.rate_quantum, largest(samples.rate) / kMostQuanta);
  const Quantised quantised(kind, samples, track);
  const auto kept = knots_of(kind, quantised, count);
  track.knots = kept.size();
  quantised.write(kept, track.bytes);
  return track;
}

nlohmann::json track_json(const Track& track) {
  return {{"kind", to_string(track.kind)}, {"floored", track.floored},
          {"knots", track.knots},          {"components", track.components},
          {"start", track.start},          {"tick", track.tick},
          {"quantum", track.quantum},      {"rate_quantum", track.rate_quantum},
          {"data", base64(track.bytes)}};
}

}  // namespace rotorub
