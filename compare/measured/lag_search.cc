#include "compare/measured/lag_search.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rotorub {
namespace {

using Complex = std::complex<double>;
using Signal = std::vector<Complex>;

constexpr std::size_t kMostGrid = std::size_t{1} << 19;  // instants of record and run together

// Transforms of one length. FFTW_ESTIMATE: the plan does not hang on what a measurement gave.
class FourierPair {
 public:
  explicit FourierPair(std::size_t size)
      : size_(size),
        values_(fftw_alloc_complex(size)),
        forward_(fftw_plan_dft_1d(static_cast<int>(size), values_, values_, FFTW_FORWARD, FFTW_ESTIMATE)),
        back_(fftw_plan_dft_1d(static_cast<int>(size), values_, values_, FFTW_BACKWARD, FFTW_ESTIMATE)) {}
  ~FourierPair() {
    fftw_destroy_plan(forward_);
    fftw_destroy_plan(back_);
    fftw_free(values_);
  }
  FourierPair(const FourierPair&) = delete;
  FourierPair& operator=(const FourierPair&) = delete;

  Signal spectrum(const Signal& z) { return through(z, forward_, 1.0); }
  // sum_j conj(a_j) b_{j + l} at l, negative l from the end; of spectra.
  Signal correlation(const Signal& a, const Signal& b) {
    Signal product(size_);
    for (std::size_t k = 0; k < size_; ++k) product[k] = std::conj(a[k]) * b[k];
    return through(product, back_, 1.0 / static_cast<double>(size_));
  }

 private:
  // Padded with zeros to the length.
  Signal through(const Signal& z, fftw_plan plan, double factor) {
    for (std::size_t k = 0; k < size_; ++k) {
      const Complex value = k < z.size() ? z[k] : 0.0;
      values_[k][0] = value.real();
      values_[k][1] = value.imag();
    }
    fftw_execute(plan);
    Signal out(size_);
    for (std::size_t k = 0; k < size_; ++k) out[k] = factor * Complex(values_[k][0], values_[k][1]);
    return out;
  }

  std::size_t size_;
  fftw_complex* values_;
  fftw_plan forward_, back_;
};

struct Grid {
  double h;                       // s
  std::size_t record, run, size;  // instants; size: of the transforms
};

Grid grid_of(const MeasuredRecord& record, const SampledRun& run) {
  const double length = run.end() - run.start();
  const double h = std::max(record.interval, (record.duration() + length) / static_cast<double>(kMostGrid - 2));
  Grid grid{h, static_cast<std::size_t>(record.duration() / h + 1e-6) + 1,
            static_cast<std::size_t>(length / h + 1e-6) + 1, 1};
  while (grid.size < grid.record + grid.run) grid.size *= 2;
  return grid;
}

// On the grid, linear between neighbours; weight 0 in a hole: where they are no good, or far apart.
void lay_on_grid(const MeasuredRecord& record, const Channel& channel, const Grid& grid, Signal& value,
                 Signal& weight) {
  value.assign(grid.record, 0.0);
  weight.assign(grid.record, 0.0);
  std::vector<std::size_t> good;
  for (std::size_t i = 0; i < record.t.size(); ++i) {
    if (is_good(channel, i)) good.push_back(i);
  }
  const double far = 2.5 * std::max(record.interval, grid.h);
  std::size_t k = 0;
  for (std::size_t j = 0; j < grid.record && good.size() > 1; ++j) {
    const double at = record.t.front() + static_cast<double>(j) * grid.h;
    while (k + 2 < good.size() && record.t[good[k + 1]] <= at) ++k;
    const double a = record.t[good[k]], b = record.t[good[k + 1]], share = (at - a) / (b - a);
    if (share < -1e-6 || share > 1.0 + 1e-6 || b - a > far) continue;
    const Complex from = record_value(channel, good[k]), to = record_value(channel, good[k + 1]);
    value[j] = from + share * (to - from);
    weight[j] = 1.0;
  }
}

Signal squares(const Signal& z) {
  Signal out;
  for (const Complex& value : z) out.emplace_back(std::norm(value));
  return out;
}

// Sums over the samples in common at each lag, of one channel or of several.
struct LagSums {
  std::vector<double> record, run, both_real, overlap;
  Signal both;  // of pairs
};

void add_channel(const MeasuredRecord& record, const SampledRun& run, const Channel& channel, const Grid& grid,
                 std::optional<double> angle, FourierPair& fourier, LagSums& sums) {
  Signal m, w;
  lay_on_grid(record, channel, grid, m, w);
  std::vector<double> t;
  for (std::size_t k = 0; k < grid.run; ++k) t.push_back(run.start() + static_cast<double>(k) * grid.h);
  const Signal s = run_values(channel, run, sample_times(t, grid.h));
  const auto w_ = fourier.spectrum(w), m_ = fourier.spectrum(m), mm_ = fourier.spectrum(squares(m));
  const auto v_ = fourier.spectrum(Signal(grid.run, 1.0)), s_ = fourier.spectrum(s), ss_ = fourier.spectrum(squares(s));
  const auto count = fourier.correlation(w_, v_), sum_m = fourier.correlation(m_, v_),
             sum_s = fourier.correlation(w_, s_);
  const auto sum_mm = fourier.correlation(mm_, v_), sum_ss = fourier.correlation(w_, ss_),
             sum_ms = fourier.correlation(m_, s_);
  const double weight = 1.0 / (channel.scale * channel.scale);
  const Complex turn = std::polar(1.0, -angle.value_or(0.0));
  for (std::size_t l = 0; l < grid.size; ++l) {
    const double n = std::max(count[l].real(), 1.0);
    sums.overlap[l] = std::max(sums.overlap[l], count[l].real());
    sums.record[l] += weight * std::max(0.0, sum_mm[l].real() - std::norm(sum_m[l]) / n);
    sums.run[l] += weight * std::max(0.0, sum_ss[l].real() - std::norm(sum_s[l]) / n);
    // sum_m holds the conjugate of the record's sum.
    const Complex both = weight * (sum_ms[l] - sum_m[l] * sum_s[l] / n);
    if (channel.is_pair() && !angle) {
      sums.both[l] += both;
    } else {
      sums.both_real[l] += (channel.is_pair() ? turn * both : both).real();
    }
  }
}

}  // namespace

std::vector<LagScore> lag_scores(const MeasuredRecord& record, const SampledRun& run, std::span<const Channel> channels,
                                 std::optional<double> angle) {
  const Grid grid = grid_of(record, run);
  FourierPair fourier(grid.size);
  LagSums sums;
  for (auto* all : {&sums.record, &sums.run, &sums.both_real, &sums.overlap}) all->assign(grid.size, 0.0);
  sums.both.assign(grid.size, 0.0);
  for (const Channel& channel : channels) add_channel(record, run, channel, grid, angle, fourier, sums);

  const double most = *std::max_element(sums.overlap.begin(), sums.overlap.end());
  std::vector<LagScore> scores;
  const auto first = -static_cast<std::ptrdiff_t>(grid.record) + 1;
  for (std::ptrdiff_t lag = first; lag < static_cast<std::ptrdiff_t>(grid.run); ++lag) {
    const auto l = static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::ptrdiff_t>(grid.size) : lag);
    const double size = std::sqrt(sums.record[l] * sums.run[l]);
    if (sums.overlap[l] < std::max(kLeastOverlap * most, static_cast<double>(kLeastSamples)) || !(size > 0.0)) continue;
    const double correlation = (std::abs(sums.both[l]) + sums.both_real[l]) / size;
    scores.push_back(
        {run.start() - record.t.front() + static_cast<double>(lag) * grid.h, std::clamp(correlation, -1.0, 1.0)});
  }
  return scores;
}

BestLags best_lags(std::span<const LagScore> scores) {
  const auto less = [](const LagScore& a, const LagScore& b) { return a.correlation < b.correlation; };
  const auto best = std::max_element(scores.begin(), scores.end(), less);
  const auto in_valley = [&](const LagScore& s) { return s.correlation < kValley * best->correlation; };
  const auto after = std::find_if(best, scores.end(), in_valley);
  const auto before = std::find_if(std::make_reverse_iterator(best), scores.rend(), in_valley).base();
  BestLags found{static_cast<std::size_t>(best - scores.begin()), {}};
  // A slope up to the valley's edge is no peak.
  const auto is_peak = [&](auto at) {
    return (at == scores.begin() || !less(*at, *(at - 1))) && (at + 1 == scores.end() || !less(*at, *(at + 1)));
  };
  for (const auto& [from, to] : {std::pair{scores.begin(), before}, std::pair{after, scores.end()}}) {
    for (auto at = from; at != to; ++at) {
      if (!is_peak(at)) continue;
      const auto next = static_cast<std::size_t>(at - scores.begin());
      if (!found.next || less(scores[*found.next], scores[next])) found.next = next;
    }
  }
  return found;
}

}  // namespace rotorub
