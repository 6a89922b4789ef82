#include "native_model/periodic/essential_state.h"

#include <algorithm>
#include <cmath>

namespace rotorub::periodic {
namespace {

constexpr double kLeastDisplacement = 1e-6;  // m, for a model without a contact
constexpr double kLeastSpeed = 1e-9;         // m/s and rad/s, for a motion that is at rest

}  // namespace

bool spin_angle_acts(const Model& m) {
  if (!m.layout.spin) return false;
  const auto turns = [](const AppliedForce& f) {
    return f.kind == scene::ForceKind::kSynchronous && f.amplitude != 0.0;
  };
  return !m.unbalances.empty() || m.drive_follows() || std::ranges::any_of(m.forces, turns);
}

EssentialState::EssentialState(const Model& m) {
  const Layout& l = m.layout;
  for (int i = 0; i < l.ring_angle(); ++i) {
    const bool is_spin_angle = l.spin && i == l.phi();
    if (is_spin_angle && !spin_angle_acts(m)) continue;
    if (is_spin_angle) spin_angle_ = static_cast<int>(entries_.size());
    entries_.push_back(i);
  }
  for (int i = 0; i < l.nq(); ++i) entries_.push_back(l.nq() + i);
}

Eigen::VectorXd EssentialState::take(const double* y) const {
  Eigen::VectorXd x(size());
  for (Eigen::Index i = 0; i < size(); ++i) x[i] = y[entries_[static_cast<std::size_t>(i)]];
  return x;
}

Eigen::VectorXd EssentialState::sizes(const Model& m, const std::vector<const double*>& motion) {
  const Layout& l = m.layout;
  const int n = l.nq();
  double displacement = kLeastDisplacement, speed = kLeastSpeed, spin = 1.0;
  for (const AuxiliaryBearing& bearing : m.auxiliary) {
    if (bearing.contact) displacement = std::max(displacement, bearing.contact->clearance);
  }
  Eigen::VectorXd own = Eigen::VectorXd::Zero(2 * n);
  for (const double* y : motion) {
    for (int i = 0; i < 2 * n; ++i) own[i] = std::max(own[i], std::abs(y[i]));
    for (int i = 0; i < l.mechanical(); ++i) {
      if (!l.turns(i)) displacement = std::max(displacement, std::abs(y[i]));
      double& rate = l.turns(i) ? spin : speed;
      rate = std::max(rate, std::abs(y[n + i]));
    }
  }
  Eigen::VectorXd size = Eigen::VectorXd::Ones(2 * n);
  for (int i = 0; i < n; ++i) {
    const bool mechanical = i < l.mechanical();
    if (mechanical) size[i] = l.turns(i) ? 1.0 : displacement;
    size[n + i] = !mechanical ? own[n + i] : l.turns(i) ? spin : speed;
    if (!(size[n + i] > 0.0)) size[n + i] = 1.0;
  }
  return size;
}

}  // namespace rotorub::periodic
