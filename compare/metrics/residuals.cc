#include "compare/metrics/residuals.h"

#include <algorithm>
#include <cmath>

#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

double mean_contact_force(const std::vector<double>& force) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const double f : force) {
    if (f <= 0.0) continue;
    sum += f;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 1.0;
}

double largest_magnitude(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double v : values) largest = std::max(largest, std::abs(v));
  return largest;
}

void raise(double& residual, double violation) { residual = std::max(residual, violation); }

}  // namespace

Residuals contact_residuals(const Trajectory& trajectory, const ContactFacts& facts,
                            std::size_t contact) {
  const auto points = relative_motion(trajectory, contact);
  const auto column = [&](const char* name) -> const std::vector<double>& {
    return trajectory.column(column_of_contact(contact, name));
  };
  const auto &gap_column = column("gap"), &slip = column("slip");
  const auto &normal = column("normal_force"), &friction = column("friction_force");

  Residuals r;
  r.force_scale = mean_contact_force(normal);
  const double F = r.force_scale;
  const double v = std::max(largest_magnitude(slip), 1e-300);

  auto impact = trajectory.impacts.begin();
  const auto within_impact = [&](double t) {
    const double duration = facts.impact_time * (1.0 + 1e-9);
    while (impact != trajectory.impacts.end() && impact->t + duration < t) ++impact;
    return facts.impact_time > 0.0 && impact != trajectory.impacts.end() && impact->t <= t;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double gap = facts.clearance - points[i].delta;
    const double compressive = std::max(0.0, normal[i]);
    raise(r.gap_error, std::abs(gap_column[i] - gap) / facts.clearance);

    // Normal law (13): g_N >= 0, lambda_N >= 0, g_N lambda_N = 0.
    if (!facts.is_compliant) raise(r.penetration, -gap / facts.clearance);
    raise(r.adhesion, -normal[i] / F);

    // Coulomb: |lambda_T| <= mu lambda_N; sliding: lambda_T = -mu lambda_N sign(gdot_T). For a
    // fixed step that begins or ends with sticking, the largest mu up to its slip is used.
    raise(r.cone, (std::abs(friction[i]) - facts.friction.bound(slip[i]) * compressive) / F);
    if (within_impact(points[i].t)) continue;
    raise(r.complementarity, std::max(0.0, gap) * compressive / (facts.clearance * F));
    raise(r.power, friction[i] * slip[i] / (F * v));
    if (compressive > 0.0 && std::abs(slip[i]) > kSlipThreshold * v) {
      const double mu = facts.friction.at(slip[i]);
      const double due = -mu * compressive * (slip[i] > 0.0 ? 1.0 : -1.0);
      raise(r.sliding, std::abs(friction[i] - due) / F);
    }
  }
  return r;
}

Residuals largest_residuals(const Trajectory& trajectory,
                            const std::vector<ContactFacts>& contacts) {
  Residuals largest;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const Residuals r = contact_residuals(trajectory, contacts[k], k);
    for (const auto part : {&Residuals::force_scale, &Residuals::penetration, &Residuals::adhesion,
                            &Residuals::complementarity, &Residuals::cone, &Residuals::sliding,
                            &Residuals::power, &Residuals::gap_error}) {
      raise(largest.*part, r.*part);
    }
  }
  return largest;
}

}  // namespace rotorub
