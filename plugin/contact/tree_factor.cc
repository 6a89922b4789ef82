#include "plugin/contact/tree_factor.h"

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
