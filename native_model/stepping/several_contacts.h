// Several contacts in a fixed step of one run: as one_contact.h, but lasting contacts and impacts
// of all of them are solved together (contact/coupled_law.h).
//
// Contacts that last end the step on their circles: step impulses p with
//   |d_i + h (w_i + sum A_ij p_j)| = delta_i,    A = J (M + h D/2)^-1 J^T,
// by Newton's method on the linear complementarity problem of all of them, friction by the slip of
// the middle of the step. An impact takes with it every contact that is closed there
// (shared_impact.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

class SeveralContacts {
 public:
  using State = StepState<Model>;
  using Loads = LoadKick<Model>;
  using Columns = State::Coordinates;  // nq values

  // Of lasting contact, as in OneContact.
  struct Lasting {
    struct Of {
      bool lasts = false;
      double slip_sign = 0.0;
      double normal = 0.0, friction = 0.0, normal_at_end = 0.0, friction_at_end = 0.0;  // N s
    };
    std::array<Of, kMaxContacts> of{};
  };
  struct Place {                                 // of a contact as the step sees it
    Eigen::Vector2d d{0.0, 0.0}, e_r{1.0, 0.0};  // m
    Eigen::Vector3d free{0.0, 0.0, 0.0},
        start{0.0, 0.0, 0.0};  // (ddot, spin) of x.free and x.start
  };

  SeveralContacts(State& x, Loads& loads, const std::vector<const Model*>& models, bool located);

  Lasting now;
  std::array<Place, kMaxContacts> places{};
  std::vector<Impact> impacts;  // of the step, in order
  // What the step did at each contact.
  std::vector<ContactStep> done;

  static constexpr bool exists() { return true; }
  static constexpr bool held_open = false;  // no impact takes time
  std::size_t count() const { return done.size(); }
  bool lasts() const { return lasted(now) > 0.0; }
  bool located() const { return located_; }
  const Model& model() const { return m_; }
  const ContactParameters& law(std::size_t i) const { return *m_.auxiliary[i].contact; }

  // As OneContact's. go_on: an impact may have come.
  void forget_last();
  void begin(const State& x);
  bool go_on(State& x, Loads& loads);
  void hold_on(State& x, Loads& loads);
  void back_to_circle(State& x, Loads& loads);
  bool alike(const Lasting& part, const Lasting& was) const;
  void join_parts(bool other, double share, double rest, const Lasting& first, const Lasting& mean);
  Lasting second_part(const Lasting& was, const Lasting& first) const;
  double lasted(const Lasting& was) const;
  const double* end_without_impacts(const State& x) const {
    return impacts.empty() ? x.after.data() : without_impacts_.data();
  }
  double slip_sign() const { return 0.0; }  // each its own
  void tell(FixedStep& out, double sign_before) const;
  double lasting_work(const State& x) const;

  // Nobody keeps the memory of several.
  template <class Action>
  void for_each_kept(Action) {}
  template <class Action>
  void for_each_force_kept(Action) {}

  // x.after is about to be changed by impacts.
  void keep_end(const State& x) { without_impacts_ = x.after; }
  // Contact lasts from here on, or does not.
  void set_lasting(std::size_t i, bool lasts) {
    if (now.of[i].lasts != lasts) now.of[i].slip_sign = 0.0;
    now.of[i].lasts = lasts;
  }
  Eigen::Vector3d rates(std::size_t i, const double* v) const;  // (ddot, spin)
  // The straight path of a step with the relative velocity leaves the circle.
  bool leaves(std::size_t i, const Eigen::Vector3d& velocity) const;
  // to += A^-1 J^T p, p the impulses of a contact.
  void push(std::size_t i, double normal, double friction, std::span<double> to) const;

 private:
  // How the friction of a lasting contact is found: by the slip (Coulomb's set), or in a ratio to
  // the normal impulse.
  struct Friction {
    double bound = 0.0;  // mu
    bool given = false;
    double ratio = 0.0;
  };
  double slip(std::size_t i, const Eigen::Vector3d& velocity) const {
    return rates_along(places[i].e_r, law(i).radius, velocity).y();
  }
  void respond(const State& x, Loads& loads);
  Eigen::Matrix3d admittance(std::size_t i, std::size_t j) const;
  bool press(State& x, std::span<const std::size_t> lasting);
  CoupledSolution solve_on_circles(std::span<const std::size_t> lasting,
                                   std::span<const Friction> friction) const;
  void note_lasting();

  const Model& m_;
  double h_;
  bool located_;
  std::vector<Columns> response_;                 // A^-1 J^T, three columns of each contact
  Columns without_impacts_;                       // velocities at the step's end
  std::array<double, kMaxContacts> last_sign_{};  // of the slip, before the step
};

}  // namespace rotorub
