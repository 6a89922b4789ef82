#include "plugin/own/tree_factor.h"

#include <algorithm>

#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

DofRange tree_of(const mjModel* m, int body) {
  const int root = m->body_rootid[body];
  DofRange range;
  if (root == 0) return range;
  bool any = false;
  for (int b = root; b < m->nbody && m->body_rootid[b] == root; ++b) {
    if (m->body_dofnum[b] == 0) continue;
    if (!any) range.first = m->body_dofadr[b];
    any = true;
    range.last = m->body_dofadr[b] + m->body_dofnum[b];
  }
  return range;
}

void factor_tree(const mjModel* m, const mjtNum* mass, double damped_step, DofRange range,
                 mjtNum* factor, mjtNum* inverse) {
  for (int i = range.first; i < range.last; ++i) {
    const MassRow row = mass_row(m, i);
    const int first = row.step > 0 ? row.diagonal : row.diagonal - row.ancestors;
    std::copy_n(mass + first, row.ancestors + 1, factor + first);
    factor[row.diagonal] += damped_step * m->dof_damping[i];
  }
  // From the tips to the root: each row is taken from those of its ancestors.
  for (int k = range.last - 1; k >= range.first; --k) {
    const MassRow row = mass_row(m, k);
    mjtNum* diagonal = factor + row.diagonal;
    inverse[k] = 1.0 / *diagonal;
    mjtNum* of_row = diagonal + row.step;
    int i = m->dof_parentid[k];
    for (int left = row.ancestors; left > 0; --left, of_row += row.step, i = m->dof_parentid[i]) {
      const mjtNum share = *of_row / *diagonal;
      mjtNum* to = factor + mass_row(m, i).diagonal;
      for (int j = 0; j < left; ++j) to[j * row.step] -= of_row[j * row.step] * share;
      *of_row = share;
    }
  }
}

void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x) {
  for (int i = range.last - 1; i >= range.first; --i) {
    if (x[i] == 0.0) continue;
    const MassRow row = mass_row(m, i);
    const mjtNum* entry = factor + row.diagonal;
    for (int j = m->dof_parentid[i], left = row.ancestors; left > 0; --left) {
      entry += row.step;
      x[j] -= *entry * x[i];
      j = m->dof_parentid[j];
    }
  }
  for (int i = range.first; i < range.last; ++i) x[i] *= inverse[i];
  for (int i = range.first; i < range.last; ++i) {
    const MassRow row = mass_row(m, i);
    const mjtNum* entry = factor + row.diagonal;
    for (int j = m->dof_parentid[i], left = row.ancestors; left > 0; --left) {
      entry += row.step;
      x[i] -= *entry * x[j];
      j = m->dof_parentid[j];
    }
  }
}

}  // namespace rotorub::plugin
