// One step of `verlet` with several contacts: the leapfrog of verlet_step.h, with lasting contact
// and impacts of all contacts solved together (contact/coupled_law.h). For one run; a scene with
// one contact has its own kernels.
//
//   1. Free velocities v_f from all loads, as there.
//   2. Contacts that last end the step on their circles: step impulses p with |d_i + h (w_i + sum
//   A_ij p_j)| = delta_i,
//      by Newton's method on the linear complementarity problem of all of them, friction by the
//      slip of the middle.
//   3. Another contact's path leaves its circle: located, and every contact that is closed there
//   takes part in the
//      impact. Of its jump w at the share theta this step takes (1 - theta) w, the next the rest,
//      and what the loads that depend on velocities miss. A resting contact that it knocks open
//      carries nothing from there on: the next step gives back (1/2 - theta) of its step impulse.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "native_model/contact/coupled_law.h"
#include "native_model/stepping/load_kernel.h"

namespace rotorub {

class CoupledVerlet : private LoadKernel<Model> {
 public:
  // From the model's initial state. The model must outlive it. step: s, > 0.
  CoupledVerlet(const Model& model, double step);

  // What step k did at one contact.
  struct Lasting {
    Mode mode = Mode::kFree;
    bool reversed = false;                // the slip changed its sign without sticking
    double normal = 0.0, friction = 0.0;  // N s, of lasting contact over the step
  };
  struct Result {
    Status status = Status::kOk;
    std::span<const Lasting> contacts;  // until the next call, as the impacts
    std::span<const Impact> impacts;    // in order
    double lasting_work = 0.0;          // J, on the coordinates, of lasting contact
    double impact_work = 0.0;           // J, of the impacts
    double external_work = 0.0;         // J, of all forces but springs and contact
  };
  // From t_k to t_{k+1}, k from 0 on. forces: of the actuators on each ring, N.
  Result step(std::int64_t k, std::span<const Eigen::Vector2d> forces);

  using LoadKernel<Model>::q;  // of t_{k+1}
  const double* v_half() const { return v_.data(); }
  // Before step k: the velocities of t_k under the forces of the step before.
  void velocity_now(std::int64_t k, double* v);
  // After step k: the state of t_k, velocities before an impact of the step.
  const double* last_q() const { return before_.data(); }
  void last_velocity(double* v) const;
  double last_kick() const {
    return was_first_ ? 0.5 : 1.0;
  }  // of a step, for which its forces are

 private:
  using Columns = std::vector<double>;  // nq values for each of 3 directions of each contact
  struct Contact {
    ContactParameters law;
    bool lasts = false, was_lasting = false;
    double slip_sign = 0.0;
    Eigen::Vector2d d{0.0, 0.0}, e_r{1.0, 0.0};  // m, at the step's begin
    Eigen::Vector3d free, start;                 // (ddot, spin) of free_ and start_
    double normal = 0.0, friction = 0.0;         // N s, of lasting contact over the step
  };
  // How the friction of a lasting contact is found: by the slip (Coulomb's set), or in a ratio to
  // the normal impulse.
  struct Friction {
    double bound = 0.0;  // mu, of the slip before the step
    bool given = false;
    double ratio = 0.0;
  };

  static constexpr double kOnCircle = 1e-12;  // of the clearance: as good as on it

  Eigen::Vector3d rates(std::size_t contact, const double* v) const;  // (ddot, spin)
  static double slip_of(const Eigen::Vector2d& e_r, double radius, const Eigen::Vector3d& velocity);

  void kick(std::int64_t k);
  void apply_forces(std::span<const Eigen::Vector2d> forces);
  void respond();
  void place();
  bool leaves(const Contact& c, const Eigen::Vector3d& velocity) const;
  void last();
  bool press(std::span<const std::size_t> lasting);
  CoupledSolution solve_on_circles(std::span<const std::size_t> lasting,
                                   std::span<const Friction> friction) const;
  void push(double* to) const;
  // coupled_impacts.cc
  void collide(std::int64_t k);
  std::span<const Eigen::Vector2d> ring_forces(double t, const double* q, const double* v,
                                               std::span<Eigen::Vector2d> forces) const;
  void apply_jump(double t, double theta, const double* q, std::span<double> load,
                  std::span<double> velocity, std::span<const double> acceleration);
  double held() const {
    return layout().spin ? 0.0 : m_->speed;
  }  // rad/s, by a machine that works too
  double lasting_work() const;
  double impact_work() const;
  Eigen::Matrix3d admittance(std::size_t i, std::size_t j) const;

  std::vector<Contact> contacts_;
  std::vector<Columns> response_;  // A^-1 J^T, three columns of each contact
  std::vector<double> applied_, after_, before_, late_, free_end_;
  std::vector<Lasting> done_;
  std::vector<Impact> hits_;
  bool first_ = true, was_first_ = true;
  double late_work_ = 0.0;
};

}  // namespace rotorub
