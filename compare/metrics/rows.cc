#include "compare/metrics/rows.h"

#include <algorithm>
#include <cmath>

#include "native_model/trajectory/recorder.h"

namespace rotorub {

std::vector<double> dense_times(const scene::Run& run, std::size_t rows) {
  const auto steps = static_cast<std::size_t>(std::ceil(run.end / run.step - 1e-9));
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
