#include "compare/measured/lag_search.h"

#include <algorithm>
#include <cmath>

#include "compare/metrics/fourier.h"
#include "compare/metrics/rows.h"

namespace rotorub {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::Index;

constexpr double kMostGrid = 1 << 19;  // instants of record and run together

struct Grid {
  double h;                 // s
  Index record, run, size;  // instants; size: of the transforms
};

Grid grid_of(const MeasuredRecord& record, const SampledRun& run) {
  const double length = run.end() - run.start();
  const double h = std::max(record.interval, (record.duration() + length) / (kMostGrid - 2.0));
  const auto instants = [&](double time) { return static_cast<Index>(time / h + 1e-6) + 1; };
  Grid grid{h, instants(record.duration()), instants(length), 1};
  while (grid.size < grid.record + grid.run) grid.size *= 2;
  return grid;
}

// The record on the grid, linear between neighbours, and whether it is there: 1, or 0 in a hole,
// where neighbours are far apart.
void lay_on_grid(const MeasuredRecord& record, const Channel& channel, const Grid& grid,
                 ArrayXcd& value, ArrayXcd& there) {
  value = there = ArrayXcd::Zero(grid.size);
  if (channel.good.size() < 2) return;
  std::vector<double> t, x, y;
  for (std::size_t k = 0; k < channel.good.size(); ++k) {
    t.push_back((record.t[channel.good[k]] - record.t.front()) / grid.h);
    x.push_back(channel.value[static_cast<Index>(k)].real());
    y.push_back(channel.value[static_cast<Index>(k)].imag());
  }
  const auto last = static_cast<double>(grid.record - 1);
  const auto at = even_times(0.0, last, static_cast<std::size_t>(grid.record));
  const auto real = linear(t, x, at), imag = linear(t, y, at);
  const double far = 2.5 * std::max(record.interval / grid.h, 1.0);
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    if (t[k + 1] - t[k] > far) continue;
    for (double j = std::ceil(t[k] - 1e-6); j <= std::min(t[k + 1] + 1e-6, last); j += 1.0) {
      const auto i = static_cast<std::size_t>(j);
      value[static_cast<Index>(i)] = {real[i], imag[i]};
      there[static_cast<Index>(i)] = 1.0;
    }
  }
}

// Sums over the samples in common at each lag, of one channel or of several.
struct LagSums {
  ArrayXd record, run, both, overlap;
  ArrayXcd turned;  // of pairs whose angle is free
  explicit LagSums(Index size)
      : record(ArrayXd::Zero(size)), run(record), both(record), overlap(record), turned(record) {}
};

void add_channel(const MeasuredRecord& record, const SampledRun& run, const Channel& channel,
                 const Grid& grid, std::optional<double> angle, LagSums& sums) {
  Eigen::FFT<double> fourier;
  const auto spectrum = [&](const ArrayXcd& z) {
    const Eigen::VectorXcd in = z.matrix();
    Eigen::VectorXcd out;
    fourier.fwd(out, in);
    return out;
  };
  // sum_j conj(a_j) b_{j + l} at l, negative l from the end; of spectra.
  const auto correlated = [&](const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
    const Eigen::VectorXcd product = a.conjugate().cwiseProduct(b);
    Eigen::VectorXcd out;
    fourier.inv(out, product);
    return ArrayXcd(out);
  };

  ArrayXcd m, w, s = ArrayXcd::Zero(grid.size), v = s;
  lay_on_grid(record, channel, grid, m, w);
  const double end = run.start() + static_cast<double>(grid.run - 1) * grid.h;
  const auto t = even_times(run.start(), end, static_cast<std::size_t>(grid.run));
  s.head(grid.run) = channel.of(run, sample_times(t, grid.h)).array();
  v.head(grid.run) = 1.0;

  const auto M = spectrum(m), W = spectrum(w), S = spectrum(s), V = spectrum(v);
  const ArrayXd count = correlated(W, V).real(), n = count.max(1.0);
  const ArrayXcd sum_m = correlated(M, V), sum_s = correlated(W, S);  // sum_m: of conjugates
  sums.overlap = sums.overlap.max(count);
  sums.record += (correlated(spectrum(m.abs2()), V).real() - sum_m.abs2() / n).max(0.0);
  sums.run += (correlated(W, spectrum(s.abs2())).real() - sum_s.abs2() / n).max(0.0);
  const ArrayXcd both = correlated(M, S) - sum_m * sum_s / n;
  if (channel.pair && !angle) {
    sums.turned += both;
  } else {
    sums.both += (both * std::polar(1.0, channel.pair ? -*angle : 0.0)).real();
  }
}

}  // namespace

std::vector<LagScore> lag_scores(const MeasuredRecord& record, const SampledRun& run,
                                 std::span<const Channel> channels, std::optional<double> angle) {
  const Grid grid = grid_of(record, run);
  LagSums sums(grid.size);
  for (const Channel& channel : channels) add_channel(record, run, channel, grid, angle, sums);
  const double least =
      std::max(kLeastOverlap * sums.overlap.maxCoeff(), static_cast<double>(kLeastSamples));
  std::vector<LagScore> scores;
  for (Index lag = 1 - grid.record; lag < grid.run; ++lag) {
    const Index l = lag < 0 ? lag + grid.size : lag;
    const double size = std::sqrt(sums.record[l] * sums.run[l]);
    if (sums.overlap[l] < least || !(size > 0.0)) continue;
    const double correlation = (std::abs(sums.turned[l]) + sums.both[l]) / size;
    scores.push_back({run.start() - record.t.front() + static_cast<double>(lag) * grid.h,
                      std::clamp(correlation, -1.0, 1.0)});
  }
  return scores;
}

BestLags best_lags(std::span<const LagScore> scores) {
  const auto less = [](const LagScore& a, const LagScore& b) {
    return a.correlation < b.correlation;
  };
  const auto best = std::max_element(scores.begin(), scores.end(), less);
  const auto in_valley = [&](const LagScore& s) {
    return s.correlation < kValley * best->correlation;
  };
  const auto after = std::find_if(best, scores.end(), in_valley);
  const auto before =
      std::find_if(std::make_reverse_iterator(best), scores.rend(), in_valley).base();
  // A slope up to the valley's edge is no peak.
  const auto is_peak = [&](auto at) {
    return (at == scores.begin() || !less(*at, *(at - 1))) &&
           (at + 1 == scores.end() || !less(*at, *(at + 1)));
  };
  BestLags found{*best, {}};
  for (auto at = scores.begin(); at != scores.end(); ++at) {
    if (at == before) at = after;
    if (at == scores.end()) break;
    if (is_peak(at) && (!found.next || less(*found.next, *at))) found.next = *at;
  }
  return found;
}

}  // namespace rotorub
