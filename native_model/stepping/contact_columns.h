// What a fixed step of one run knows of several contacts, whatever their law: where they are, how
// fast, and what their impulses do to the coordinates.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/most_contacts.h"
#include "native_model/model/dynamics.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

class ContactColumns {
 public:
  using Columns = StepState::Coordinates;  // nq values

  static constexpr double kNoSlip = 1e-10;  // of the surface's speed: a slip that counts as 0

  struct Place {                                 // of a contact as the step sees it
    Eigen::Vector2d d{0.0, 0.0}, e_r{1.0, 0.0};  // m
    Eigen::Vector3d free{0.0, 0.0, 0.0},
        start{0.0, 0.0, 0.0};  // (ddot, spin) of x.free and x.start
  };

  ContactColumns(const StepState& x, LoadKick& loads);

  std::array<Place, kMaxContacts> places{};
  // What the step did at each contact.
  std::vector<ContactStep> done;

  static constexpr bool exists() { return true; }
  static constexpr bool settles() { return false; }  // go_on() wants x.free settled
  std::size_t count() const { return done.size(); }
  const Model& model() const { return m_; }
  const ContactParameters& law(std::size_t i) const { return *m_.auxiliary[i].contact; }
  double slip_sign() const { return 0.0; }                       // each its own
  Eigen::Vector3d rates(std::size_t i, const double* v) const {  // (ddot, spin)
    return contact_rates(m_, v, i);
  }
  // to += A^-1 J^T p, p the impulses of a contact.
  void push(std::size_t i, double normal, double friction, std::span<double> to) const;

  // Nobody keeps the memory of several.
  template <class Action>
  void for_each_kept(Action&) {}
  template <class Action>
  void for_each_force_kept(Action&) {}

 protected:
  // Of the step's beginning, at the coordinates that it sees.
  void look(const StepState& x);
  // The columns A^-1 J^T of every contact.
  void respond(LoadKick& loads);
  Eigen::Matrix3d admittance(std::size_t i, std::size_t j) const;
  double slip(std::size_t i, const Eigen::Vector3d& velocity) const {
    return rates_along(places[i].e_r, law(i).radius, velocity).y();
  }
  // J, of what lasted over the step, with the velocities at its end.
  double work_of_lasting(const double* end) const;

  const Model& m_;
  double h_;

 private:
  // A^-1 J^T, three columns of each contact; where spin and bending are coupled A_0^-1 J^T too.
  std::vector<Columns> response_, uncoupled_;
};

}  // namespace rotorub
