// The contacts of one run in a fixed step, as one list: they decide whether the straight path of
// the step leaves a circle and whether contact lasts, and find the impulses of lasting contacts.
//
// Rigid lasting contacts end the step on their circles (contact/lasting_contacts.h). Usually there
// is only one, which slides on as in the step before. If the path of a rigid contact in flight
// leaves its circle, an impact begins (verlet.cc, shared_impact.h).
//
// The force of a compliant contact (contact/compliance.h) is one more load at q_k, with implicit
// damping and friction:
//
//   P = w_0 + w_1 p',   |T| <= mu P,   slip at the end of the step != 0: T = -mu P sign(slip)
//
// Here p' is the mean of the rates at the start and the end of the step. w_0 is the impulse of the
// spring and w_1 the impulse of the damper per unit rate. Both are taken over the part of the step
// in which two straight paths are in the wall: the path to the place at q_k, and the path on from
// there. The touch and its speed are found on the same paths. The order is 2. The spring is
// explicit: h < 2 / sqrt(k g_NN) (step_limit.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "native_model/contact/contact_list.h"
#include "native_model/contact/kinematics.h"
#include "native_model/contact/lasting_contacts.h"
#include "native_model/model/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

class StepContacts {
 public:
  // The values that a contact keeps between steps. They belong to the step before until
  // apply_lasting(), and to this step afterwards.
  struct State {
    // Rigid: the contact lasts on its circle. Compliant: it has been in the wall since its last
    // touch.
    bool closed = false;
    double slip_sign = 0.0;               // sliding: +1, -1; 0: open or sticking
    double normal = 0.0, friction = 0.0;  // N s, of lasting contact in the step
    // N s, if the forces at the end of the step acted over a whole step.
    double normal_at_end = 0.0, friction_at_end = 0.0;
    double hunt_crossley = 0.0;  // s/m, a of the last touch (compliant)
  };
  using States = std::array<State, kMaxContacts>;

  // Both must outlive this object.
  StepContacts(const StepState& state, LoadKick& loads);

  States states{};              // one for each contact
  std::vector<Impact> impacts;  // of the step, in order

  std::size_t count() const { return contacts_.size(); }
  bool any() const { return any_; }  // false if no auxiliary bearing has a contact
  bool is_rigid(std::size_t i) const { return contacts_[i].rigid; }
  const Model& model() const { return m_; }
  const ContactParameters& parameters(std::size_t i) const { return *m_.auxiliary[i].contact; }
  // (ddot, spin) of a contact for the velocities v (nq values).
  Eigen::Vector3d rates(std::size_t i, const double* v) const;
  // m, vector from the ring's to the rotor's centre at q_k.
  Eigen::Vector2d separation(std::size_t i) const { return {contacts_[i].d.x, contacts_[i].d.y}; }
  // True if a rigid contact lasts.
  bool any_rigid_lasts() const;

  // Call it at the start of a step: clears the results of the step before.
  void clear_results();
  // Call it after a state has been written. A contact at rest on its circle is then a lasting
  // contact, and a compliant contact in its wall begins closed, without a touch.
  void restart(const StepState& state);
  // True if rigid contacts last and no contact is compliant. apply_lasting() can then iterate the
  // free velocity together with the contacts' impulses (iteration_deferred).
  bool can_iterate_with_lasting() const { return !any_compliant_ && any_rigid_lasts(); }

  // Computes v_end from v_free with the impulses of all contacts that last through the step, rigid
  // or compliant, and updates `states`. Sets a status of `state` if the laws have no unique
  // solution. iteration_deferred: v_free has not been iterated (LoadKick::free_velocity()).
  void apply_lasting(StepState& state, bool iteration_deferred = false);
  // Call it after apply_lasting(): true if the path of a contact in flight, with v_end, leaves its
  // circle, so that there is an impact.
  bool any_flight_ends(const StepState& state) const;
  // Adds to v_free the change of velocity by the forces of the last step's end, acting over a whole
  // step along the present normals.
  void add_last_forces(StepState& state);

  // For a step in two parts, in which a load jumps (verlet.cc). `before`: the states before the
  // step; `first`: those after the first part, which holds for the fraction `share` of the step;
  // the second part holds for the fraction `rest`.
  //
  // True if all rigid contacts that lasted before last through the part without a change of slip.
  bool lasts_unchanged(const States& before, const States& part) const;
  // The states with which the second part begins.
  States second_part_start(const States& before, const States& first) const;
  // Call it after the second part: the impulses become the weighted sum of both parts. kick_length:
  // in steps.
  void join_parts(double share, double rest, const States& first, double kick_length);
  // Restores the states that the whole step had under its mean loads.
  void restore_whole_step(const States& mean);

  // Call it before impacts change v_end.
  void keep_end_without_impacts(const StepState& state) { without_impacts_ = state.v_end; }
  // listed: the impact is added to `impacts`, not only to the impulses.
  void add_impact(const Impact& impact, bool listed = true);
  // Sets whether contact lasts from here on.
  void set_closed(std::size_t i, bool closed);
  // to += A^-1 J^T times the impulses (N s) of a contact, the change of the velocities by them,
  // with the normal of the step.
  void add_velocity_change(std::size_t i, double normal, double friction, double* to) const;

  // Both call action for numbers that are kept between steps: visit_saved() for the two numbers
  // that precede the state in a saved memory, visit_saved_forces() for all others.
  template <class Action>
  void visit_saved(Action& action) {
    visit_flag(states[0].closed, action);
    action(states[0].slip_sign);
  }
  template <class Action>
  void visit_saved_forces(Action& action) {
    for (std::size_t i = 0; i < count(); ++i) {
      State& c = states[i];
      if (i > 0) {
        visit_flag(c.closed, action);
        action(c.slip_sign);
      }
      action(c.normal_at_end);
      action(c.friction_at_end);
      if (!contacts_[i].rigid) action(c.hunt_crossley);
    }
  }

  // Velocities at the end of the step without its impacts.
  const double* end_without_impacts(const StepState& state) const {
    return impacted_ ? without_impacts_.data() : state.v_end.data();
  }
  // Writes the results of the step (contact_results.cc). impact_force: N, see ContactStep.
  void write_results(const Eigen::Vector2d& impact_force, FixedStep& out);
  // J, work of lasting contact on the coordinates at the mean velocities of the step.
  double lasting_work(const double* mean) const;

 private:
  using Pair = equations::Pair;
  using List = ContactList<std::size_t>;

  struct Contact {
    const AuxiliaryBearing* bearing = nullptr;
    bool rigid = true;       // also if there is no contact
    bool in_flight = false;  // rigid, and not lasting before the step
    double clearance = 0.0, radius = 0.0;
    std::optional<double> friction;  // mu; empty if it depends on the slip
    // The change of the velocities by a unit impulse in x, in y and about z: the columns of A^-1
    // J^T. If a free spin is coupled with bending (velocity_matrix.h), they are the columns of
    // A_0^-1 J^T, and `coupled` has the rest of A^-1 J^T, which changes from step to step.
    std::array<StepState::Coordinates, 3> column;
    std::array<VelocityMatrix::Coupled, 3> coupled{};
    // In the step: separation (m) and outward normal at q_k; relative velocity, m/s, for v_free;
    // sign of the slip before the step, and before the present part of it.
    Pair d{0.0, 0.0}, e_r{1.0, 0.0}, v_free{0.0, 0.0};
    double last_sign = 0.0, sign_before = 0.0;
    // For a compliant contact: (ddot, spin) for v_start and v_free; w_0 (N s), w_1 (N s^2/m).
    Eigen::Vector3d start_rates{0.0, 0.0, 0.0}, free_rates{0.0, 0.0, 0.0};
    double spring = 0.0, damper = 0.0;
  };

  const Eigen::Matrix3d& admittance(std::size_t i, std::size_t j) const {
    return admittance_[i * count() + j];
  }
  void update_admittance();
  // to = from + A^-1 J^T times the impulses of a contact.
  void add_response(std::size_t i, double normal, double friction, const double* from,
                    double* to) const;
  void find_separations(const StepState& state);  // also calls find_free_rates()
  void find_free_rates(const StepState& state);
  // Turns the normal to the place at q_k; it is unchanged if the centres coincide there.
  static void turn_normal(Contact& c) {
    const double delta = std::sqrt(c.d.x * c.d.x + c.d.y * c.d.y);
    if (delta > kNoNormal) c.e_r = {c.d.x / delta, c.d.y / delta};
  }
  bool leaves_circle(const Contact& c, const Pair& velocity) const;
  void find_lasting(StepState& state, bool iteration_deferred);
  void solve_contacts(StepState& state);
  bool find_impulses(StepState& state);
  bool try_sliding_on(std::size_t i, const double* free);
  bool solve_rigid(StepState& state);
  // (ddot, spin): the change of the rates of a contact by the impulses of the others.
  Eigen::Vector3d rates_by(std::size_t i, const List& others) const;
  void record_lasting();

  // Compliant contacts (compliant_contacts.cc).
  bool find_touches(StepState& state);
  void find_wall_impulses(std::size_t i, const Eigen::Vector3d& free);
  bool solve_compliant(StepState& state);
  void solve_one_compliant(std::size_t i, const Eigen::Vector3d& end);
  void find_compliant_impulses(std::size_t i, const Eigen::Vector2d& before,
                               const Eigen::Vector2d& after, const Delassus& g);

  const Model& m_;
  LoadKick& loads_;
  double h_;
  bool any_ = false, any_compliant_ = false;  // of the model's contacts
  std::vector<Contact> contacts_;
  std::vector<Eigen::Matrix3d> uncoupled_, admittance_;  // blocks for each pair of contacts
  std::int64_t coupled_at_ = -1;       // VelocityMatrix::times_coupled() of admittance_
  double before_ = 0.0, after_ = 0.0;  // s, parts of the step before and after t_k
  // In the step: rigid lasting contacts, compliant contacts in their walls; whether there are any
  // of these; whether there were impacts; whether results_ has been written.
  List lasting_, compliant_;
  bool any_acts_ = false, impacted_ = false, has_results_ = false;
  std::vector<ContactStep> results_;
  StepState::Coordinates without_impacts_;  // velocities at the end of the step
};

}  // namespace rotorub
