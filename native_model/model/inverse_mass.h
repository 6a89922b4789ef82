// M^-1 at an instant. Eccentric discs on a free spin couple it with bending; with D the diagonal of
// M and b its bending rows in the spin's column (equations::spin_coupling)
//
//   M = D + b e_phi^T + e_phi b^T,   M^-1 = D_0^-1 + w w^T / s,   w = (-D^-1 b, 1),
//   s = J - b^T D^-1 b,
//
// D_0^-1: D^-1 with 0 at the spin (Sherman and Morrison's formula). Without them it is D^-1.
#pragma once

#include <Eigen/Core>

#include "native_model/model/equations.h"
#include "native_model/model/model.h"

namespace rotorub {

class InverseMass {
 public:
  // Both must outlive it. diagonal: in the place of the masses, nq values, e.g. of M + h/2 D.
  explicit InverseMass(const Model& model) : InverseMass(model, model.mass.data()) {}
  InverseMass(const Model& model, const double* diagonal);
  // The same where the spin is coupled, at (t, q).
  InverseMass(const Model& model, const double* diagonal, double t, const double* q);

  // Where the discs point; nothing to do where none are coupled.
  void couple(const equations::DiscAngles& at);

  // a = M^-1 f, nq values; may be in place.
  void solve(const double* f, double* a) const;
  // a += M^-1 J^T p of a load (x, y, torque about z) at a contact. coupling: of that contact.
  void add_response(std::size_t contact, const Eigen::Vector3d& coupling, const Eigen::Vector3d& p,
                    double* a) const;

  // J_i M^-1 J_j^T of two contacts, and of one: without what couples, J w, and with it.
  Eigen::Matrix3d admittance(std::size_t i, std::size_t j) const;
  Eigen::Matrix3d uncoupled_admittance(std::size_t i, std::size_t j) const;
  Eigen::Vector3d coupling_at(std::size_t contact) const;  // 0 where nothing is coupled
  Eigen::Matrix3d admittance(const Eigen::Matrix3d& uncoupled,
                             const Eigen::Vector3d& coupling) const {
    if (!model_->coupled_mass()) return uncoupled;
    return uncoupled + coupling * coupling.transpose() * spin_;
  }

 private:
  const Model* model_;
  double inverse_[kMaxCoordinates];  // of the diagonal; of D_0 where the spin is coupled
  double w_[kMaxCoordinates];        // of bending
  double inertia_ = 0.0;             // kg m^2, J
  double spin_ = 0.0;                // 1/s
};

}  // namespace rotorub
