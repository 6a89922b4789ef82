#include "native_model/contact/located_impact.h"

#include <algorithm>
#include <cmath>

namespace rotorub {

double circle_exit(const Eigen::Vector2d& d, const Eigen::Vector2d& path, double clearance) {
  const double a = path.squaredNorm(), b = d.dot(path);
  const double c = d.squaredNorm() - clearance * clearance;
  if (c >= 0.0 && b > 0.0) return 0.0;
  const double square = b * b - a * c;
  if (a == 0.0 || square < 0.0) return 2.0;
  const double root = std::sqrt(square);
  // The greater root, without cancellation.
  return b > 0.0 ? -c / (b + root) : (root - b) / a;
}

StepImpacts locate_impacts(const FlightStep& s, const ImpactLaw& law) {
  StepImpacts out;
  Eigen::Vector2d d = s.d;
  Eigen::Vector3d velocity = s.velocity;
  double theta = 0.0;
  while (out.count < StepImpacts::kMost) {
    const Eigen::Vector2d path = (1.0 - theta) * s.h * velocity.head<2>();
    if ((d + path).norm() <= s.clearance) break;
    const double share = circle_exit(d, path, s.clearance);
    if (share > 1.0) {
      out.closes = d.norm() >= s.clearance;  // it never comes inside: no flight
      break;
    }
    d += share * path;
    theta += share * (1.0 - theta);

    LocatedImpact& hit = out.impacts[static_cast<std::size_t>(out.count)];
    hit.theta = theta;
    hit.e_r = d.normalized();
    const Eigen::Vector2d e_t{-hit.e_r.y(), hit.e_r.x()};
    const Eigen::Vector3d v = velocity + (theta - 0.5) * s.h * s.acceleration;
    hit.gap_rate_before = -hit.e_r.dot(v.head<2>());
    hit.slip_before = e_t.dot(v.head<2>()) + s.radius * v.z();
    if (hit.gap_rate_before >= 0.0) {  // a touch
      out.closes = true;
      break;
    }
    // -gddot_N; the flight after the impact takes 2 eps |gdot_N| / that.
    const double whirl = e_t.dot(v.head<2>());
    const double pressed =
        hit.e_r.dot(s.acceleration.head<2>()) + whirl * whirl / s.clearance;
    const bool last = out.count + 1 == StepImpacts::kMost;
    const bool stays =
        2.0 * law.restitution * -hit.gap_rate_before <= pressed * std::max(s.h, s.duration) || last;
    if (s.duration > 0.0 && !stays) {
      ++out.count;
      out.takes_time = true;
      return out;
    }
    ImpactLaw own = law;
    if (stays) own.restitution = own.tangential_restitution = 0.0;
    hit.law = solve_impact(delassus(s.admittance, hit.e_r, s.radius), hit.gap_rate_before,
                           hit.slip_before, own);
    ++out.count;
    out.status = hit.law.status;
    if (out.status != Status::kOk) return out;
    velocity +=
        s.admittance * contact_load(hit.e_r, s.radius, hit.law.normal(), hit.law.friction());
    if (stays) {
      out.closes = true;
      break;
    }
  }
  return out;
}

}  // namespace rotorub
