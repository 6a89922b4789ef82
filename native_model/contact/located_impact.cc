#include "native_model/contact/located_impact.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/circle.h"
#include "native_model/contact/rebound.h"

namespace rotorub {

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
    const Eigen::Vector3d v = velocity + (theta - 0.5) * s.h * s.acceleration;
    const Eigen::Vector2d rates = rates_along(hit.e_r, s.radius, v);
    hit.gap_rate_before = rates.x();
    hit.slip_before = rates.y();
    if (hit.gap_rate_before >= 0.0) {  // a touch
      out.closes = true;
      break;
    }
    const bool last = out.count + 1 == StepImpacts::kMost;
    const double pressed = pressing(hit.e_r, v, s.acceleration, s.clearance);
    const bool stays = last || !flight_outlives(std::max(s.h, s.duration),
                                                -law.restitution * hit.gap_rate_before, pressed);
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
