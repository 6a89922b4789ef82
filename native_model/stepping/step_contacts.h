// The contacts of one run in a fixed step, as one list: they decide whether the straight path of
// the step leaves a circle and whether contact lasts, and find the impulses of lasting contacts.
//
// Rigid lasting contacts end the step on their circles (contact/lasting_contacts.h). Usually there
// is only one, which slides on as in the step before. If the path of a rigid contact in flight
// leaves its circle, an impact begins (verlet.cc).
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
#include <span>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/lasting_contacts.h"
#include "native_model/contact/most_contacts.h"
#include "native_model/model/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

class StepContacts {
 public:
  // The state of a contact that is kept between steps. Until go_on() it belongs to the step before,
  // afterwards to this step.
  struct Kept {
    // Rigid: the contact lasts on its circle. Compliant: it has been in the wall since its last
    // touch.
    bool closed = false;
    double slip_sign = 0.0;               // sliding: +1, -1; 0: open or sticking
    double normal = 0.0, friction = 0.0;  // N s, of lasting contact in the step
    // N s, if the forces at the end of the step acted over a whole step.
    double normal_at_end = 0.0, friction_at_end = 0.0;
    double hunt_crossley = 0.0;  // s/m, a of the last touch (compliant)
  };
  using State = std::array<Kept, kMaxContacts>;

  // Both must outlive this object.
  StepContacts(const StepState& x, LoadKick& loads);

  State now{};
  std::vector<Impact> impacts;  // of the step, in order

  std::size_t count() const { return contacts_.size(); }
  bool exists() const { return exists_; }
  bool is_rigid(std::size_t i) const { return contacts_[i].rigid; }
  const Model& model() const { return m_; }
  const ContactParameters& law(std::size_t i) const { return *m_.auxiliary[i].contact; }
  // (ddot, spin) for velocities v.
  Eigen::Vector3d rates(std::size_t i, const double* v) const;
  // m, from the ring's to the rotor's centre at q_k.
  Eigen::Vector2d place(std::size_t i) const { return {contacts_[i].d.x, contacts_[i].d.y}; }
  // True if a rigid contact lasts.
  bool lasts() const;

  // Begins a step.
  void forget_last();
  // Call it after a state has been written. A contact at rest on its circle is then a lasting
  // contact, and a compliant contact in its wall begins closed, without a touch.
  void begin(const StepState& x);
  // True if the free velocity need not be iterated before go_on(), because go_on() iterates it
  // together with the contacts that last. Compliant contacts need it before.
  bool iterates_free() const { return !gives_ && lasts(); }

  // Computes x.after from x.free with the impulses of all lasting contacts. Sets a status of x if
  // the laws have no unique solution.
  void go_on(StepState& x, bool unsettled = false);
  // Call it after go_on(): true if a contact in flight leaves its circle in the step with x.after.
  bool leave_flight(const StepState& x) const;
  // Adds to x.free the change of velocity by the forces of the last step's end, acting over a whole
  // step along the present normals.
  void add_last_forces(StepState& x);

  // If a load jumps in a step, the step is taken in two parts: `first` holds for the fraction
  // `share`, and the part taken last for `rest`; kick: duration of the kick in steps. A part is
  // alike to the state before the step if its lasting contacts go on in the same way.
  bool alike(const State& part, const State& was) const;
  State second_part(const State& was, const State& first) const;
  void join_parts(double share, double rest, const State& first, double kick);
  // Takes such a step as one, with the state under its mean loads.
  void go_on_as(const State& mean);

  // Call it before impacts change x.after.
  void keep_end(const StepState& x) { without_impacts_ = x.after; }
  // listed: the impact is added to `impacts`, not only to the impulses.
  void note_impact(const Impact& impact, bool listed = true);
  // Sets whether contact lasts from here on.
  void set_closed(std::size_t i, bool closed);
  // to += A^-1 J^T times the impulses of a contact, with the normal of the step.
  void push(std::size_t i, double normal, double friction, double* to) const;

  // The numbers that are kept between steps: for_each_kept() has those that precede the state in a
  // saved memory, for_each_force_kept() all others.
  template <class Action>
  void for_each_kept(Action& action) {
    keep_flag(now[0].closed, action);
    action(now[0].slip_sign);
  }
  template <class Action>
  void for_each_force_kept(Action& action) {
    for (std::size_t i = 0; i < count(); ++i) {
      Kept& c = now[i];
      if (i > 0) {
        keep_flag(c.closed, action);
        action(c.slip_sign);
      }
      action(c.normal_at_end);
      action(c.friction_at_end);
      if (!contacts_[i].rigid) action(c.hunt_crossley);
    }
  }
  static std::size_t count_kept(const Model& m) {  // how many both have
    std::size_t numbers = 0;
    for (const AuxiliaryBearing& at : m.auxiliary) {
      numbers += at.contact && at.contact->gives() ? 5U : 4U;
    }
    return numbers;
  }

  // Velocities at the end of the step without its impacts.
  const double* end_without_impacts(const StepState& x) const {
    return impacted_ ? without_impacts_.data() : x.after.data();
  }
  // Writes the results of the step (contact_results.cc).
  void tell(FixedStep& out) const;
  // J, work of lasting contact on the coordinates, from the velocities x.start to the end without
  // impacts.
  double lasting_work(const StepState& x) const;

 private:
  using Pair = equations::Pair;
  using List = ContactList<std::size_t>;

  struct Contact {
    const AuxiliaryBearing* at = nullptr;
    bool rigid = true;   // also if there is no contact
    bool flies = false;  // rigid, and not lasting before the step
    double clearance = 0.0, radius = 0.0;
    // mu; not a number if mu depends on the slip, so that slide_on() returns false.
    double friction = 0.0;
    // The velocities by a load (x, y, torque about z): the columns of A^-1 J^T. If a free spin is
    // coupled with bending (velocity_matrix.h), they are the columns of A_0^-1 J^T, and `coupled`
    // has the rest of A^-1 J^T, which changes from step to step.
    std::array<StepState::Coordinates, 3> column;
    std::array<VelocityMatrix::Coupled, 3> coupled{};
    // In the step: m, from the ring's to the rotor's centre; outward normal; m/s, relative velocity
    // for x.free; sign of the slip before the step, and before the present part of it.
    Pair d{0.0, 0.0}, e_r{1.0, 0.0}, free{0.0, 0.0};
    double last_sign = 0.0, sign_before = 0.0;
    // For a compliant contact: (ddot, spin) for x.start and x.free; w_0 (N s), w_1 (N s^2/m).
    Eigen::Vector3d start_rates{0.0, 0.0, 0.0}, free_rates{0.0, 0.0, 0.0};
    double spring = 0.0, damper = 0.0;
  };

  const Eigen::Matrix3d& admittance(std::size_t i, std::size_t j) const {
    return admittance_[i * count() + j];
  }
  void couple();
  // to = from + A^-1 J^T times the impulses of a contact.
  void add_response(std::size_t i, double normal, double friction, const double* from,
                    double* to) const;
  void look(const StepState& x);
  void look_at_free(const StepState& x);
  // Turns the normal to the place at q_k; it is unchanged if the centres coincide there.
  static void turn_normal(Contact& c) {
    const double delta = std::sqrt(c.d.x * c.d.x + c.d.y * c.d.y);
    if (delta > kNoNormal) c.e_r = {c.d.x / delta, c.d.y / delta};
  }
  bool leaves(const Contact& c, const Pair& velocity) const;
  void find_lasting(StepState& x, bool unsettled);
  void solve_closed(StepState& x);
  bool find_impulses(StepState& x);
  bool slide_on(std::size_t i, const double* free);
  bool solve_lasting(StepState& x);
  // The rates of a contact by the impulses of the others.
  Eigen::Vector3d rates_by(std::size_t i, const List& others) const;
  void note_lasting();

  // Compliant contacts (compliant_contacts.cc).
  bool find_touches(StepState& x);
  void meet_wall(std::size_t i, const Eigen::Vector3d& free);
  bool solve_compliant(StepState& x);
  void solve_one_compliant(std::size_t i, const Eigen::Vector3d& end);
  void find_impulses(std::size_t i, const Eigen::Vector2d& before, const Eigen::Vector2d& after,
                     const Delassus& g);

  const Model& m_;
  LoadKick& loads_;
  double h_;
  bool exists_ = false, gives_ = false;
  std::vector<Contact> contacts_;
  std::vector<Eigen::Matrix3d> uncoupled_, admittance_;  // blocks for each pair of contacts
  std::int64_t coupled_at_ = -1;       // VelocityMatrix::times_coupled() of admittance_
  double before_ = 0.0, after_ = 0.0;  // s, parts of the step before and after t_k
  // In the step: rigid lasting contacts and compliant contacts in their walls; whether any contact
  // acts; whether there were impacts; whether done_ has been written.
  List lasting_, compliant_;
  bool acts_ = false, impacted_ = false, did_ = false;
  std::vector<ContactStep> done_;
  StepState::Coordinates without_impacts_;  // velocities at the end of the step
};

}  // namespace rotorub
