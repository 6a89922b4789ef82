// The contacts in a fixed step of one run, as one list: where the straight path of the step leaves
// a circle, whether contact lasts, and the impulses of those that do.
//
// Rigid contacts that last end the step on their circles (contact/step_contact.h), most often one
// alone that slides on as in the step before. Where a rigid contact's path leaves its circle out of
// flight, an impact begins (verlet.cc).
//
// The force of a compliant contact (contact/compliance.h) is one more load at the coordinates that
// the step sees, with its damping and its friction implicit:
//
//   P = w_0 + w_1 p',   |T| <= mu P,   slip of the step's end != 0: T = -mu P sign(slip)
//
// p' the mean of the rates at the step's begin and end, w_0 the impulse of the spring and w_1 that
// of the damper for a rate of 1, over the part of the step in which the straight paths to the place
// that is seen, and on from there, are in the wall. Where a touch is, and how fast, is found on
// them: order 2. Explicit in the spring: h < 2 / sqrt(k g_NN) (step_limit.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/most_contacts.h"
#include "native_model/contact/step_contact.h"
#include "native_model/model/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

class StepContacts {
 public:
  // The part of a contact that lives from step to step. Until go_on() it is that of the step
  // before, from then on that of this step.
  struct Kept {
    // Rigid: it lasts on its circle. Compliant: it is in the wall, since its last touch.
    bool closed = false;
    double slip_sign = 0.0;               // sliding: +1, -1; 0: open or sticking
    double normal = 0.0, friction = 0.0;  // N s, of what lasts in the step
    // N s, if the forces at the end of the step acted over the whole step.
    double normal_at_end = 0.0, friction_at_end = 0.0;
    double hunt_crossley = 0.0;  // s/m, a of a compliant contact's last touch
  };
  using State = std::array<Kept, kMaxContacts>;

  // Both must outlive this.
  StepContacts(const StepState& x, LoadKick& loads);

  State now{};
  std::vector<Impact> impacts;  // of the step, in order

  std::size_t count() const { return contacts_.size(); }
  bool exists() const { return exists_; }
  bool is_rigid(std::size_t i) const { return contacts_[i].rigid; }
  const Model& model() const { return m_; }
  const ContactParameters& law(std::size_t i) const { return *m_.auxiliary[i].contact; }
  // (ddot, spin) of velocities.
  Eigen::Vector3d rates(std::size_t i, const double* v) const;
  // m, ring's to rotor's centre at the coordinates that the step sees.
  Eigen::Vector2d place(std::size_t i) const { return {contacts_[i].d.x, contacts_[i].d.y}; }
  // A rigid contact lasts.
  bool lasts() const;

  // The step's beginning.
  void forget_last();
  // A state has been written: what stands on its circle and does not close is lasting contact, and
  // what is in a wall was loaded there, not struck.
  void begin(const StepState& x);
  // go_on() may get x.free without what is iterated: the one lasting contact iterates it anyway.
  bool settles() const { return count() == 1 && contacts_[0].rigid && now[0].closed; }

  // x.after from x.free with the impulses of all that last. A status of x where the laws have no
  // solution.
  void go_on(StepState& x, bool unsettled = false);
  // After it: whether a path of the step with x.after leaves its circle out of flight.
  bool leave_flight(const StepState& x) const;
  // x.free with the forces of the last step's end, by the normals of now.
  void hold_on(StepState& x);

  // A step is taken in two parts where a load jumps in it: `first` holds for `share` of it, and the
  // part taken last for `rest`. Parts are alike if contact goes on in them as before the step.
  bool alike(const State& part, const State& was) const;
  State second_part(const State& was, const State& first) const;
  void join_parts(double share, double rest, const State& first);
  // Such a step counts as one if its mean loads may act throughout.
  void go_on_as(const State& mean);

  // x.after is about to be changed by impacts.
  void keep_end(const StepState& x) { without_impacts_ = x.after; }
  // `listed`: among `impacts`, and not in the impulses alone.
  void note_impact(const Impact& impact, bool listed = true);
  // Contact lasts from here on, or does not.
  void set_closed(std::size_t i, bool closed);
  // to += A^-1 J^T of impulses of a contact, with the normal of the step.
  void push(std::size_t i, double normal, double friction, double* to) const;

  // The numbers that outlive a step: first those that stand before the state in a saved memory,
  // then all others.
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

  // Velocities at the step's end as they would be without its impacts.
  const double* end_without_impacts(const StepState& x) const {
    return impacted_ ? without_impacts_.data() : x.after.data();
  }
  // What the step did.
  void tell(FixedStep& out) const;
  // J, on the coordinates: of what lasted, from velocities x.start to the end without impacts.
  double lasting_work(const StepState& x) const;

 private:
  using Pair = equations::Pair;
  using List = ContactList<std::size_t>;

  struct Contact {
    const AuxiliaryBearing* at = nullptr;
    bool rigid = true;   // also where there is no contact
    bool flies = false;  // rigid, and it did not last before the step
    double clearance = 0.0, radius = 0.0;
    // mu. Where it depends on the slip not a number, with which nothing slides on.
    double friction = 0.0;
    // What a load (x, y, torque about z) does to the velocities: the columns A^-1 J^T. Where a free
    // spin is coupled with bending (velocity_matrix.h) they are A_0^-1 J^T, and what A^-1 J^T has
    // beside them changes from step to step.
    std::array<StepState::Coordinates, 3> column;
    std::array<VelocityMatrix::Coupled, 3> coupled{};
    // Of the step: m, ring's to rotor's centre; outward normal; m/s, of x.free; the slip's sign
    // before the step, and before the part of it that is being taken.
    Pair d{0.0, 0.0}, e_r{1.0, 0.0}, free{0.0, 0.0};
    double last_sign = 0.0, sign_before = 0.0;
    // Of a compliant one: (ddot, spin) of x.start and x.free; w_0 (N s), w_1 (N s^2/m).
    Eigen::Vector3d start_rates{0.0, 0.0, 0.0}, free_rates{0.0, 0.0, 0.0};
    double spring = 0.0, damper = 0.0;
  };

  const Eigen::Matrix3d& admittance(std::size_t i, std::size_t j) const {
    return admittance_[i * count() + j];
  }
  void couple();
  // to = from + A^-1 J^T of impulses of a contact.
  void add_response(std::size_t i, double normal, double friction, const double* from,
                    double* to) const;
  void look(const StepState& x);
  void look_at_free(const StepState& x);
  // To the place that the step sees; where that is the middle it stays.
  static void turn_normal(Contact& c) {
    const double delta = std::sqrt(c.d.x * c.d.x + c.d.y * c.d.y);
    if (delta > kNoNormal) c.e_r = {c.d.x / delta, c.d.y / delta};
  }
  bool leaves(const Contact& c, const Pair& velocity) const;
  void find_lasting(StepState& x, bool unsettled);
  void press_on(StepState& x);
  bool find_impulses(StepState& x);
  bool slide_on(std::size_t i, const double* free);
  bool solve_lasting(StepState& x);
  // The rates of a contact by the impulses of others.
  Eigen::Vector3d rates_by(std::size_t i, const List& others) const;
  void note_lasting();

  // Compliant contacts: compliant_contacts.cc.
  bool find_touches(StepState& x);
  void meet_wall(std::size_t i, const Eigen::Vector3d& free);
  bool press(StepState& x);
  void press_one(std::size_t i, const Eigen::Vector3d& end);
  void find_impulses(std::size_t i, const Eigen::Vector2d& before, const Eigen::Vector2d& after,
                     const Delassus& g);

  const Model& m_;
  LoadKick& loads_;
  double h_;
  bool exists_ = false, gives_ = false;
  std::vector<Contact> contacts_;
  std::vector<Eigen::Matrix3d> uncoupled_, admittance_;  // blocks, of each contact by each
  double before_ = 0.0, after_ = 0.0;                    // s, of the step, of the place it sees
  // Of the step: the rigid contacts that last and the compliant ones in their walls; whether any
  // contact acts; whether there were impacts; whether done_ has anything.
  List lasting_, pressing_;
  bool acts_ = false, impacted_ = false, did_ = false;
  std::vector<ContactStep> done_;
  StepState::Coordinates without_impacts_;  // velocities at the step's end
};

}  // namespace rotorub
