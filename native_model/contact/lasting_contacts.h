// Lasting contacts over one fixed step, solved on positions. The normal and friction impulses of
// the step, along the normals e_r, are those for which each relative centre ends exactly on its
// circle,
//
//   |d_i + h (w_i + sum_j A_ij p_j)| = delta_i,   N_i >= 0,   p_j = contact_load(N_j, T_j).
//
// Friction is set-valued in the slip at the middle of the step, and its mu depends on the same
// slip. If the slip reverses within the step, T is the mean of its two values, weighted by the
// times for which they hold, so that a reversal does not lower the order.
//
// One contact is a quadratic equation in N, with T in a fixed ratio to N (sliding) or from a slip
// of 0 (sticking). If friction could outweigh the normal row (mu |a_nt| >= a_nn), or if no such
// point of the circle is in reach, (12), (13) with the linearised gap decide. Several contacts are
// solved by Newton's method. The first attempt continues the state of the step before, in which
// each contact slides or sticks. If it fails, the linear complementarity problem of all contacts is
// solved (coupled_problem.h).
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "native_model/contact/contact_parameters.h"
#include "native_model/contact/kinematics.h"
#include "native_model/numerics/status.h"

namespace rotorub {

// One lasting contact, with its solution.
struct LastingContact {
  Eigen::Vector2d d{0.0, 0.0};  // m, from the ring's to the rotor's centre at the start of the step
  Eigen::Vector2d e_r{1.0, 0.0};  // outward normal
  // (m/s, m/s, rad/s), rates (relative x, relative y, contact spin): at the start of the kick, and
  // at its end without the contacts of this list.
  Eigen::Vector3d start{0.0, 0.0, 0.0}, free{0.0, 0.0, 0.0};
  double clearance = 0.0, radius = 0.0;  // m
  FrictionLaw friction{};
  // Input, from the step before: direction of the slip, +1 or -1; 0 if it stuck or did not last.
  // Output: direction in this step.
  double slip_sign = 0.0;
  // N s, normal (>= 0) and friction on the rotor along e_t. Input: a guess, from which several
  // contacts are solved faster; output: the solution.
  double normal_impulse = 0.0, friction_impulse = 0.0;
};

// A_ij = J_i (M + h D/2)^-1 J_j^T, the change of the rates of contact i by an impulse on contact j,
// 1/kg and 1/(kg m^2), for the contacts of a list.
struct ContactAdmittance {
  const Eigen::Matrix3d* blocks;       // of all pairs of the model's contacts, row by row
  std::size_t total;                   // number of the model's contacts
  std::span<const std::size_t> index;  // of each contact of the list among the model's contacts
  const Eigen::Matrix3d& operator()(std::size_t i, std::size_t j) const {
    return blocks[index[i] * total + index[j]];
  }
};

// Slips below this share of the speed of the rotor's surface count as 0.
inline constexpr double kNoSlip = 1e-10;

// m/s, slip of a contact for the rates (ddot, contact spin).
inline double slip_of(const LastingContact& c, const Eigen::Vector3d& rates) {
  return rates_along(c.e_r, c.radius, rates).y();
}

// m/s, slip before the step; round-off of the surface speed counts as 0.
inline double slip_before(const LastingContact& c) {
  const double slip = slip_of(c, c.start);
  return std::abs(slip) <= kNoSlip * c.radius * std::abs(c.start.z()) ? 0.0 : slip;
}

// Finds the impulses and the slip signs of the contacts and stores them in the contacts. h: s. The
// path of a single contact must end outside the circle. Returns kNoSolution or kAmbiguous in
// Painleve's cases. With several contacts it returns kStepTooLarge if one whirls so far within the
// step that the normals have no unique solution, whatever the law.
Status solve_lasting_contacts(double h, std::span<LastingContact> contacts,
                              const ContactAdmittance& admittance);

}  // namespace rotorub
