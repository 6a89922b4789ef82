#include "compare/study/side_difference.h"

#include <algorithm>
#include <cmath>

namespace rotorub {

Repeatability repeatability(const Metrics& run, const Twins& twins) {
  Repeatability r;
  for (const Figure& f : figures()) {
    double floor = 0.0;
    for (const Metrics& m : twins.metrics) {
      const double apart = std::abs(deviation(f, f.value(run), f.value(m)));
      if (std::isfinite(apart)) floor = std::max(floor, apart);
    }
    r.floor.push_back(floor);
    r.samples.push_back(figure_sample(f, run, twins.metrics));
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

SideDifference side_difference(const Side& native, const Side& other, const Repeatability& natives,
                               const Repeatability& others, const CompareOptions& options,
                               double threshold) {
  SideDifference d;
  d.decides = other.label == to_string(options.contact);
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    d.figures.push_back({judged(f, natives.samples[k], others.samples[k], options.tolerance,
                                natives.replay_floor[k]),
                         natives.floor[k], natives.replay_floor[k],
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
