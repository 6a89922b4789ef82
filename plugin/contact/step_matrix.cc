#include "plugin/contact/step_matrix.h"

#include <Eigen/Core>
#include <algorithm>

#include "plugin/model/mujoco_dynamics.h"
#include "plugin/model/mujoco_versions.h"

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

int last_dof(const mjModel* m, int body) {
  while (body > 0 && m->body_dofnum[body] == 0) body = m->body_parentid[body];
  return body == 0 ? -1 : m->body_dofadr[body] + m->body_dofnum[body] - 1;
}

void solve_tree(const mjModel* m, const mjtNum* factor, const mjtNum* inverse, DofRange range,
                mjtNum* x) {
  const int nv = count(m->nv);
  mjtNum *y = x + nv, *z = y + nv;
  for (int i = range.last - 1; i >= range.first; --i) {
    if (x[i] == 0.0 && y[i] == 0.0 && z[i] == 0.0) continue;
    const MassRow row = mass_row(m, i);
    const mjtNum* entry = factor + row.diagonal;
    for (int j = m->dof_parentid[i], left = row.ancestors; left > 0; --left) {
      entry += row.step;
      x[j] -= *entry * x[i];
      y[j] -= *entry * y[i];
      z[j] -= *entry * z[i];
      j = m->dof_parentid[j];
    }
  }
  for (int i = range.first; i < range.last; ++i) {
    double solved[3] = {x[i] * inverse[i], y[i] * inverse[i], z[i] * inverse[i]};
    const MassRow row = mass_row(m, i);
    const mjtNum* entry = factor + row.diagonal;
    for (int j = m->dof_parentid[i], left = row.ancestors; left > 0; --left) {
      entry += row.step;
      solved[0] -= *entry * x[j];
      solved[1] -= *entry * y[j];
      solved[2] -= *entry * z[j];
      j = m->dof_parentid[j];
    }
    x[i] = solved[0];
    y[i] = solved[1];
    z[i] = solved[2];
  }
}

namespace {

using Block = Eigen::Map<Eigen::Matrix<mjtNum, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using Part = Eigen::Map<Eigen::Matrix<mjtNum, Eigen::Dynamic, 1>>;

int size_of(DofRange tree) { return tree.last - tree.first; }

// Factors M + step B as MuJoCo does (mj_factorM) for the rows of the tree, where B holds the
// joints' dampers. factor: as long as the mass matrix; inverse: nv, 1 / D.
void factor_tree(const mjModel* m, const mjData* d, double step, DofRange tree, mjtNum* factor,
                 mjtNum* inverse) {
  const mjtNum* mass = mass_entries(d);
  for (int i = tree.first; i < tree.last; ++i) {
    const MassRow row = mass_row(m, i);
    const int first = row.step > 0 ? row.diagonal : row.diagonal - row.ancestors;
    std::copy_n(mass + first, row.ancestors + 1, factor + first);
    factor[row.diagonal] += step * joint_damping(m, d, i);
  }
  // From the tips to the root: each row is subtracted from those of its ancestors.
  for (int k = tree.last - 1; k >= tree.first; --k) {
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

// to += sign M, for the block of the tree.
void add_mass(const mjModel* m, const mjData* d, DofRange tree, double sign, Block& to) {
  const mjtNum* mass = mass_entries(d);
  for (int i = tree.first; i < tree.last; ++i) {
    const MassRow row = mass_row(m, i);
    const int at = i - tree.first;
    to(at, at) += sign * mass[row.diagonal];
    int j = m->dof_parentid[i];
    for (int k = 1; k <= row.ancestors; ++k, j = m->dof_parentid[j]) {
      const mjtNum entry = sign * mass[row.diagonal + k * row.step];
      to(at, j - tree.first) += entry;
      to(j - tree.first, at) += entry;
    }
  }
}

// Factors a in place into L U, where L has a unit diagonal. Without pivoting, because for usable
// steps H is near M, which is positive definite.
void factor_block(Block& a) {
  const Eigen::Index n = a.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index i = k + 1; i < n; ++i) {
      if (a(i, k) == 0.0) continue;
      a(i, k) /= a(k, k);
      a.row(i).tail(n - k - 1) -= a(i, k) * a.row(k).tail(n - k - 1);
    }
  }
}

}  // namespace

StepMatrix::StepMatrix(const mjModel* m, mjData* d)
    : m_(m), d_(d), room_(d), implicit_(steps_implicitly(m)), damped_step_(damped_step(m)) {
  if (implicit_) {
    find_derivative(m, d);
  } else if (damped_step_ != 0.0) {
    factor_ = room_.numbers(mass_size(m));
    inverse_ = room_.numbers(count(m->nv));
    std::fill_n(inverse_, count(m->nv), 0.0);
  }
}

bool StepMatrix::differs(DofRange tree) const {
  if (implicit_) return true;
  if (damped_step_ == 0.0) return false;
  for (int i = tree.first; i < tree.last; ++i) {
    if (joint_damping(m_, d_, i) != 0.0) return true;
  }
  return false;
}

// H - M of the implicit integrators.
void StepMatrix::fill_excess(DofRange tree, mjtNum* block) const {
  const int n = size_of(tree);
  Block excess(block, n, n);
  excess.setZero();
  if (free_body_matrix(m_, d_, m_->dof_jntid[tree.first], block)) {
    add_mass(m_, d_, tree, -1.0, excess);
    return;
  }
  for (int i = tree.first; i < tree.last; ++i) {
    for_each_derivative(m_, d_, i, [&](int j, mjtNum value) {
      excess(i - tree.first, j - tree.first) = -m_->opt.timestep * value;
    });
  }
  if (!implicit_fast(m_)) return;
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) excess(i, j) = excess(j, i);
  }
}

void StepMatrix::solve(DofRange tree, mjtNum* rows) {
  const int nv = count(m_->nv), n = size_of(tree);
  if (n == 0) return;
  if (!implicit_) {
    if (inverse_[tree.first] == 0.0) {
      factor_tree(m_, d_, damped_step_, tree, factor_, inverse_);
    }
    solve_tree(m_, factor_, inverse_, tree, rows);
    return;
  }
  StackFrame room(d_);
  mjtNum* entries = room.numbers(n * n);
  fill_excess(tree, entries);
  Block h(entries, n, n);
  add_mass(m_, d_, tree, 1.0, h);
  factor_block(h);
  // x H = row: U^T y = row, L^T x = y.
  for (int k = 0; k < 3; ++k) {
    Part x(rows + k * nv + tree.first, n);
    h.triangularView<Eigen::Upper>().transpose().solveInPlace(x);
    h.triangularView<Eigen::UnitLower>().transpose().solveInPlace(x);
  }
}

void StepMatrix::add_excess(DofRange tree, const mjtNum* x, mjtNum* to) const {
  const int n = size_of(tree);
  if (n == 0) return;
  if (!implicit_) {
    for (int i = tree.first; i < tree.last && damped_step_ > 0.0; ++i) {
      to[i] += damped_step_ * joint_damping(m_, d_, i) * x[i];
    }
    return;
  }
  StackFrame room(d_);
  mjtNum* block = room.numbers(n * n);
  fill_excess(tree, block);
  for (int i = 0; i < n; ++i) to[tree.first + i] += mju_dot(block + i * n, x + tree.first, n);
}

}  // namespace rotorub::plugin
