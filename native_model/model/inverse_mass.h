// M^-1 at an instant. With a free spin, eccentric discs couple spin and bending. With D the
// diagonal of M, J the spin's entry of D, and b the bending rows of M in the column of the spin
// (equations::spin_coupling),
//
//   M = D + b e_phi^T + e_phi b^T,   M^-1 = D_0^-1 + w w^T / s,   w = (-D^-1 b, 1),
//   s = J - b^T D^-1 b,
//
// where D_0^-1 is D^-1 with 0 at the spin (Sherman and Morrison's formula). Without coupling,
// M^-1 = D^-1.
#pragma once

#include <Eigen/Core>

#include "native_model/model/equations.h"
#include "native_model/model/model.h"

namespace rotorub {

class InverseMass {
 public:
  // The model must outlive this object. diagonal: nq values that replace the masses, e.g.
  // M + h/2 D.
  explicit InverseMass(const Model& model) : InverseMass(model, model.mass.data()) {}
  InverseMass(const Model& model, const double* diagonal);
  // Also couples the spin at (t, q) if the model has eccentric discs on a free spin.
  InverseMass(const Model& model, const double* diagonal, double t, const double* q);

  // Sets the directions of the discs. Does nothing if no disc is coupled.
  void couple(const equations::DiscAngles& at);

  // a = M^-1 f, nq values; f and a may be the same array.
  void solve(const double* f, double* a) const;
  // a += M^-1 J^T p for a load p (x, y, torque about z) at a contact. coupling:
  // coupling_at(contact).
  void add_response(std::size_t contact, const Eigen::Vector3d& coupling, const Eigen::Vector3d& p,
                    double* a) const;

  // J_i M^-1 J_j^T of two contacts, its part without the coupling, and the coupling vector J w of
  // one contact; the last function combines them for one contact.
  Eigen::Matrix3d admittance(std::size_t i, std::size_t j) const;
  Eigen::Matrix3d uncoupled_admittance(std::size_t i, std::size_t j) const;
  Eigen::Vector3d coupling_at(std::size_t contact) const;  // 0 if nothing is coupled
  Eigen::Matrix3d admittance(const Eigen::Matrix3d& uncoupled,
                             const Eigen::Vector3d& coupling) const {
    if (!model_->coupled_mass()) return uncoupled;
    return uncoupled + coupling * coupling.transpose() * spin_;
  }

 private:
  const Model* model_;
  double inverse_[kMaxCoordinates];  // of the diagonal; 0 at a coupled spin
  double w_[kMaxCoordinates];        // bending part of w
  double inertia_ = 0.0;             // kg m^2, J
  double spin_ = 0.0;                // 1/(kg m^2), 1 / s
};

}  // namespace rotorub
