#include "plugin/differences.h"

#include <memory>
#include <stdexcept>

#include "plugin/model/differentiating.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// Writes the values to column `which` of a matrix with `columns` columns.
void put_column(const std::vector<double>& values, std::vector<double>& matrix, int which,
                int columns) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    matrix[i * static_cast<std::size_t>(columns) + static_cast<std::size_t>(which)] = values[i];
  }
}

// One column of both matrices: nudge(copy of d, +-eps), a step, and the difference over 2 eps.
template <typename Nudge>
void column(const mjModel* m, const mjData* d, double eps, int which, Nudge nudge, mjData* low,
            mjData* high, std::vector<double>& next, std::vector<double>& outputs, int columns) {
  for (mjData* side : {low, high}) {
    mj_copyData(side, m, d);
    nudge(side, side == low ? -eps : eps);
    mj_step(m, side);
  }
  std::vector<double> change(static_cast<std::size_t>(2 * count(m->nv) + count(m->na)));
  mj_differentiatePos(m, change.data(), 2.0 * eps, low->qpos, high->qpos);
  for (int i = 0; i < m->nv; ++i) {
    change[static_cast<std::size_t>(m->nv + i)] = (high->qvel[i] - low->qvel[i]) / (2.0 * eps);
  }
  for (int i = 0; i < m->na; ++i) {
    change[static_cast<std::size_t>(2 * m->nv + i)] = (high->act[i] - low->act[i]) / (2.0 * eps);
  }
  put_column(change, next, which, columns);
  std::vector<double> sensed(low->sensordata, low->sensordata + m->nsensordata);
  for (int i = 0; i < m->nsensordata; ++i) {
    double& value = sensed[static_cast<std::size_t>(i)];
    value = (high->sensordata[i] - value) / (2.0 * eps);
  }
  put_column(sensed, outputs, which, columns);
}

}  // namespace

Transition transition(const mjModel* m, const mjData* d, double eps) {
  if (!(eps > 0.0)) throw std::invalid_argument("rotorub: transition: eps must be above 0");
  const std::unique_ptr<mjData, void (*)(mjData*)> low(mj_makeData(m), mj_deleteData),
      high(mj_makeData(m), mj_deleteData);
  const Differentiating scope(low.get(), high.get());
  Transition out;
  const int nv = count(m->nv), n = out.states = 2 * nv + count(m->na);
  out.controls = count(m->nu);
  out.sensors = count(m->nsensordata);
  out.A.resize(static_cast<std::size_t>(n * n));
  out.B.resize(static_cast<std::size_t>(n * m->nu));
  out.C.resize(static_cast<std::size_t>(out.sensors * n));
  out.D.resize(static_cast<std::size_t>(out.sensors * m->nu));
  std::vector<double> along(static_cast<std::size_t>(nv));
  for (int j = 0; j < n; ++j) {
    const auto nudge = [&](mjData* side, double by) {
      if (j >= 2 * nv) {
        side->act[j - 2 * nv] += by;
      } else if (j >= nv) {
        side->qvel[j - nv] += by;
      } else {
        along.assign(static_cast<std::size_t>(nv), 0.0);
        along[static_cast<std::size_t>(j)] = 1.0;
        mj_integratePos(m, side->qpos, along.data(), by);
      }
    };
    column(m, d, eps, j, nudge, low.get(), high.get(), out.A, out.C, n);
  }
  for (int j = 0; j < m->nu; ++j) {
    const auto nudge = [j](mjData* side, double by) { side->ctrl[j] += by; };
    column(m, d, eps, j, nudge, low.get(), high.get(), out.B, out.D, out.controls);
  }
  return out;
}

}  // namespace rotorub::plugin
