#include "native_model/stepping/step_limit.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "native_model/model/dynamics.h"
#include "native_model/model/sampled_feedback.h"

namespace rotorub {
namespace {

// s, the positive root of h^2 k + 4 h d = 4, with k and d divided by the mass: 1/s^2 and 1/s. (At
// the limit by d alone, a velocity that the command sees half a step late changes its sign in each
// step.)
double limit_of(double k, double d) {
  if (k <= 0.0 && d <= 0.0) return std::numeric_limits<double>::infinity();
  return 4.0 / (2.0 * d + 2.0 * std::sqrt(d * d + std::max(0.0, k)));
}

// 1/s^2, upper bound of k/m in a plane of bending, including springs and films at stations.
double bending(const Model& m, int plane) {
  const Layout& l = m.layout;
  const int at = plane == 0 ? l.x() : l.y();
  const auto mass = m.mass.segment(at, l.modes);
  double most = m.stiffness.segment(at, l.modes).cwiseQuotient(mass).maxCoeff();
  for (const StationSpring& s : m.springs) {
    const Eigen::VectorXd& shape = plane == 0 ? s.shape.x : s.shape.y;
    most += std::max(0.0, s.stiffness[plane]) * shape.cwiseAbs2().cwiseQuotient(mass).sum();
  }
  for (const StationFilm& film : m.films) {
    const Eigen::VectorXd &shape = plane == 0 ? film.shape.x : film.shape.y,
                          &other = plane == 0 ? film.shape.y : film.shape.x;
    const BearingCoefficients c = largest(film.law);
    // The rows of this plane contain stiffness terms of both planes. The damping of films is in the
    // step's matrix and does not count.
    const auto row = shape.cwiseAbs().cwiseQuotient(mass);
    const double own = plane == 0 ? c[0] : c[3], cross = plane == 0 ? c[1] : c[2];
    most += row.maxCoeff() * (own * shape.cwiseAbs().sum() + cross * other.cwiseAbs().sum());
  }
  if (!m.internal_xy.absent()) {
    const Eigen::MatrixXd turning = m.internal_xy.dense(l.modes).cwiseAbs();
    const double speed = std::max(std::abs(m.speed), m.drive ? std::abs(m.drive->target()) : 0.0);
    most += speed * (mass.cwiseInverse().asDiagonal() * turning).rowwise().sum().maxCoeff();
  }
  return most;
}

// b' D^-1 b / J of the eccentric discs with a free spin, which gives M >= (1 - sqrt(b' D^-1 b / J))
// diag(M).
double coupling(const Model& m) {
  if (!m.coupled_mass()) return 0.0;
  Eigen::VectorXd unit = Eigen::VectorXd::Unit(m.nq(), m.layout.phi()), solved(m.nq());
  double most = 0.0;
  for (const DiscUnbalance& u : m.unbalances) {
    // At the instant at which the unbalance appears. e' M^-1 e = 1 / (J - b' D^-1 b).
    solve_mass(m, std::max(0.0, u.on), m.q0.data(), unit.data(), solved.data());
    most = std::max(most, 1.0 - 1.0 / (solved[m.layout.phi()] * m.mass[m.layout.phi()]));
  }
  return std::clamp(most, 0.0, 1.0);
}

}  // namespace

StepLimit step_limit(const Model& m) {
  const Layout& l = m.layout;
  StepLimit limit{std::numeric_limits<double>::infinity(), "nothing"};
  const auto take = [&](double k, double d, const char* of) {
    const double step = limit_of(k, d);
    if (step < limit.step) limit = {step, of};
  };
  const double lightest = 1.0 - std::sqrt(coupling(m));
  for (int plane = 0; plane < 2; ++plane) {
    take(bending(m, plane) / lightest, 0.0, "the stiffest bending mode");
  }
  for (int k = 0; k < l.torsion; ++k) {
    const int i = l.theta() + k;
    take(m.stiffness[i] / m.mass[i], 0.0, "the stiffest torsion mode");
  }
  if (m.drive) {
    // The integrator of the drive acts on the motor's angle as a spring.
    double mobility = 1.0 / m.mass[l.phi()];
    for (int k = 0; k < l.torsion; ++k) {
      mobility += m.drive_shape[k] * m.drive_shape[k] / m.mass[l.theta() + k];
    }
    take(m.drive->stiffness() * mobility, 0.0, "the drive's integral_gain");
  }
  for (int k = 0; k < l.stator; ++k) {
    const int i = l.ring() + k;
    take(m.stiffness[i] / m.mass[i], 0.0, "the ring on its spring");
  }
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (!at.controller || !at.moves()) continue;
    // This holds for a sampled law too. A gain that is too large for the step is also too large for
    // the samples, which are at least a step apart.
    const Controller::Gains gains = at.controller->ring_gains();
    for (int i = at.ring; i < at.ring + 2; ++i) {
      take((m.stiffness[i] + gains.stiffness) / m.mass[i], gains.damping / m.mass[i],
           "the controller's gains on the ring");
    }
  }
  for (const StationSupport& s : m.supports) {
    for (int k = 0; k < 2; ++k) {
      const double mass = m.mass[s.ring + k];
      double slope = s.law.dry ? s.law.dry->force / s.law.dry->presliding : 0.0;
      // Rows of M^-1/2 K M^-1/2, whose sums bound the eigenvalues.
      if (s.housing == kAbsent) {
        take((m.stiffness[s.ring + k] + slope) / mass, 0.0, "the ring's dry friction");
        continue;
      }
      slope += s.stiffness[k];
      const double carrier = m.mass[s.housing + k], both = slope / std::sqrt(mass * carrier);
      take(slope / mass + both, 0.0, "the ring in its housing");
      take((m.stiffness[s.housing + k] - s.stiffness[k] + slope) / carrier + both, 0.0,
           "the housing on its spring");
    }
  }
  for (const AuxiliaryBearing& at : m.auxiliary) {
    // For other exponents the stiffness depends on the penetration, and the run checks the step as
    // it goes.
    if (!at.is_compliant() || at.contact->compliance.exponent != 1.0) continue;
    const Eigen::Matrix3d& a = at.admittance;
    // The larger eigenvalue of the 2 x 2 corner.
    const double mobility =
        0.5 * (a(0, 0) + a(1, 1)) + std::hypot(0.5 * (a(0, 0) - a(1, 1)), a(1, 0));
    const CompliantLaw& law = at.contact->compliance;
    take(law.stiffness * mobility / lightest, 0.0, "the contact's stiffness");
    take(law.stiffness * mobility / lightest, law.damping * mobility / lightest,
         "the contact's damping");
  }
  return limit;
}

std::string step_limit_text(double step, const StepLimit& limit) {
  char text[160];
  std::snprintf(text, sizeof text, "step %g s is not below %.4g s, the limit of %s", step,
                limit.step, limit.of);
  return text;
}

std::string step_refusal(const Model& model, double step) {
  const StepLimit limit = step_limit(model);
  return step < limit.step ? sample_refusal(model, step) : step_limit_text(step, limit);
}

}  // namespace rotorub
