#include "native_model/periodic/essential_state.h"

#include <algorithm>
#include <cmath>

#include "native_model/event/smooth_system.h"
#include "native_model/model/control_states.h"

namespace rotorub::periodic {
namespace {

constexpr double kLeastDisplacement = 1e-6;  // m, for a model without a contact
constexpr double kLeastSpeed = 1e-9;         // m/s and rad/s, for a motion that is at rest

// The derivative of `states` (indices in v) after the next sample of bearing k by `entries` of y.
Eigen::MatrixXd slopes_of_sample(const Model& m, std::size_t k, double t,
                                 const std::vector<double>& y, const std::vector<int>& states,
                                 const std::vector<int>& entries, const Eigen::VectorXd& sizes) {
  constexpr double kShare = 1e-3;
  const double sample_time = m.auxiliary[k].sample_time;
  const double next = (std::floor(t / sample_time) + 1.0) * sample_time;
  const auto after = [&](int moved, double by) {
    std::vector<double> at = y;
    at[static_cast<std::size_t>(moved)] += by;
    take_control_sample(m, k, next, at.data(), at.data() + m.nq());
    Eigen::VectorXd all(static_cast<Eigen::Index>(states.size()));
    for (std::size_t i = 0; i < states.size(); ++i) {
      all[static_cast<Eigen::Index>(i)] = at[static_cast<std::size_t>(m.nq() + states[i])];
    }
    return all;
  };
  const Eigen::VectorXd unmoved = after(0, 0.0);
  Eigen::MatrixXd slopes(unmoved.size(), static_cast<Eigen::Index>(entries.size()));
  for (std::size_t j = 0; j < entries.size(); ++j) {
    const double by = kShare * sizes[entries[j]];
    slopes.col(static_cast<Eigen::Index>(j)) = (after(entries[j], by) - unmoved) / by;
  }
  return slopes;
}

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
  for (int i = 0; i < l.control_state(); ++i) entries_.push_back(l.nq() + i);
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    for (const int i : returning_control_states(m, k)) entries_.push_back(l.nq() + i);
  }
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
  Eigen::VectorXd memory = Eigen::VectorXd::Constant(l.control_states, kInfinity);
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    for (const int i : returning_control_states(m, k)) memory[i - l.control_state()] = size[n + i];
  }
  size.tail(l.control_states) = memory;
  return size;
}

void EssentialState::widen_control_states(const Model& m, double t, const std::vector<double>& y,
                                          Eigen::VectorXd& sizes) {
  const EssentialState essential(m);
  const int n = m.nq(), first_memory = n + m.layout.control_state();
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const std::vector<int> states = returning_control_states(m, k);
    if (states.empty()) continue;
    const Eigen::MatrixXd slopes = slopes_of_sample(m, k, t, y, states, essential.entries(), sizes);
    // How far each state of the memory moves: by the machine's states at first, then by states of
    // the memory whose own movement is known.
    Eigen::VectorXd response = Eigen::VectorXd::Zero(sizes.size());
    for (const int j : essential.entries()) {
      if (j < first_memory) response[j] = sizes[j];
    }
    for (bool is_more = true; is_more;) {
      is_more = false;
      const Eigen::VectorXd before = response;
      for (std::size_t i = 0; i < states.size(); ++i) {
        const int state = n + states[i];
        if (before[state] > 0.0) continue;
        for (std::size_t j = 0; j < essential.entries().size(); ++j) {
          const double slope = slopes(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          response[state] =
              std::max(response[state], std::abs(slope) * before[essential.entries()[j]]);
        }
        is_more = is_more || response[state] > 0.0;
      }
    }
    for (const int i : states) {
      const double least = response[n + i] > 0.0 ? response[n + i] : 1.0;
      sizes[n + i] = std::max(sizes[n + i], least);
    }
  }
}

}  // namespace rotorub::periodic
