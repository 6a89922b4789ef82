#include "native_model/model/inverse_mass.h"

namespace rotorub {

namespace eq = equations;

InverseMass::InverseMass(const Model& model, const double* diagonal) : model_(&model) {
  for (int i = 0; i < model.nq(); ++i) inverse_[i] = 1.0 / diagonal[i];
  if (!model.coupled_mass()) return;
  inertia_ = diagonal[model.layout.phi()];
  inverse_[model.layout.phi()] = 0.0;
}

InverseMass::InverseMass(const Model& model, const double* diagonal, double t, const double* q)
    : InverseMass(model, diagonal) {
  if (!model.coupled_mass()) return;
  eq::DiscAngles angles;
  angles.fill(model, t, q);
  couple(angles);
}

void InverseMass::couple(const eq::DiscAngles& at) {
  const Model& m = *model_;
  if (!m.coupled_mass()) return;
  const int n = m.layout.modes;
  double b[kMaxCoordinates];
  eq::spin_coupling(m, at, b, b + n);
  for (int k = 0; k < 2 * n; ++k) w_[k] = -inverse_[k] * b[k];
  spin_ = 1.0 / (inertia_ + sum(2 * n, [&](int k) { return w_[k] * b[k]; }));
}

void InverseMass::solve(const double* f, double* a) const {
  const Layout& l = model_->layout;
  const int nq = l.nq();
  if (!model_->coupled_mass()) {
    for (int i = 0; i < nq; ++i) a[i] = inverse_[i] * f[i];
    return;
  }
  const int bending = 2 * l.modes, phi = l.phi();
  const double torque = f[phi] + sum(bending, [&](int k) { return w_[k] * f[k]; });
  const double turned = torque * spin_;
  for (int i = 0; i < nq; ++i) a[i] = inverse_[i] * f[i];
  for (int k = 0; k < bending; ++k) a[k] += w_[k] * turned;
  a[phi] = turned;
}

void InverseMass::add_response(std::size_t contact, const Eigen::Vector3d& coupling,
                               const Eigen::Vector3d& p, double* a) const {
  const Layout& l = model_->layout;
  const AuxiliaryBearing& at = model_->auxiliary[contact];
  const int n = l.modes;
  const bool coupled = model_->coupled_mass();
  const double *x = at.shape.x.data(), *y = at.shape.y.data();
  for (int k = 0; k < n; ++k) {
    a[k] += inverse_[k] * x[k] * p.x();
    a[n + k] += inverse_[n + k] * y[k] * p.y();
  }
  if (coupled) {
    const double turned = coupling.dot(p) * spin_;
    for (int k = 0; k < 2 * n; ++k) a[k] += w_[k] * turned;
    a[l.phi()] += turned;
  } else if (l.spin) {
    a[l.phi()] += inverse_[l.phi()] * p.z();
  }
  for (int k = 0; k < l.torsion; ++k) {
    a[l.theta() + k] += inverse_[l.theta() + k] * at.torsion_shape[k] * p.z();
  }
  if (at.moves()) {
    a[at.ring] -= inverse_[at.ring] * p.x();
    a[at.ring + 1] -= inverse_[at.ring + 1] * p.y();
  }
  if (at.turns()) a[at.ring_angle] -= inverse_[at.ring_angle] * at.ring_ratio * p.z();
}

Eigen::Matrix3d InverseMass::admittance(std::size_t i, std::size_t j) const {
  const Eigen::Matrix3d a = uncoupled_admittance(i, j);
  if (!model_->coupled_mass()) return a;
  return a + coupling_at(i) * coupling_at(j).transpose() * spin_;
}

Eigen::Matrix3d InverseMass::uncoupled_admittance(std::size_t i, std::size_t j) const {
  const Layout& l = model_->layout;
  const AuxiliaryBearing &one = model_->auxiliary[i], &other = model_->auxiliary[j];
  Eigen::Vector3d a{0.0, 0.0, 0.0};
  for (int k = 0; k < l.modes; ++k) {
    a.x() += one.shape.x[k] * other.shape.x[k] * inverse_[l.x() + k];
    a.y() += one.shape.y[k] * other.shape.y[k] * inverse_[l.y() + k];
  }
  for (int k = 0; k < l.torsion; ++k) {
    a.z() += one.torsion_shape[k] * other.torsion_shape[k] * inverse_[l.theta() + k];
  }
  if (i == j && one.moves()) {
    a.x() += inverse_[one.ring];
    a.y() += inverse_[one.ring + 1];
  }
  if (i == j && one.turns()) a.z() += one.ring_ratio * one.ring_ratio * inverse_[one.ring_angle];
  if (l.spin && !model_->coupled_mass()) a.z() += inverse_[l.phi()];
  return a.asDiagonal();
}

Eigen::Vector3d InverseMass::coupling_at(std::size_t contact) const {
  if (!model_->coupled_mass()) return {0.0, 0.0, 0.0};
  const int n = model_->layout.modes;
  const eq::Pair bent = eq::at_station(n, model_->auxiliary[contact].shape, w_);
  return {bent.x, bent.y, 1.0};
}

}  // namespace rotorub
