#include "compare/report/contact_plots.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/base/units.h"
#include "compare/metrics/distribution.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plot_points.h"
#include "native_model/trajectory/columns.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

using nlohmann::json;

namespace {

// Whether an episode of a soft contact lasts longer than an impact. It is then a rub, and its
// impulse is the sum over the whole rub.
bool is_lasting(const Trajectory& run, const std::string& column, double begin) {
  if (run.is_rigid() || run.contact_model == "compliant" || !run.has(column)) return false;
  const auto &t = run.column("t"), &force = run.column(column);
  auto row = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), begin) - t.begin());
  double last = begin;
  for (; row < t.size() && force[row] > 0.0; ++row) last = t[row];
  return last - begin > kWindowSteps * run.step;
}

}  // namespace

json contact_distribution(const Trajectory& run, std::size_t contact, bool is_compliant) {
  constexpr std::size_t kParts = 60, kMost = 150;
  json force = nullptr, impulse = nullptr;
  const std::string column = column_of_contact(contact, "normal_force");
  if (run.has(column)) {
    const Histogram h = histogram(run.column("t"), run.column(column), kParts);
    if (h.width > 0.0)
      force = {{"width", rounded(h.width)}, {"share", rounded_list(h.share, 100.0, 5)}};
  }
  std::vector<double> all;
  for (const Impact& impact : counted_impacts(run, contact))
    if (impact.normal_impulse > 0.0 && (is_compliant || !is_lasting(run, column, impact.t)))
      all.push_back(impact.normal_impulse);
  if (!all.empty()) {
    const Exceedance curve = exceedance(std::move(all), kMost);
    impulse = {{"value", rounded_list(curve.value, kMilli, 5)}, {"count", curve.count}};
  }
  return {{"force", force}, {"impulse", impulse}};
}

}  // namespace rotorub
