#include "compare/study/side_difference.h"

#include <algorithm>
#include <cmath>

namespace rotorub {

Repeatability repeatability(const Side& native, const Twins& twins) {
  Repeatability r;
  for (const Figure& f : figures()) {
    std::vector<double> values{f.value(native.metrics)};
    double floor = 0.0;
    for (const Metrics& m : twins.metrics) {
      values.push_back(f.value(m));
      const double apart = std::abs(deviation(f, values.front(), values.back()));
      if (std::isfinite(apart)) floor = std::max(floor, apart);
    }
    r.floor.push_back(floor);
    r.spread.push_back(spread(f, values));
    r.replay_floor.push_back(0.0);
  }
  return r;
}

Divergence first_to_part(const Twins& twins, Divergence none) {
  Divergence first = none;
  for (const Divergence& d : twins.divergences) {
    if (d.time && (!first.time || *d.time < *first.time)) first = d;
    if (!first.time && d.max_distance >= first.max_distance) first = d;
  }
  return first;
}

SideDifference side_difference(const Side& native, const Side& other, const Repeatability& twins,
                               const CompareOptions& options, double threshold) {
  SideDifference d;
  d.decides = other.label == to_string(options.contact);
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    d.figures.push_back({judged(f, f.value(native.metrics), f.value(other.metrics), twins.spread[k],
                                options.tolerance),
                         twins.floor[k], twins.replay_floor[k],
                         split(native.limits[k], other.limits[k])});
  }
  const bool ended_well =
      native.trajectory.status == Status::kOk && other.trajectory.status == Status::kOk;
  d.trust = ended_well ? trust(d.judged()) : Trust::kNo;
  d.divergence = divergence(native.trajectory, other.trajectory, threshold);
  d.impacts = pair_impacts(native.trajectory, other.trajectory, options.impacts);
  return d;
}

}  // namespace rotorub
