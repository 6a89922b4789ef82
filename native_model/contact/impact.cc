#include "native_model/contact/impact.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/impact_friction.h"

namespace rotorub {

namespace {

using Point = PlanarImpulse;

// The problem of an expansion, y = a L + (b_n, b_t).
struct Expansion {
  Delassus a;
  double b_n, b_t;
  ContactSet set;

  double gap_rate(Point p) const { return gap_rate_after(a, b_n, p); }
  double slip(Point p) const { return slip_after(a, b_t, p); }
  bool within(Point p) const {
    return p.friction >= set.low(p.normal) && p.friction <= set.high(p.normal);
  }

  // Solution with L_N = n. The tangential set is monotone, so its ends decide the case.
  Point at_least_normal() const {
    const double n = set.least_normal;
    const Point low{n, set.low(n)}, high{n, set.high(n)};
    if (slip(low) > 0.0) return low;
    if (slip(high) < 0.0) return high;
    return {n, -(a.tn * n + b_t) / a.tt};
  }

  // The solutions with gdot_NE = 0 and at least the least impulse: their number, and the first.
  struct Closed {
    int solutions = 0;
    Point first{0.0, 0.0};
  };
  Closed closed() const {
    Closed found;
    const auto take = [&](Point candidate) {
      if (candidate.normal < set.least_normal) return;
      if (found.solutions++ == 0) found.first = candidate;
    };
    // On a bound, L_T = c_0 + c_1 L_N.
    const auto along = [&](double c_0, double c_1, double sign) {
      const double carries = a.nn + a.nt * c_1;
      if (carries == 0.0) return;
      const double normal = -(b_n + a.nt * c_0) / carries;
      if (const Point c{normal, c_0 + c_1 * normal}; sign * slip(c) > 0.0) take(c);
    };
    along(set.low(0.0), set.low(1.0) - set.low(0.0), 1.0);
    along(set.high(0.0), set.high(1.0) - set.high(0.0), -1.0);
    if (const Point stuck = sticking_impulse(a, b_n, b_t); within(stuck)) take(stuck);
    return found;
  }
};

struct Rows {
  Eigen::Vector3d normal, tangential;
};

// W_N and W_T in contact space, plus tau What for the velocity at the start of the phase.
Rows rows(const ImpactInput& in, const Eigen::Vector3d& velocity, double tau) {
  const Eigen::Vector2d& e = in.e_r;
  const Eigen::Vector2d t{-e.y(), e.x()};
  Rows r{{-e.x(), -e.y(), 0.0}, {t.x(), t.y(), in.radius}};
  if (tau == 0.0) return r;
  const double whirl = t.dot(velocity.head<2>()), gap_rate = -e.dot(velocity.head<2>());
  r.normal.head<2>() -= tau * whirl / in.delta * t;
  r.tangential.head<2>() += tau * gap_rate / in.delta * t;
  return r;
}

// One phase: the rates at its end are y = matrix L + (gap_rate, slip). With a finite duration tau
// the matrix and the rates contain the terms of (16): C_N = (W_N + What_N tau)^T M^-1 and so on.
struct ImpactPhase {
  Delassus matrix;
  double gap_rate = 0.0;  // m/s, gdot_N at its end without impulse
  double slip = 0.0;      // m/s, gdot_T at its end without impulse
};

// The result of the compression alone; its expansion is still 0. mu is the mean over the slips of
// the phase (impact_friction.h), as in expand().
ImpactResult compress(const ImpactPhase& phase, const ImpactLaw& law) {
  const Delassus& a = phase.matrix;
  ImpactFriction friction(law.friction, phase.slip);
  CoulombSolution c;
  ImpactResult r;
  do {
    c = solve_coulomb(a, phase.gap_rate, phase.slip, friction.mu());
    r.slip_compression = slip_after(a, phase.slip, {c.normal, c.friction});
  } while (c.is_unique() && friction.improve(c.normal, c.friction, r.slip_compression, a.tt));
  r.status = status_of(c.solutions);
  r.normal_compression = c.normal;
  r.friction_compression = c.friction;
  r.gap_rate_compression = gap_rate_after(a, phase.gap_rate, {c.normal, c.friction});
  // Rates that vanish in this case are exactly 0, without round-off.
  if (c.contact_case != ContactCase::kOpen) r.gap_rate_compression = 0.0;
  if (c.contact_case == ContactCase::kStick) r.slip_compression = 0.0;
  r.gap_rate = r.gap_rate_compression;
  r.slip = r.slip_compression;
  return r;
}

// The expansion after the compression in r; fills the rest of r. The rates of the phase are those
// at the end of the expansion without its impulses.
void expand(const ImpactPhase& phase, const ImpactLaw& law, double mu, ImpactResult& r) {
  if (r.status == Status::kNoSolution) return;
  const Expansion e{phase.matrix, phase.gap_rate, phase.slip,
                    expansion_set(law, mu, r.normal_compression, r.friction_compression)};
  Point p = e.at_least_normal();
  const bool closes = e.gap_rate(p) < 0.0;  // the least impulse leaves the bodies closing
  if (closes) {
    const Expansion::Closed closed = e.closed();
    if (closed.solutions != 1) r.status = status_of(closed.solutions);
    if (closed.solutions == 0) return;
    p = closed.first;
  }
  r.normal_expansion = p.normal;
  r.friction_expansion = p.friction;
  r.gap_rate = closes ? 0.0 : e.gap_rate(p);
  const bool sticks = p.friction > e.set.low(p.normal) && p.friction < e.set.high(p.normal);
  r.slip = sticks ? 0.0 : e.slip(p);
}

void expand(const ImpactPhase& phase, const ImpactLaw& law, ImpactResult& r) {
  ImpactFriction friction(law.friction, phase.slip);
  do {
    expand(phase, law, friction.mu(), r);
  } while (r.status == Status::kOk &&
           friction.improve(r.normal_expansion, r.friction_expansion, r.slip, phase.matrix.tt));
}

ImpactPhase phase(const ImpactInput& in, const Rows& w, const Rows& row,
                  const Eigen::Vector3d& end_velocity) {
  const Eigen::Vector3d an = in.admittance * w.normal, at = in.admittance * w.tangential;
  return {{row.normal.dot(an), row.normal.dot(at), row.tangential.dot(an), row.tangential.dot(at)},
          row.normal.dot(end_velocity),
          row.tangential.dot(end_velocity)};
}

}  // namespace

ContactSet expansion_set(const ImpactLaw& law, double mu, double normal, double friction) {
  ContactSet set;
  set.friction = mu;
  set.least_normal = law.restitution * normal;
  set.side = friction > 0.0 ? 1.0 : friction < 0.0 ? -1.0 : 0.0;
  set.floor = law.restitution * law.tangential_restitution * std::abs(friction);
  return set;
}

ImpactResult solve_impact(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law) {
  ImpactResult r = compress({g, gap_rate, slip}, law);
  expand({g, r.gap_rate_compression, r.slip_compression}, law, r);
  return r;
}

ImpactResult solve_impact(const ImpactInput& in, const ImpactLaw& law) {
  const Rows w = rows(in, in.velocity, 0.0);
  if (in.compression_time == 0.0 && in.expansion_time == 0.0) {
    const Delassus g = delassus(in.admittance, in.e_r, in.radius);
    return solve_impact(g, w.normal.dot(in.velocity), w.tangential.dot(in.velocity), law);
  }
  const Rows c = rows(in, in.velocity, in.compression_time);
  ImpactResult r =
      compress(phase(in, w, c, in.velocity + in.acceleration * in.compression_time), law);
  const Eigen::Vector3d compressed =
      in.velocity + in.acceleration * in.compression_time +
      in.admittance * (w.normal * r.normal_compression + w.tangential * r.friction_compression);
  const Rows e = rows(in, compressed, in.expansion_time);
  expand(phase(in, w, e, compressed + in.acceleration * in.expansion_time), law, r);
  return r;
}

double restitution_under_loads(double restitution, double approach, double a,
                               double compression_time, double expansion_time) {
  const double compressed = a * compression_time, expanded = a * expansion_time;
  if (!(compressed > 0.0)) return restitution;
  const double back = std::max(0.0, restitution * (approach + compressed) - expanded);
  const double again = std::sqrt(back * (back + 2.0 * expanded));
  if (again <= 0.5 * (1.0 + restitution) * approach) return restitution;
  return restitution * approach / (approach + compressed);
}

}  // namespace rotorub
