// The rigid contacts of one step of MuJoCo as one problem in their impulses: how the impulses of
// some contacts change the rates of all, and the impulses that obey the contact laws.
//
//   end_i = start_i + h a_i + sum_j G_ij w_j p_j,     w = (W_N, W_T)
//
// p = (normal, friction) impulses. If a contact moves along its ring's axis (relative_motion.h),
// each contact has a third row: W_Z and the friction along the axis. G is the admittance of the
// step's matrix for an impulse that acts during the whole step, and the admittance of the mass for
// an impulse of an impact. If MuJoCo's constraints act on one of the bodies, its solver is asked
// for the rates instead (constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "native_model/contact/constrained_law.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/rigid_step.h"

namespace rotorub::plugin {

// A rigid contact of a forward pass.
struct RigidContact {
  // The caller fills these members, except rows.e_r and step.free.
  const ContactPair* pair = nullptr;
  ContactRows rows;
  bool constrained = false;  // true: a row of MuJoCo's constraint solver is coupled to it
  RigidStep step;
  Eigen::Vector3d axial_start{0.0, 0.0, 0.0};  // rates in the space of the axis at the beginning

  bool closed = false;
  bool blocked = false;  // it would end outside its ring, but no impulse opens its gap
  // It starts an impact itself: it was open, and its rebound lasts longer than two steps.
  bool impact = false;
  // N s, (normal, friction, friction along the axis) of the two parts of the step: first the
  // lasting contacts over the step, then the impacts in no time (rigid.cc).
  Eigen::Vector3d lasting_impulse{0.0, 0.0, 0.0}, impact_impulse{0.0, 0.0, 0.0};
  // Rates at the end of the step with all impulses so far.
  Eigen::Vector3d end{0.0, 0.0, 0.0}, axial_end{0.0, 0.0, 0.0};
  RigidResult result;
};

// The contacts for which one part of the step is solved, in the order of its vectors.
struct ContactSubset {
  struct Member {
    RigidContact* at = nullptr;
    double offset = 0.0;  // m/s, added to its gap rate in the normal law
  };
  ContactList<Member> members;
  bool impact = false;
};

// Further results for a subset, in addition to its impulses.
struct SubsetSolution {
  std::array<bool, kMaxContacts> sticks{};
  // For impacts with constraints (constrained_law.h).
  std::array<bool, kMaxContacts> lasts{};
  ContactVector after;  // rates just after the impact; empty: the rates at the end of the step
};

class RigidContacts {
 public:
  // probe: null if no constraint acts on the bodies.
  RigidContacts(const mjModel* m, mjData* d, std::span<RigidContact* const> members,
                ConstraintProbe* probe);

  bool any_closed() const;
  bool converged() const { return converged_; }
  // The row at which contact k of a subset begins in a vector. Each contact has 2 rows, or 3 if any
  // contact moves along its axis.
  Eigen::Index row(std::size_t k) const { return rows_ * static_cast<Eigen::Index>(k); }

  // Finds the rates at the end of the step with the present impulses.
  void update_ends();
  // (gap rate + offset, slip, slip along the axis) of a subset.
  ContactVector rates(const ContactSubset& s) const;
  // Finds the impulses of the subset. False: there is no solution, or there are several; the status
  // of the results says which.
  bool solve(const ContactSubset& s, SubsetSolution& out);
  // Sets all impulses to 0 and keeps the status of the results.
  void clear_impulses();

  // Adds the impulses as forces over the step.
  void add_forces(mjtNum* to) const;

 private:
  class Response;

  // Calls action(space, load, impact) with the loads of all impulses, divided by `by`.
  template <typename Action>
  void for_each_load(double by, Action action) const;
  // (gap rate, slip, slip along the axis) of the contacts of a subset, one after the other.
  // rates_in(contact, space): the contact's rates in one of its spaces.
  template <typename RatesIn>
  ContactVector contact_rates(const ContactSubset& s, RatesIn rates_in) const;
  // The impulses of the only contact in an impact that takes time.
  CoupledSolution solve_impact_over_time(const RigidContact& at) const;
  // The slip of each contact of the subset where the step begins, m/s.
  ContactList<double> slips_before(const ContactSubset& s) const;
  ContactMatrix matrix(const ContactSubset& s) const;
  // Sets the impulses of the subset's part of the step.
  void set_impulses(const ContactSubset& s, const ContactVector& p);
  // Returns the change of the subset's rates by impulses that act in no time.
  ContactVector instant_change(const ContactSubset& s, const ContactVector& p);
  // Rates at the end of the step in one space; `start`: the rates at its beginning.
  Eigen::Vector3d end_of(const ContactSpace& at, const Eigen::Vector3d& start) const;
  bool solve_with_constraints(const ContactSubset& s, const ContactMatrix& a,
                              const ContactVector& free, std::span<const ImpactLaw> laws,
                              SubsetSolution& out);

  mjData* d_;
  std::span<RigidContact* const> members_;
  ConstraintProbe* probe_;
  double h_;
  Eigen::Index rows_ = 2;
  bool converged_ = true;
};

}  // namespace rotorub::plugin
