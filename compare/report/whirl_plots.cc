#include "compare/report/whirl_plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/base/plot_points.h"
#include "compare/base/units.h"
#include "compare/metrics/cascade.h"
#include "compare/metrics/orbit.h"
#include "compare/metrics/orders.h"

namespace rotorub {
namespace {

using nlohmann::json;
using Values = std::vector<double>;

constexpr std::size_t kMostSamples = 1 << 14;
constexpr std::size_t kMostFrequencies = 1 << 17;
constexpr std::size_t kSpectrumBuckets = 400;  // twice as many points, which preserve the peaks
constexpr std::size_t kColumns = 240;          // frequencies of a waterfall

double start_of_the_settled(const Trajectory& run) {
  const Values& t = run.column("t");
  return t.front() + 0.5 * (t.back() - t.front());
}

// As many samples as the run has rows between these times.
std::size_t samples_between(const Trajectory& run, double from, double to) {
  const Values& t = run.column("t");
  const auto rows =
      std::upper_bound(t.begin(), t.end(), to) - std::lower_bound(t.begin(), t.end(), from);
  return std::min(static_cast<std::size_t>(rows), kMostSamples);
}

// The spectrum of the second half of the run.
json spectrum_json(const Trajectory& run, double limit) {
  const double from = start_of_the_settled(run), to = run.column("t").back();
  const std::size_t count = samples_between(run, from, to);
  if (2 * count < kLeastSpectrumRows) return nullptr;
  const double h = (to - from) / static_cast<double>(count - 1);
  return spectrum_data(even_orbit(run, from, to, count), h, limit);
}

// With the largest amplitude among the frequencies of each column.
json waterfall_json(const Trajectory& run, double limit, double longest_turn) {
  const double from = run.column("t").front(), to = run.column("t").back();
  const std::size_t count = samples_between(run, from, to);
  if (count < kLeastSpectrumRows) return nullptr;
  const double h = (to - from) / static_cast<double>(count - 1);
  // Eight turns resolve an eighth of the spin frequency; in a short run a stretch is a quarter of
  // it.
  const auto wanted = static_cast<std::size_t>(8.0 * longest_turn / h);
  const std::size_t stretch = std::clamp<std::size_t>(wanted, 16, count / 4);
  const Waterfall w = waterfall(even_orbit(run, from, to, count), h, stretch);
  // A column is one frequency, or several adjacent ones if there are more than kColumns.
  const auto middle = static_cast<std::size_t>(stretch / 2);
  const double apart = w.frequency[middle + 1];
  const std::size_t side = std::min(static_cast<std::size_t>(limit / apart), (stretch - 1) / 2);
  const std::size_t bins = 2 * side + 1, each = (bins + kColumns - 1) / kColumns;
  const std::size_t columns = (bins + each - 1) / each;
  const double lowest = w.frequency[middle - side] - 0.5 * apart;
  Values cell(w.time.size() * columns, 0.0);
  for (std::size_t row = 0; row < w.time.size(); ++row) {
    for (std::size_t k = 0; k < bins; ++k) {
      double& largest = cell[row * columns + k / each];
      largest = std::max(largest, w.amplitude[row * stretch + middle - side + k]);
    }
  }
  json all = levels_data(cell);
  if (all.is_null()) return nullptr;
  all["t"] = {from + w.time.front(), from + w.time.back()};
  all["f"] = {lowest, lowest + apart * static_cast<double>(columns * each)};
  all["rows"] = w.time.size();
  all["columns"] = columns;
  return all;
}

json poincare_json(const Trajectory& run) {
  constexpr std::size_t kMost = 1500;
  const auto points = poincare_points(run, start_of_the_settled(run));
  if (points.empty()) return nullptr;
  Values x, y;
  const std::size_t every = (points.size() + kMost - 1) / kMost;
  for (std::size_t i = 0; i < points.size(); i += every) {
    x.push_back(points[i].real());
    y.push_back(points[i].imag());
  }
  return {{"x", x}, {"y", y}};
}

// |rotor - first's rotor| at the times that both have.
json residual_json(const Trajectory& run, const Trajectory& first) {
  const Values &t = run.column("t"), &other = first.column("t");
  Values times, distance;
  for (std::size_t i = 0, j = 0; i < t.size() && j < other.size();) {
    if (t[i] < other[j]) {
      ++i;
    } else if (t[i] > other[j]) {
      ++j;
    } else {
      times.push_back(t[i]);
      distance.push_back(std::hypot(run.column("rotor_x")[i] - first.column("rotor_x")[j],
                                    run.column("rotor_y")[i] - first.column("rotor_y")[j]));
      ++i, ++j;
    }
  }
  if (times.size() < 2) return nullptr;
  return series(times, distance);
}

// 1x and 2x (metrics/orders.h) of a run-up.
json orders_data(const Trajectory& run) {
  constexpr std::size_t kMost = 300;
  if (!changes_speed(run)) return nullptr;
  const OrderTrack track = order_track(run, kMost);
  if (track.t.size() < 2) return nullptr;
  json orders = json::array();
  for (std::size_t k = 0; k < OrderTrack::kOrders; ++k) {
    orders.push_back(list_of(track.probe, [&](const auto& vectors) -> json {
      return {vectors[k].real(), vectors[k].imag()};
    }));
  }
  return {{"t", track.t}, {"speed", track.speed}, {"orders", orders}};
}

// The full spectra (metrics/cascade.h) of a run-up.
json cascade_data(const Trajectory& run) {
  constexpr std::size_t kSpeeds = 36, kFrequencies = 241;
  constexpr double kOrders = 3.2;  // up to this multiple of the fastest spin
  if (!changes_speed(run)) return nullptr;
  double fastest = 0.0;
  for (const double speed : run.column("spin_speed")) fastest = std::max(fastest, std::abs(speed));
  const double highest = kOrders * fastest * kHz;
  const Cascade found = cascade(run, kSpeeds, kFrequencies, highest);
  if (found.t.size() < 2) return nullptr;
  json all = levels_data(found.amplitude);
  if (all.is_null()) return nullptr;
  all["t"] = found.t;
  all["speed"] = found.speed;
  all["f"] = {-highest, highest};
  all["columns"] = found.frequency.size();
  return all;
}

// s: duration of a turn of the spin; for a rotor that hardly turns, a twentieth of the run.
double turn_of(const Trajectory& run) {
  const double span = run.column("t").back() - run.column("t").front(),
               spin = std::abs(mean_spin(run));
  return spin * span > 1.0 ? 1.0 / spin : 0.05 * span;
}

}  // namespace

bool changes_speed(const Trajectory& run) {
  constexpr double kChange = 0.1;
  if (run.rows() < 2) return false;
  const std::vector<double>& speed = run.column("spin_speed");
  const auto [low, high] = std::minmax_element(speed.begin(), speed.end());
  return *high - *low >= kChange * std::max(std::abs(*low), std::abs(*high)) && *high > *low;
}

double mean_spin(const Trajectory& run) {
  if (run.rows() < 2) return 0.0;
  const Values &t = run.column("t"), &angle = run.column("spin_angle");
  return (angle.back() - angle.front()) / (2.0 * std::numbers::pi * (t.back() - t.front()));
}

double spectrum_reach(const Trajectory& run) {
  return run.rows() < 2 ? 1.0 : std::max(1.0, 8.0 / turn_of(run));
}

json spectrum_data(const std::vector<std::complex<double>>& z, double h, double limit) {
  const std::size_t finer = std::clamp<std::size_t>(kMostFrequencies / z.size(), 1, 32);
  const FullSpectrum s = full_spectrum(z, h, finer);
  const auto first = std::lower_bound(s.frequency.begin(), s.frequency.end(), -limit);
  const auto last = std::upper_bound(first, s.frequency.end(), limit);
  const auto from = first - s.frequency.begin(), to = last - s.frequency.begin();
  return series({first, last}, {s.amplitude.begin() + from, s.amplitude.begin() + to},
                kSpectrumBuckets);
}

json whirl_data(const Trajectory& run, const Trajectory* first, double limit) {
  const bool any = run.rows() >= 2;
  return {{"spectrum", any ? spectrum_json(run, limit) : json()},
          {"waterfall", any ? waterfall_json(run, limit, turn_of(run)) : json()},
          {"poincare", any ? poincare_json(run) : json()},
          {"residual", any && first ? residual_json(run, *first) : json()},
          {"orders", any ? orders_data(run) : json()},
          {"cascade", any ? cascade_data(run) : json()}};
}

}  // namespace rotorub
