#include "plugin/velocity_history.h"

#include <algorithm>
#include <cmath>

#include "plugin/user_data.h"

namespace rotorub::plugin {

void velocity_at_time(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                      double* now) {
  const int n = config.model.nq();
  const double* v = state.v();
  double* data = d->userdata;
  double* earlier = data + kUserDataSingle;
  double* latest = earlier + n;
  if (data[kHistoryLength] == 0.0 || d->time < data[kLatestTime]) {
    data[kHistoryLength] = 1.0;
  } else if (d->time > data[kLatestTime]) {
    std::copy_n(latest, n, earlier);
    data[kEarlierTime] = data[kLatestTime];
    // kImpact is still that of the step before; a second pass at this time finds it changed.
    data[kHistoryLength] = data[kImpact] == 0.0 ? 2.0 : 3.0;
  }
  std::copy_n(v, n, latest);
  data[kLatestTime] = d->time;

  const double h = m->opt.timestep;
  // An impact of the step before is over: half a step of it is not to come.
  const bool smooth = data[kHistoryLength] == 2.0 && m->opt.integrator != mjINT_RK4;
  const bool stepped = std::abs(data[kLatestTime] - data[kEarlierTime] - h) < 1e-6 * h;
  const double share = stepped && smooth ? 0.5 : 0.0;
  for (int i = 0; i < n; ++i) now[i] = v[i] + share * (v[i] - earlier[i]);
}

}  // namespace rotorub::plugin
