// What MuJoCo's steps take implicitly in the velocities, as its versions have it
// (mujoco_versions.h). The functions are in every libmujoco.so; no header of its declares them.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>

#include "plugin/mujoco_versions.h"

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

// Integrator implicitfast, from 2.3.3 on: dF/dv without that of the bias forces, and of it the
// lower triangle.
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

// d->qDeriv = dF/dv of actuators, dampers, fluid and bias forces, as the integrator will find it:
// after mj_fwdActuation.
inline void find_derivative(const mjModel* m, mjData* d) {
#if mjVERSION_HEADER < 233
  mj_makeMSparse(m, d, d->D_rownnz, d->D_rowadr, d->D_colind);
  mjd_smooth_vel(m, d);
#else
  mjd_smooth_vel(m, d, implicit_fast(m) ? 0 : 1);
#endif
}

// Its entries of one row: action(column, value). None is between two trees.
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

// Of a free body that stands for itself implicitfast takes the bias forces too: its 6 x 6 matrix,
// row by row. False: it does not.
inline bool free_body_matrix(const mjModel* m, const mjData* d, int joint, mjtNum* matrix) {
#if mjVERSION_HEADER >= 3011000
  return implicit_fast(m) && m->jnt_type[joint] == mjJNT_FREE &&
         mjd_freeMhat(m, d, joint, m->opt.timestep, matrix);
#else
  static_cast<void>(m), static_cast<void>(d), static_cast<void>(joint), static_cast<void>(matrix);
  return false;
#endif
}

// -df/dv of a joint's damper at the present velocity, N s/m or N m s: since 3.7 a polynomial, the
// actuators' dampers in it.
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
// Whether it is more than the number in dof_damping.
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
