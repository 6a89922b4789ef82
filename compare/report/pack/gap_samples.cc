#include "compare/report/pack/gap_samples.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

void put(Samples& samples, double t, double gap, double rate) {
  samples.t.push_back(t);
  samples.value[0].push_back(gap);
  samples.rate[0].push_back(rate);
}

}  // namespace

std::vector<Impact> counted_impacts(const Trajectory& run, std::size_t contact) {
  std::vector<Impact> impacts;
  std::copy_if(
      run.impacts.begin(), run.impacts.end(), std::back_inserter(impacts),
      [&](const Impact& i) { return counts(i) && i.contact == static_cast<int>(contact); });
  std::stable_sort(impacts.begin(), impacts.end(),
                   [](const Impact& a, const Impact& b) { return a.t < b.t; });
  return impacts;
}

Samples gap_samples(const Trajectory& run, std::size_t contact, double least, double share) {
  const auto& t = run.column("t");
  const auto& gap = run.column(column_of_contact(contact, "gap"));
  const auto& rate = run.column(column_of_contact(contact, "gap_rate"));
  Samples samples;
  samples.value.resize(1);
  samples.rate.resize(1);
  std::vector<Impact> impacts;
  if (run.contact_model == "rigid") impacts = counted_impacts(run, contact);
  std::size_t next = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    // At an impact a row holds the state after it: the impact stands before the row.
    for (; next < impacts.size() && impacts[next].t <= t[i]; ++next) {
      const Impact& impact = impacts[next];
      if (impact.t < t.front()) continue;
      put(samples, impact.t, 0.0, impact.gap_rate_before);
      put(samples, impact.t, 0.0, impact.gap_rate_after);
    }
    put(samples, t[i], gap[i], rate[i]);
  }
  for (const double g : samples.value[0])
    samples.tolerance.push_back(std::max(least, share * std::abs(g)));
  return samples;
}

}  // namespace rotorub
