#include "native_model/contact/impact.h"

#include <cmath>

namespace rotorub {
namespace {

// The expansion in the direction s = sign(L_TC): the least tangential impulse is `floor` (or
// -mu L_N for the symmetric set), the greatest mu L_N.
struct Expansion {
  Delassus a;
  double b_n, b_t, mu;
  double least_normal;  // eps_N L_NC
  double floor;         // eps_N eps_T |L_TC|
  bool symmetric;

  double lower(double normal) const { return symmetric ? -mu * normal : floor; }

  using Point = PlanarImpulse<double>;
  double gap_rate(Point p) const { return gap_rate_after(a, b_n, p); }
  double slip(Point p) const { return slip_after(a, b_t, p); }

  // L_N = eps_N L_NC given: the tangential set is monotone, so the case is decided by its ends.
  Point at_least_normal() const {
    const double n = least_normal;
    const Point low{n, lower(n)}, high{n, mu * n};
    if (slip(low) > 0.0) return low;
    if (slip(high) < 0.0) return high;
    return {n, -(a.tn * n + b_t) / a.tt};
  }

  // gdot_NE = 0 with more than the least impulse. False: no case holds.
  bool closed(Point& p, int& count) const {
    count = 0;
    const auto take = [&](Point candidate) {
      if (candidate.normal < least_normal) return;
      if (count++ == 0) p = candidate;
    };
    if (symmetric) {
      if (carried(a, mu) != 0.0) {
        const double n = slide(a, b_n, mu);
        if (const Point c{n, -mu * n}; slip(c) > 0.0) take(c);
      }
    } else if (const Point c{-(b_n + a.nt * floor) / a.nn, floor}; slip(c) > 0.0) {
      take(c);
    }
    if (carried(a, -mu) != 0.0) {
      const double n = slide(a, b_n, -mu);
      if (const Point c{n, mu * n}; slip(c) < 0.0) take(c);
    }
    const Point stuck = stick(a, b_n, b_t);
    if (stuck.friction >= lower(stuck.normal) && stuck.friction <= mu * stuck.normal) take(stuck);
    return count > 0;
  }
};

}  // namespace

ImpactResult compress(const ImpactPhase& phase, const ImpactLaw& law) {
  ImpactResult r;
  const CoulombSolution c =
      solve_coulomb(phase.matrix, phase.gap_rate, phase.slip, law.friction.at(phase.slip));
  r.status = status_of(c.solutions);
  r.normal_compression = c.normal;
  r.friction_compression = c.friction;
  const PlanarImpulse<double> l{c.normal, c.friction};
  r.gap_rate_compression = gap_rate_after(phase.matrix, phase.gap_rate, l);
  r.slip_compression = slip_after(phase.matrix, phase.slip, l);
  // What the case says is zero is zero, not round-off.
  if (c.contact_case != ContactCase::kOpen) r.gap_rate_compression = 0.0;
  if (c.contact_case == ContactCase::kStick) r.slip_compression = 0.0;
  r.gap_rate = r.gap_rate_compression;
  r.slip = r.slip_compression;
  return r;
}

void expand(const ImpactPhase& phase, const ImpactLaw& law, ImpactResult& r) {
  if (r.status == Status::kNoSolution) return;
  const double s = r.friction_compression < 0.0 ? -1.0 : 1.0;
  Expansion e{phase.matrix, phase.gap_rate, s * phase.slip, law.friction.at(phase.slip), 0.0,
              0.0,          false};
  e.a.nt *= s;
  e.a.tn *= s;
  e.least_normal = law.restitution * r.normal_compression;
  e.floor = law.restitution * law.tangential_restitution * std::abs(r.friction_compression);
  e.symmetric = r.friction_compression == 0.0;

  Expansion::Point p = e.at_least_normal();
  bool closed = false;
  if (e.gap_rate(p) < 0.0) {
    // Round-off aside, the least impulse leaves the bodies closing: it takes more.
    int count = 0;
    Expansion::Point q{0.0, 0.0};
    if (e.closed(q, count)) {
      p = q;
      closed = true;
      if (count > 1) r.status = Status::kAmbiguous;
    } else {
      r.status = Status::kNoSolution;
      return;
    }
  }
  r.normal_expansion = p.normal;
  r.friction_expansion = s * p.friction;
  r.gap_rate = closed ? 0.0 : e.gap_rate(p);
  r.slip = s * e.slip(p);
  const bool sticks = p.friction > e.lower(p.normal) && p.friction < e.mu * p.normal;
  if (sticks) r.slip = 0.0;
}

ImpactResult solve_impact(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law) {
  ImpactResult r = compress({g, gap_rate, slip}, law);
  expand({g, r.gap_rate_compression, r.slip_compression}, law, r);
  return r;
}

}  // namespace rotorub
