// Lasting contacts over one fixed step, solved on positions: the step's normal and friction
// impulses, along the normals e_r, for which each relative centre ends exactly on its circle,
//
//   |d_i + h (w_i + sum_j A_ij p_j)| = delta_i,   N_i >= 0,   p_j = contact_load(N_j, T_j).
//
// Friction follows the slip of the middle of the step (set-valued law), and so does its mu. Where
// the slip reverses within the step, T is the mean of its two values by the time that each holds,
// so that a reversal costs no order.
//
// One contact is a quadratic in N, for T in a fixed ratio to it (sliding) or for a slip of 0
// (sticking). Where its friction can carry more than the normal row, and where no such point of the
// circle is in reach, (12), (13) of the linearised gap decide. Several contacts are solved by
// Newton's method: first as they were in the step before (each slides on or goes on sticking), and
// where that does not hold on the linear complementarity problem of all of them (coupled_law.h).
#pragma once

#include <Eigen/Core>
#include <span>

#include "native_model/contact/contact_parameters.h"
#include "native_model/numerics/status.h"

namespace rotorub {

// One of the contacts that last, and its solution.
struct LastingContact {
  Eigen::Vector2d d{0.0, 0.0};    // m, ring's to rotor's centre at the step's begin
  Eigen::Vector2d e_r{1.0, 0.0};  // outward normal: that of d, if the path leads out along it
  // (m/s, m/s, rad/s) of (relative x, relative y, contact spin): before the step, and at its end
  // without the contacts of this list.
  Eigen::Vector3d start{0.0, 0.0, 0.0}, free{0.0, 0.0, 0.0};
  double clearance = 0.0, radius = 0.0;  // m
  FrictionLaw friction{};
  // In: +1, -1: it slid so in the step before; 0: it stuck, or did not last. Out: of this step.
  double slip_sign = 0.0;
  double normal_impulse = 0.0;    // N s, >= 0; out
  double friction_impulse = 0.0;  // N s, on the rotor along e_t; out
};

// A_ij = J_i (M + h D/2)^-1 J_j^T, the rates of contact i by a load on contact j, 1/kg and 1/(kg
// m^2): as blocks of `all` contacts of a model, of which `number` says where each of the list is.
struct ContactAdmittance {
  const Eigen::Matrix3d* blocks;
  std::size_t all;
  std::span<const std::size_t> number;
  const Eigen::Matrix3d& operator()(std::size_t i, std::size_t j) const {
    return blocks[number[i] * all + number[j]];
  }
};

// A slip that counts as 0, as a share of the speed of the rotor's surface.
inline constexpr double kNoSlip = 1e-10;

// h: s. Of one contact: its path ends outside the circle. kNoSolution and kAmbiguous: Painleve's
// cases; kStepTooLarge: a contact turns so far within the step that its normals have no one
// solution, whatever the law.
Status solve_lasting_contacts(double h, std::span<LastingContact> contacts,
                              const ContactAdmittance& admittance);

}  // namespace rotorub
