#include "plugin/own/tree_factor.h"

#include <algorithm>

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
  const auto row = [m](int i) { return m->dof_Madr[i]; };
  if (range.first == range.last) return;
  const int end = range.last < m->nv ? row(range.last) : m->nM;
  std::copy(mass + row(range.first), mass + end, factor + row(range.first));
  for (int i = range.first; i < range.last; ++i) {
    factor[row(i)] += damped_step * m->dof_damping[i];
  }
  // From the tips to the root: each row is taken from those of its ancestors.
  for (int k = range.last - 1; k >= range.first; --k) {
    mjtNum* entry = factor + row(k);
    inverse[k] = 1.0 / entry[0];
    int depth = 0;
    for (int i = m->dof_parentid[k]; i >= 0; i = m->dof_parentid[i]) ++depth;
    mjtNum* of_row = entry + 1;
    for (int i = m->dof_parentid[k]; i >= 0; i = m->dof_parentid[i], ++of_row, --depth) {
      const mjtNum share = *of_row / entry[0];
      mjtNum* to = factor + row(i);
      for (int j = 0; j < depth; ++j) to[j] -= of_row[j] * share;
      *of_row = share;
    }
  }
}

void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x) {
  for (int i = range.last - 1; i >= range.first; --i) {
    if (x[i] == 0.0) continue;
    const mjtNum* entry = factor + m->dof_Madr[i] + 1;
    for (int j = m->dof_parentid[i]; j >= 0; j = m->dof_parentid[j]) x[j] -= *entry++ * x[i];
  }
  for (int i = range.first; i < range.last; ++i) x[i] *= inverse[i];
  for (int i = range.first; i < range.last; ++i) {
    const mjtNum* entry = factor + m->dof_Madr[i] + 1;
    for (int j = m->dof_parentid[i]; j >= 0; j = m->dof_parentid[j]) x[i] -= *entry++ * x[j];
  }
}

}  // namespace rotorub::plugin
