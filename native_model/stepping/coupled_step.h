// What the fixed steps of several contacts share, for one run (one contact has kernels of its own):
// lasting contacts and impacts of all of them are solved together (contact/coupled_law.h).
//
// Contacts that last end the step on their circles: step impulses p with
//   |d_i + h (w_i + sum A_ij p_j)| = delta_i,    A = J (M + h D/2)^-1 J^T,
// by Newton's method on the linear complementarity problem of all of them, friction by the slip of
// the middle of the step. An impact takes with it every contact that is closed there.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/impact.h"
#include "native_model/dynamics/constraint.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kernel.h"

namespace rotorub {

class CoupledStep : public FixedStepper, protected LoadKernel<Model> {
 public:
  const double* q() const override { return q_.data(); }
  const double* v() const override { return v_.data(); }

 protected:
  // From the model's initial state. least_flight: in steps; what is knocked open for less stays.
  CoupledStep(const Model& model, double step, double least_flight);

  using Columns = std::vector<double>;  // nq values
  struct Contact {
    ContactParameters law;
    bool lasts = false;
    double slip_sign = 0.0;                      // of lasting contact: sliding +1, -1; 0: sticking
    Eigen::Vector2d d{0.0, 0.0}, e_r{1.0, 0.0};  // m, where the step sees it
    Eigen::Vector3d free, start;                 // (ddot, spin) of free_ and start_
    double normal = 0.0, friction = 0.0;         // N s, of lasting contact over the step
  };

  static constexpr double kOnCircle = 1e-12;  // of the clearance: as good as on it

  Eigen::Vector3d rates(std::size_t contact, const double* v) const;  // (ddot, spin)
  static double slip(const Contact& c, const Eigen::Vector3d& velocity) {
    return rates_along(c.e_r, c.law.radius, velocity).y();
  }
  // Whether the impact at the speed `approach` (m/s) is followed by a flight, contact/impact.h.
  virtual bool rebounds(const Contact& c, double approach, double pressed) const = 0;

  // ------------------------------------------------------------------ lasting contact
  void apply_commands(std::span<const Eigen::Vector2d> u, const double* q);
  void respond();
  void place();
  bool leaves(const Contact& c, const Eigen::Vector3d& velocity) const;
  // after_ from free_ at seen_, with what lasts of the contacts.
  void last();
  void note_lasting(std::size_t contact, double sign);
  // to += A^-1 J^T p of all lasting contacts.
  void push(double* to) const;
  Eigen::Matrix3d admittance(std::size_t i, std::size_t j) const;

  // ------------------------------------------------------------------ one impact (coupled_blow.cc)
  struct Blow {
    std::size_t count = 0;
    double approach = 0.0;  // m/s, the largest
    std::array<ClosedContact, kMaxContacts> of{};
    std::array<bool, kMaxContacts> closed{}, rests{};  // before, and after
    std::array<ImpactLaw, kMaxContacts> laws{};
    std::array<double, kMaxContacts> pressed{};  // m/s^2, contact/impact.h
    ContactVector before = ContactVector(2 * kMaxContacts);
    ContactMatrix g;
    CoupledSolution s;
  };
  // A contact takes part, with the normal e_r and the velocities and accelerations of the instant.
  void join(Blow& blow, std::size_t contact, bool closed, const Eigen::Vector2d& e_r,
            const Columns& velocity, const Columns& acceleration) const;
  // Its impulses, recorded as impacts of the time t; load: on the coordinates. (at, q): where M is
  // taken. `ends`: no contact rebounds. False: the laws have no solution.
  bool strike(Blow& blow, double t, double at, const double* q, bool ends, Columns& load);

  // ------------------------------------------------------------------ the step's end
  // What step k did; the loads' impulse is `share` of a step's, between start_ and `end`.
  FixedStep result(double share, const Columns& end, bool works);
  void move(double dt);

  // rad/s, of a machine that holds the speed and so works too.
  double held() const { return layout().spin ? 0.0 : m_->speed; }

  double least_flight_;
  std::vector<Contact> contacts_;
  std::vector<Columns> response_;  // A^-1 J^T, three columns of each contact
  // Loads of the actuators; velocities at the step's end, and there without impacts; the
  // coordinates that contact and loads see.
  Columns applied_, after_, free_end_, seen_;
  std::vector<ContactStep> done_;
  std::vector<Impact> hits_;
  double late_work_ = 0.0;  // J, of the loads, what the mean of the step's velocities misses

 private:
  // How the friction of a lasting contact is found: by the slip (Coulomb's set), or in a ratio to
  // the normal impulse.
  struct Friction {
    double bound = 0.0;  // mu, of the slip before the step
    bool given = false;
    double ratio = 0.0;
  };
  bool press(std::span<const std::size_t> lasting);
  CoupledSolution solve_on_circles(std::span<const std::size_t> lasting,
                                   std::span<const Friction> friction) const;
  double lasting_work() const;
  double impact_work() const;
};

}  // namespace rotorub
