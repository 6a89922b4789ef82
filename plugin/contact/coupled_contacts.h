// The contacts of a coupled step (coupled_step.h) as one problem in their impulses: what impulses
// of some of them do to the rates of all, and the impulses that meet the laws.
//
//   end_i = start_i + h a_i + sum_j G_ij w_j p_j,     w = (W_N, W_T)
//
// p = (normal, friction) impulses; and where one of them moves along its ring's axis
// (relative_motion.h) with W_Z and the friction along the axis for a third. G is the flexibility of
// the step's matrix for what acts all through it, the admittance of the mass for a blow; where
// MuJoCo's constraints hold a body, its solver is asked instead (contact/constraint_probe.h).
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "native_model/contact/constrained_law.h"
#include "plugin/contact/constraint_probe.h"
#include "plugin/contact/coupled_step.h"

namespace rotorub::plugin {

// A contact of the step that is being solved.
struct Closing {
  bool closed = false;
  bool impact = false;  // by itself: it was open, and its rebound outlives the step
  ContactRows rows;
  // N s, (normal, friction, friction along the axis) of the two parts.
  Eigen::Vector3d lasting{0.0, 0.0, 0.0}, sudden{0.0, 0.0, 0.0};
  Eigen::Vector3d end, axial_end;  // rates at the end of the step with all impulses so far
  RigidResult result;
};

// Those of the contacts that one part of the step is solved for, in the order of its vectors.
struct ContactSubset {
  std::array<std::size_t, kMaxContacts> index{};
  std::size_t count = 0;
  bool impact = false;
  std::array<double, kMaxContacts> offset{};  // m/s, of the normal law
};

// What was found for a subset beside its impulses; the two that follow, of impacts beside
// constraints (constrained_law.h).
struct SubsetSolution {
  std::array<bool, kMaxContacts> sticks{};
  std::array<bool, kMaxContacts> lasts{};
  ContactVector after;  // empty: the rates at the end of the step
};

class CoupledContacts {
 public:
  // All open, without impulses. probe: null where no constraint moves with the members.
  CoupledContacts(const mjModel* m, mjData* d, std::span<CoupledMember* const> members,
                  ConstraintProbe* probe);

  std::size_t size() const { return members_.size(); }
  Closing& operator[](std::size_t i) { return contacts_[i]; }
  const Closing& operator[](std::size_t i) const { return contacts_[i]; }
  bool any_closed() const;
  bool converged() const { return converged_; }
  // Numbers of a contact in a vector: 2, or 3 where one of them moves along its axis.
  Eigen::Index rows() const { return rows_; }

  // Rates at the end of the step, with the impulses as they are.
  void find_ends();
  // (gap rate + offset, slip, and that along the axis) of a subset.
  ContactVector rates(const ContactSubset& s) const;
  // Puts the impulses of the subset. False: no solution, or several, which is then the status of
  // their results.
  bool solve(const ContactSubset& s, SubsetSolution& out);
  // What was found of a step without a solution is its status.
  void give_none();

  // Adds the impulses as forces over the step.
  void add_forces(mjtNum* to) const;

 private:
  class Response;

  ContactMatrix matrix(const ContactSubset& s) const;
  void put(const ContactSubset& s, const ContactVector& p);
  // The change of a subset's rates by impulses of it that act in no time.
  ContactVector sudden_change(const ContactSubset& s, const ContactVector& p);
  // Rates at the end of the step in one space, `start` those at its beginning.
  Eigen::Vector3d end_of(const ContactSpace& at, const Eigen::Vector3d& start) const;
  bool solve_held(const ContactSubset& s, const ContactMatrix& a, const ContactVector& free,
                  std::span<const ImpactLaw> laws, SubsetSolution& out);
  void set_status(const ContactSubset& s, Status status);

  mjData* d_;
  std::span<CoupledMember* const> members_;
  ConstraintProbe* probe_;
  double h_;
  Eigen::Index rows_ = 2;
  bool converged_ = true;
  std::array<Closing, kMaxContacts> contacts_;
};

}  // namespace rotorub::plugin
