// The mass matrix, the constraints and the derivatives of MuJoCo's dynamics in its different
// versions (mujoco_versions.h). Some of the functions are in every libmujoco.so but in no header.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>

#include "plugin/model/mujoco_versions.h"

extern "C" {
#if mjVERSION_HEADER < 233
void mjd_smooth_vel(const mjModel*, mjData*);
void mj_makeMSparse(const mjModel*, mjData*, int* rows, int* addresses, int* columns);
#else
void mjd_smooth_vel(const mjModel*, mjData*, int with_bias);
#endif
#if mjVERSION_HEADER >= 3007000
mjtNum mj_actuatorDamping(const mjModel*, mjtObj, int id, mjtNum* poly);
mjtNum mjd_xPolyForce(mjtNum linear, const mjtNum* poly, mjtNum x, int n, int odd);
#endif
#if mjVERSION_HEADER >= 3011000
int mjd_freeMhat(const mjModel*, const mjData*, int joint, mjtNum h, mjtNum* matrix);
#endif
}

namespace rotorub::plugin {

// --- The mass matrix, row by row: the diagonal, then the dof's ancestors towards the root ---
//
// Up to 3.2 the entries of qM and of its factor qLD follow one another in this order. Since 3.3 the
// factor, and since 3.11 the matrix too, are stored in rows by rising column with the diagonal
// last. The rows of dofs that MuJoCo calls simple then contain only the diagonal.

struct MassRow {
  int diagonal;   // its address in the matrix
  int step;       // from one entry to that of the next ancestor
  int ancestors;  // number of ancestors in the row
};

template <typename Data>
constexpr bool kMassByColumns = requires(const Data* d) {
  d->M;
};

template <typename Model, typename Data = mjData>
MassRow mass_row(const Model* m, int dof) {
  if constexpr (kMassByColumns<Data>) {
    const int others = m->M_rownnz[dof] - 1;
    return {m->M_rowadr[dof] + others, -1, others};
  } else {
    const int first = m->dof_Madr[dof];
    const int end = dof + 1 < count(m->nv) ? m->dof_Madr[dof + 1] : count(m->nM);
    return {first, 1, end - first - 1};
  }
}
template <typename Data>
const mjtNum* mass_entries(const Data* d) {
  if constexpr (kMassByColumns<Data>) {
    return d->M;
  } else {
    return d->qM;
  }
}
template <typename Model, typename Data = mjData>
int mass_size(const Model* m) {
  if constexpr (kMassByColumns<Data>) {
    return count(m->nC);
  } else {
    return count(m->nM);
  }
}

// make_mass computes the mass matrix, full_mass writes it as a full matrix, nv x nv. Call them
// after mj_comPos.
template <typename Data>
void make_mass(const mjModel* m, Data* d) {
  if constexpr (requires { mj_makeM(m, d); }) {
    mj_makeM(m, d);
  } else {
    mj_crb(m, d);
  }
}
template <typename Data>
void full_mass(const mjModel* m, const Data* d, mjtNum* full) {
  if constexpr (requires { mj_fullM(m, d, full); }) {
    mj_fullM(m, d, full);
  } else {
    mj_fullM(m, full, d->qM);
  }
}

// --- Constraints ---

template <typename Model>
bool equality_holds(const Model* m, int equality) {  // after mj_resetData
  if constexpr (requires { m->eq_active0; })
    return m->eq_active0[equality] != 0;
  else
    return m->eq_active[equality] != 0;
}

template <typename Data>
const mjtNum* constraint_diagonal(const Data* d) {  // approximately that of J M^-1 J^T
  if constexpr (requires { d->efc_diagA; }) {
    return d->efc_diagA;
  } else {
    return d->efc_diagApprox;
  }
}

// x = M^-1/2 y.
template <typename Data>
void half_solve(const mjModel* m, Data* d, mjtNum* x, const mjtNum* y, StackFrame& room) {
  if constexpr (std::is_invocable_v<decltype(&mj_solveM2), const mjModel*, Data*, mjtNum*,
                                    const mjtNum*, int>) {
    mj_solveM2(m, d, x, y, 1);
  } else {
    mjtNum* roots = room.numbers(count(m->nv));
    for (int i = 0; i < count(m->nv); ++i) roots[i] = mju_sqrt(d->qLDiagInv[i]);
    mj_solveM2(m, d, x, y, roots, 1);
  }
}

// --- Terms that the integrators treat implicitly in the velocities ---

// True for the integrator implicitfast, available since 2.3.3. It uses dF/dv without the bias
// forces, and only the lower triangle.
inline bool implicit_fast(const mjModel* m) {
#if mjVERSION_HEADER >= 233
  return m->opt.integrator == mjINT_IMPLICITFAST;
#else
  static_cast<void>(m);
  return false;
#endif
}
inline bool steps_implicitly(const mjModel* m) {
  return m->opt.integrator == mjINT_IMPLICIT || implicit_fast(m);
}

// Computes d->qDeriv = dF/dv of actuators, dampers, fluid and bias forces, as the integrator will.
// Call it after mj_fwdActuation.
inline void find_derivative(const mjModel* m, mjData* d) {
#if mjVERSION_HEADER < 233
  mj_makeMSparse(m, d, d->D_rownnz, d->D_rowadr, d->D_colind);
  mjd_smooth_vel(m, d);
#else
  mjd_smooth_vel(m, d, implicit_fast(m) ? 0 : 1);
#endif
}

// Calls action(column, value) for the entries of one row of d->qDeriv. No entry couples two trees.
template <typename Model, typename Data, typename Action>
void for_each_derivative(const Model* m, const Data* d, int row, Action action) {
  const auto visit = [&](const auto* places) {
    const int first = places->D_rowadr[row];
    for (int k = first; k < first + places->D_rownnz[row]; ++k)
      action(places->D_colind[k], d->qDeriv[k]);
  };
  if constexpr (requires { m->D_rowadr; }) {
    visit(m);
  } else {
    visit(d);
  }
}

// For a standalone free body implicitfast includes the bias forces too.
// Writes the 6 x 6 matrix M - h dF/dv of such a body, row by row. False if this does not apply.
inline bool free_body_matrix(const mjModel* m, const mjData* d, int joint, mjtNum* matrix) {
#if mjVERSION_HEADER >= 3011000
  return implicit_fast(m) && m->jnt_type[joint] == mjJNT_FREE &&
         mjd_freeMhat(m, d, joint, m->opt.timestep, matrix);
#else
  static_cast<void>(m), static_cast<void>(d), static_cast<void>(joint), static_cast<void>(matrix);
  return false;
#endif
}

// -df/dv of a joint's damper at the present velocity, N s/m or N m s. Since 3.7 it is a polynomial
// that includes the actuators' dampers.
inline double joint_damping(const mjModel* m, const mjData* d, int dof) {
#if mjVERSION_HEADER >= 3007000
  mjtNum poly[mjNPOLY];
  std::copy_n(m->dof_dampingpoly + mjNPOLY * dof, mjNPOLY, poly);
  const mjtNum linear =
      m->dof_damping[dof] + mj_actuatorDamping(m, mjOBJ_JOINT, m->dof_jntid[dof], poly);
  return mjd_xPolyForce(linear, poly, d->qvel[dof], mjNPOLY, 1);
#else
  static_cast<void>(d);
  return m->dof_damping[dof];
#endif
}
// True if the damping is not the constant in dof_damping.
inline bool joint_damping_varies(const mjModel* m, int dof) {
#if mjVERSION_HEADER >= 3007000
  const mjtNum* poly = m->dof_dampingpoly + mjNPOLY * dof;
  return m->jnt_actuatorid[m->dof_jntid[dof]] != -1 ||
         std::any_of(poly, poly + mjNPOLY, [](mjtNum x) { return x != 0.0; });
#else
  static_cast<void>(m), static_cast<void>(dof);
  return false;
#endif
}
inline bool tendon_damps(const mjModel* m, int tendon) {
#if mjVERSION_HEADER >= 3007000
  const mjtNum* poly = m->tendon_dampingpoly + mjNPOLY * tendon;
  if (m->tendon_actuatorid[tendon] != -1 ||
      std::any_of(poly, poly + mjNPOLY, [](mjtNum x) { return x != 0.0; })) {
    return true;
  }
#endif
  return m->tendon_damping[tendon] != 0.0;
}

}  // namespace rotorub::plugin
