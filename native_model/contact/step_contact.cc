#include "native_model/contact/step_contact.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"

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

namespace {

class Solver {
 public:
  explicit Solver(const LastingStep& s)
      : s_(s),
        e_(s.e_r),
        end_(s.d + s.h * s.free.head<2>()),
        along_normal_(s.admittance * contact_load(e_, s.radius, 1.0, 0.0)),
        along_friction_(s.admittance * contact_load(e_, s.radius, 0.0, 1.0)) {}

  double slip(const Eigen::Vector3d& velocity) const {
    return rates_along(e_, s_.radius, velocity).y();
  }

  struct Candidate {
    bool holds = false;
    double normal = 0.0, friction = 0.0;
    double slip = 0.0;  // at the end
  };
  // T = ratio N.
  Candidate slide(double ratio) const {
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const double normal = reach_circle(end_, s_.h * g.head<2>(), s_.clearance);
    return {normal > 0.0, normal, ratio * normal, slip(s_.free + normal * g)};
  }
  // Sliding to this side throughout, with the mu of the middle.
  Candidate slide_on(double sign, double before) const {
    SlipFriction friction(s_.friction, before);
    for (;;) {
      const Candidate c = slide(-friction.mu() * sign);
      if (!c.holds || !friction.improve(0.5 * (before + c.slip))) return c;
    }
  }
  // A slip of 0 at the end: T = T_0 + T_1 N.
  Candidate stick() const {
    const double compliance = slip(along_friction_);
    const double constant = -slip(s_.free) / compliance, ratio = -slip(along_normal_) / compliance;
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const Eigen::Vector2d end = end_ + s_.h * constant * along_friction_.head<2>();
    const double normal = reach_circle(end, s_.h * g.head<2>(), s_.clearance);
    return {normal > 0.0, normal, constant + ratio * normal, 0.0};
  }

  LastingResult solve() const {
    const double nn = -e_.dot(along_normal_.head<2>()), nt = -e_.dot(along_friction_.head<2>());
    const double mu = s_.friction.at(slip(s_.start));
    if (mu * std::abs(nt) < nn) {
      const LastingResult r = unique();
      if (r.solutions == 1) return r;
    }
    const Delassus g{nn, nt, slip(along_normal_), slip(along_friction_)};
    const CoulombSolution r =
        solve_coulomb(g, (s_.clearance - end_.norm()) / s_.h, slip(s_.free), mu);
    return {r.normal, r.friction, r.contact_case, r.solutions};
  }

 private:
  static LastingResult result(ContactCase found, const Candidate& c) {
    return {c.normal, c.friction, found, c.holds ? 1 : 0};
  }
  static ContactCase sliding(double sign) {
    return sign > 0.0 ? ContactCase::kSlidePositive : ContactCase::kSlideNegative;
  }

  LastingResult unique() const {
    const double before = slip(s_.start), mu = s_.friction.sticking();
    const Candidate rest = stick();
    constexpr double kRoundOff = 1e-10;  // of the surface's speed
    if (std::abs(before) <= kRoundOff * s_.radius * std::abs(s_.start.z()) || before == 0.0) {
      if (std::abs(rest.friction) <= mu * rest.normal) return result(ContactCase::kStick, rest);
      const double sign = rest.friction > 0.0 ? -1.0 : 1.0;
      return result(sliding(sign), slide_on(sign, 0.0));
    }
    const double sign = before > 0.0 ? 1.0 : -1.0;
    const Candidate through = slide_on(sign, before);
    if (!through.holds || through.slip * sign > 0.0) return result(sliding(sign), through);
    if (!rest.holds) return {0.0, 0.0, ContactCase::kOpen, 0};
    // Friction brakes until the slip is 0; the force that then holds it there, over a whole step.
    const double share = before / (before - through.slip);
    const double hold = (rest.friction + share * sign * mu * rest.normal) / (1.0 - share);
    if (share >= 1.0 || hold * sign <= mu * rest.normal) return result(ContactCase::kStick, rest);
    return result(sliding(-sign), slide(mu * sign * (1.0 - 2.0 * share)));
  }

  const LastingStep& s_;
  Eigen::Vector2d e_, end_;
  Eigen::Vector3d along_normal_, along_friction_;
};

}  // namespace

LastingResult solve_lasting_contact(const LastingStep& step) { return Solver(step).solve(); }

}  // namespace rotorub
