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
using Eigen::VectorXcd;

constexpr double kMostGrid = 1 << 19;  // largest number of instants, of record and run together

struct Grid {
  double h;                 // s
  Index record, run, size;  // numbers of instants; size: of the transforms
};

Grid grid_of(const MeasuredRecord& record, const SampledRun& run) {
  const double length = run.end() - run.start();
  const double h = std::max(record.interval, (record.duration() + length) / (kMostGrid - 2.0));
  const auto instants = [&](double time) { return static_cast<Index>(time / h + 1e-6) + 1; };
  Grid grid{h, instants(record.duration()), instants(length), 1};
  while (grid.size < grid.record + grid.run) grid.size *= 2;
  return grid;
}

// Puts each sample on the nearest instant of the grid. there: 1, or 0 in a gap.
void lay_on_grid(const MeasuredRecord& record, const Channel& channel, const Grid& grid,
                 ArrayXcd& value, ArrayXcd& there) {
  value = there = ArrayXcd::Zero(grid.size);
  for (Index k = 0; k < channel.value.size(); ++k) {
    const double at = (channel.times.t[static_cast<std::size_t>(k)] - record.t.front()) / grid.h;
    const Index i = std::min<Index>(std::llround(at), grid.record - 1);
    value[i] = channel.value[k];
    there[i] = 1.0;
  }
}

// Sums over the common samples at each lag, over the channels so far.
struct LagSums {
  ArrayXd record, run, both, overlap;
  ArrayXcd turned;  // of pairs with a free angle
  explicit LagSums(Index size)
      : record(ArrayXd::Zero(size)), run(record), both(record), overlap(record), turned(record) {}
};

void add_channel(const MeasuredRecord& record, const SampledRun& run, const Channel& channel,
                 const Grid& grid, std::optional<double> angle, LagSums& sums) {
  Eigen::FFT<double> fourier;
  const auto spectrum = [&](const VectorXcd& z) { return VectorXcd(fourier.fwd(z)); };
  // sum_j conj(a_j) b_{j + l} at index l, from the spectra of a and b; negative l count from the
  // end.
  const auto correlated = [&](const VectorXcd& a, const VectorXcd& b) {
    const VectorXcd product = a.conjugate().cwiseProduct(b);
    return ArrayXcd(VectorXcd(fourier.inv(product)));
  };

  ArrayXcd m, w, s = ArrayXcd::Zero(grid.size), v = s;
  lay_on_grid(record, channel, grid, m, w);
  const double end = run.start() + static_cast<double>(grid.run - 1) * grid.h;
  const auto t = even_times(run.start(), end, static_cast<std::size_t>(grid.run));
  s.head(grid.run) = channel.of(run, sample_times(t, grid.h)).array();
  v.head(grid.run) = 1.0;

  const auto M = spectrum(m), W = spectrum(w), S = spectrum(s), V = spectrum(v);
  const ArrayXd count = correlated(W, V).real(), n = count.max(1.0);
  const ArrayXcd sum_m = correlated(M, V), sum_s = correlated(W, S);  // sum_m: of the conjugates
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

BestLags best_lags(const MeasuredRecord& record, const SampledRun& run,
                   const std::vector<Channel>& channels, std::optional<double> angle) {
  const Grid grid = grid_of(record, run);
  LagSums sums(grid.size);
  for (const Channel& channel : channels) add_channel(record, run, channel, grid, angle, sums);
  const double least =
      std::max(kLeastOverlap * sums.overlap.maxCoeff(), static_cast<double>(kLeastSamples));
  // Where the run does not move, its values are round-off, which correlates with anything.
  constexpr double kStill = 1e-12;
  const double moves = kStill * std::max(sums.run.maxCoeff(), sums.record.maxCoeff());
  std::vector<LagScore> scores;  // by rising shift
  for (Index lag = 1 - grid.record; lag < grid.run; ++lag) {
    const Index l = lag < 0 ? lag + grid.size : lag;
    if (sums.overlap[l] < least || !(sums.record[l] > moves) || !(sums.run[l] > moves)) continue;
    const double correlation =
        (std::abs(sums.turned[l]) + sums.both[l]) / std::sqrt(sums.record[l] * sums.run[l]);
    scores.push_back({run.start() - record.t.front() + static_cast<double>(lag) * grid.h,
                      std::clamp(correlation, -1.0, 1.0), std::sqrt(sums.record[l] / sums.run[l])});
  }
  if (scores.empty()) {
    throw MeasuredError("record and run have too few samples in common, whatever the shift");
  }

  const auto less = [](const LagScore& a, const LagScore& b) {
    return a.likeness() < b.likeness();
  };
  const auto best = std::max_element(scores.begin(), scores.end(), less);
  const auto in_valley = [&](const LagScore& s) {
    return s.likeness() < kValley * best->likeness();
  };
  const auto after = std::find_if(best, scores.end(), in_valley);
  const auto before =
      std::find_if(std::make_reverse_iterator(best), scores.rend(), in_valley).base();
  // A slope at the edge of the valley is not a peak.
  const auto is_peak = [&](auto at) {
    return (at == scores.begin() || !less(*at, *(at - 1))) &&
           (at + 1 == scores.end() || !less(*at, *(at + 1)));
  };
  const auto correlates_less = [](const LagScore& a, const LagScore& b) {
    return a.correlation < b.correlation;
  };
  BestLags found{
      *best, {}, *std::max_element(scores.begin(), scores.end(), correlates_less), grid.h};
  for (auto at = scores.begin(); at != scores.end(); ++at) {
    if (at == before) at = after;
    if (at == scores.end()) break;
    if (is_peak(at) && (!found.next || less(*found.next, *at))) found.next = *at;
  }
  return found;
}

}  // namespace rotorub
