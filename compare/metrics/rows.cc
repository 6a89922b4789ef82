#include "compare/metrics/rows.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "native_model/trajectory/recorder.h"

namespace rotorub {

namespace {

// Calls each(k, row, share, h): time k lies at the fraction `share` between `row` and the next one,
// which is h later.
template <class Each>
void along(std::span<const double> rows, std::span<const double> t, Each each) {
  assert(rows.size() >= 2);
  std::size_t row = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    // The next row is usually nearby.
    if (row + 2 < rows.size() && rows[row + 1] <= t[k]) {
      const auto from = rows.begin() + static_cast<std::ptrdiff_t>(row) + 1;
      const auto next = std::upper_bound(from, rows.end() - 1, t[k]);
      row = static_cast<std::size_t>(next - rows.begin()) - 1;
    }
    const double h = rows[row + 1] - rows[row];
    // Two rows at the same instant are a jump.
    const double share = h > 0.0 ? (t[k] - rows[row]) / h : t[k] < rows[row] ? 0.0 : 1.0;
    each(k, row, std::clamp(share, 0.0, 1.0), h);
  }
}

template <class Value>
std::vector<Value> straight(std::span<const double> rows, std::span<const Value> y,
                            std::span<const double> t) {
  std::vector<Value> out(t.size());
  along(rows, t, [&](std::size_t k, std::size_t row, double s, double) {
    out[k] = s == 1.0 ? y[row + 1] : y[row] + s * (y[row + 1] - y[row]);
  });
  return out;
}

}  // namespace

std::vector<double> linear(std::span<const double> rows, std::span<const double> y,
                           std::span<const double> t) {
  return straight(rows, y, t);
}
std::vector<std::complex<double>> linear(std::span<const double> rows,
                                         std::span<const std::complex<double>> y,
                                         std::span<const double> t) {
  return straight(rows, y, t);
}

std::vector<double> cubic(std::span<const double> rows, std::span<const double> y,
                          std::span<const double> rate, std::span<const double> t) {
  std::vector<double> out(t.size());
  along(rows, t, [&](std::size_t k, std::size_t row, double s, double h) {
    const double r = 1.0 - s;
    out[k] = r * r * ((1.0 + 2.0 * s) * y[row] + s * h * rate[row]) +
             s * s * ((3.0 - 2.0 * s) * y[row + 1] - r * h * rate[row + 1]);
  });
  return out;
}

double mean_speed(const Trajectory& run, const std::string& angle, const std::string& speed,
                  double from) {
  const std::vector<double>& t = run.column("t");
  const double begin = std::clamp(from, t.front(), t[t.size() - 2]);
  const std::vector<double> ends =
      cubic(t, run.column(angle), run.column(speed), std::array{begin, t.back()});
  return (ends[1] - ends[0]) / (t.back() - begin);
}

std::vector<double> even_times(double from, double to, std::size_t count) {
  std::vector<double> t;
  for (std::size_t k = 0; k < count; ++k) {
    t.push_back(from + (to - from) * static_cast<double>(k) / static_cast<double>(count - 1));
  }
  return t;
}

std::vector<double> dense_times(const scene::Run& run, std::size_t rows) {
  const auto steps = static_cast<std::size_t>(scene::step_count(run.end, run.step));
  const std::size_t stride = std::max<std::size_t>(1, (steps + rows - 1) / rows);
  std::vector<double> times = output_times(run);
  for (std::size_t k = 0; k <= steps; k += stride) {
    times.push_back(std::min(run.end, static_cast<double>(k) * run.step));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

Trajectory rows_at(const Trajectory& trajectory, const std::vector<double>& times) {
  const auto& t = trajectory.column("t");
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < t.size(); ++i) {
    if (std::binary_search(times.begin(), times.end(), t[i])) wanted.push_back(i);
  }
  Trajectory out = trajectory;
  for (std::size_t c = 0; c < out.series.size(); ++c) {
    const auto& values = trajectory.series[c].values;
    out.series[c].values.clear();
    for (const std::size_t i : wanted) out.series[c].values.push_back(values[i]);
  }
  return out;
}

}  // namespace rotorub
