// Contact models `cone` and `cone-coulomb` of a scene: MuJoCo's own soft contact with its friction
// cone, elliptic or a pyramid. Where the spin is held constant and so is no degree of freedom, the
// slip that MuJoCo does not see, r Omega, is put into the reference of the tangential rows. `cone`
// may have a friction reference of its own, a_ref,T = -B_t v_slip, which MuJoCo has since 2.3.7
// (solreffriction); `cone-coulomb` is corrected for sliding (below).
#pragma once

#include <mujoco/mujoco.h>

#include <optional>
#include <span>

namespace rotorub::plugin {

// surface_speed: m/s, r Omega of the spin that is held. Of a contact with friction rows.
void add_held_slip(double surface_speed, const mjModel* m, mjData* d, const mjContact& contact);

// aref = -B_t v of the friction rows, of torsion and rolling too, B_t in 1/s.
void set_friction_reference(const mjModel* m, mjData* d, const mjContact& contact,
                            double reference);

// Contact model `cone-coulomb`: MuJoCo's own friction cone and solver, made to obey Coulomb's law
// in sliding.
//
// MuJoCo finds f in the cone f_N >= |g|, g_i = f_i / mu_i, with y = J a + R f - a_ref in the dual
// cone and y . f = 0 (mujoco.readthedocs.io, Computation, "Dual problem"). Far from sticking that
// means y_N = |z|, z_i = mu_i y_i: the slip lifts the normal direction by |z|, which is B mu
// |v_slip| and more, and throws the contact open. Coulomb's law wants y_N = 0. It is the cone's
// with the normal rate shifted by |z| (de Saxce and Feng, Mathematical and Computer Modelling 28,
// 1998):
//
//   a_ref,N -> a_ref,N - |z|
//
// A second thing that MuJoCo's rows leave out is J' v: a contact that slides round a ring is taken
// to be straight, and lies v_t^2 / (delta K) too deep. Of a rotor in its ring, where v_t^2 / delta
// is known, a_ref,N is raised by it. Its gap is then 0 in a lasting rub, give or take the step: the
// contact is seen from its margin on, with the gap itself in a_ref, and presses where the step
// would close it.
//
// A third is that the friction rows slow the slip by B, that of the restitution, which is small
// where e is near 1: in an oblique impact they ask for less than mu N. With the normal reference
// corrected a large B_t lifts nothing, so the friction rows have B_t = 1 / h, whatever B is: what
// slips stops within a step.
//
// |z| is not known before the solution. Contacts that nothing else is coupled to are solved here
// under Coulomb's law (disc_law.h), exactly; beside constraints of others, with torsional or
// rolling friction and with MuJoCo's pyramids, whose norm is max |z_i|, MuJoCo's solver is asked
// until what it answers is what it was given. Nothing is remembered from step to step: mj_forward
// may be repeated, and a state written, as with MuJoCo alone.

struct SlidingContact {
  const mjContact* contact = nullptr;  // of MuJoCo's solver: efc_address >= 0
  std::optional<double> curvature{};   // m/s^2, v_t^2 / delta >= 0; none: it is not known
};

// 1/s, B_t of the friction rows of what is corrected.
inline double corrected_friction_reference(const mjModel* m) { return 1.0 / m->opt.timestep; }

// Called in mjcb_control, when the references of the friction rows are set; shifts the contacts'
// normal references. Contacts without tangential rows are left alone.
void correct_cones(const mjModel* m, mjData* d, std::span<const SlidingContact> contacts);

}  // namespace rotorub::plugin
