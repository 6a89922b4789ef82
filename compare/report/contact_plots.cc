#include "compare/report/contact_plots.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/units.h"
#include "compare/metrics/distribution.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plot_points.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

using nlohmann::json;

json contact_distribution(const Trajectory& run, std::size_t contact) {
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
    if (impact.normal_impulse > 0.0) all.push_back(impact.normal_impulse);
  if (!all.empty()) {
    const Exceedance curve = exceedance(std::move(all), kMost);
    impulse = {{"value", rounded_list(curve.value, kMilli, 5)}, {"count", curve.count}};
  }
  return {{"force", force}, {"impulse", impulse}};
}

}  // namespace rotorub
