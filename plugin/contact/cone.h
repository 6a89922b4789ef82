// Contact models `cone` and `cone-coulomb`: MuJoCo's own soft contact with its friction cone,
// elliptic or pyramidal. If the spin is prescribed, it is not a degree of freedom, and MuJoCo does
// not see its slip r Omega; this slip is added to the reference of the tangential rows. `cone` may
// have its own friction reference, a_ref,T = -B_t v_slip, which MuJoCo has since 2.3.6
// (solreffriction); `cone-coulomb` is corrected for sliding (below).
#pragma once

#include <mujoco/mujoco.h>

#include <optional>
#include <span>

namespace rotorub::plugin {

// surface_speed: m/s, r Omega of the prescribed spin. The contact must have friction rows.
void add_prescribed_slip(double surface_speed, const mjModel* m, mjData* d,
                         const mjContact& contact);

// Sets aref = -B_t v in the friction rows, if there are any, those of torsion and rolling included;
// B_t in 1/s.
void set_friction_reference(const mjModel* m, mjData* d, const mjContact& contact,
                            double reference);

// Contact model `cone-coulomb`: MuJoCo's own friction cone and solver, changed so that they obey
// Coulomb's law in sliding.
//
// MuJoCo finds f in the cone f_N >= |g|, g_i = f_i / mu_i, with y = J a + R f - a_ref in the dual
// cone and y . f = 0 (mujoco.readthedocs.io, Computation, "Dual problem"). Far from sticking this
// means y_N = |z|, z_i = mu_i y_i: the slip lifts the contact by |z| in the normal direction, which
// is B mu |v_slip| and more, and throws it open. Coulomb's law requires y_N = 0. It is the cone's
// law with the normal rate shifted by |z| (de Saxce and Feng, Mathematical and Computer Modelling
// 28, 1998):
//
//   a_ref,N -> a_ref,N - |z|
//
// Second, MuJoCo's rows leave out J' v: they treat a contact that slides round a ring as straight,
// so that it lies v_t^2 / (delta K) too deep. For a rotor in its ring v_t^2 / delta is known, and
// a_ref,N is raised by it. The gap in a lasting rub is then 0 within the accuracy of the step: the
// contact is included from its margin on, with the gap itself in a_ref, and has a force if the step
// would close it.
//
// Third, the friction rows slow the slip by the B of the restitution, which is small for e near 1,
// so that in an oblique impact they produce less than mu N. With the corrected normal reference a
// large B_t lifts nothing, so the friction rows use B_t = 1 / (2 h) for any B: each step halves a
// slip that friction can stop. With B_t = 1 / h, which stops it in one step, the contact of a ring
// whose tangent turns within the step opens and closes in turn under strong friction
// (mjcf/hard/friction_ten.toml), although slips end a little more accurately elsewhere.
//
// |z| is unknown before the solution. If none of several contacts slides in MuJoCo's solution
// without a shift, that solution is Coulomb's and is kept. Otherwise each group of contacts that is
// not coupled to other constraints or to other groups is solved exactly, with Coulomb's law
// (disc_law.h). With other constraints, torsional or rolling friction, and a slip that is not along
// a tangent of one of MuJoCo's pyramids, whose norm is max |z_i|, MuJoCo's solver is run repeatedly
// until the |z| of its solution equals the shift. Nothing is remembered from step to step, so
// mj_forward may be repeated and a state may be written, as with MuJoCo alone.

struct SlidingContact {
  const mjContact* contact = nullptr;  // solved by MuJoCo: efc_address >= 0
  std::optional<double> curvature{};   // m/s^2, v_t^2 / delta >= 0; empty: no correction
};

// Shifts the contacts' normal references. Called by apply_command_and_contacts() (passes.cc), after
// the references of the friction rows are set. Contacts without friction rows are not corrected for
// sliding, only for the curvature.
void correct_cones(const mjModel* m, mjData* d, std::span<const SlidingContact> contacts);

}  // namespace rotorub::plugin
