// Checks of the contact laws that share no code with the solvers: scaled violations by given
// numbers. 0 is exact, and 1 is as large as the quantities themselves.
#pragma once

#include <algorithm>
#include <cmath>

namespace rotorub {

// One impact in impulses and velocities, (15)-(19), with a symmetric matrix that includes G_NT.
struct ImpactRecord {
  double g_nn, g_nt, g_tt;                          // 1/kg
  double gap_rate_before, slip_before;              // m/s
  double normal_compression, friction_compression;  // N s
  double normal_expansion, friction_expansion;      // N s
  double friction, restitution, tangential_restitution;
};

struct ImpactResidual {
  double compression;  // complementarity and Coulomb at the end of compression
  double expansion;    // Poisson and the tangential law at the end of expansion
  double energy_gain;  // work done by the impact over the energy scale; <= 0 if it dissipates
};

// Lasting contact: gap (m), normal force (N), friction force (N) and slip (m/s) at one instant,
// with the scales of gap, force and slip.
struct ContactResidual {
  double complementarity;  // largest of the violated signs and of gap x force, scaled
  double coulomb;          // violation of |T| <= mu N, and of T = -mu N sign(slip) if it slips
};

// Distance of (u, T) from the maximal monotone graph of the friction law, both scaled. At slip u <
// 0 the force T is `upper`, at u > 0 it is `lower`, and at u = 0 anything between.
inline double graph_distance(double u, double force, double lower, double upper, double u_scale,
                             double f_scale) {
  const double outside = std::max({0.0, lower - force, force - upper}) / f_scale;
  const double to_axis = std::hypot(u / u_scale, outside);  // u = 0
  const double to_lower = std::hypot(std::min(0.0, u) / u_scale, (force - lower) / f_scale);
  const double to_upper = std::hypot(std::max(0.0, u) / u_scale, (force - upper) / f_scale);
  return std::min({to_axis, to_lower, to_upper});
}

// min-map of a complementary pair: 0 if and only if a, b >= 0 and ab = 0.
inline double min_map(double a, double b) { return std::abs(std::min(a, b)); }

inline ImpactResidual impact_residual(const ImpactRecord& r) {
  const double nc = r.normal_compression, tc = r.friction_compression;
  const double ne = r.normal_expansion, te = r.friction_expansion;
  const double n_c = r.g_nn * nc + r.g_nt * tc + r.gap_rate_before;
  const double t_c = r.g_nt * nc + r.g_tt * tc + r.slip_before;
  const double n_e = n_c + r.g_nn * ne + r.g_nt * te;
  const double t_e = t_c + r.g_nt * ne + r.g_tt * te;

  // Velocities are scaled by the largest one, impulses by the impulse that would produce it.
  const double v = std::max({std::abs(r.gap_rate_before), std::abs(r.slip_before), std::abs(n_c),
                             std::abs(t_c), std::abs(n_e), std::abs(t_e), 1e-300});
  const double p = std::max({v / std::max(r.g_nn, r.g_tt), nc + ne, std::abs(tc), std::abs(te)});

  ImpactResidual out{};
  out.compression = std::max(min_map(n_c / v, nc / p),
                             graph_distance(t_c, tc, -r.friction * nc, r.friction * nc, v, p));
  const double excess = ne - r.restitution * nc;
  const double poisson = min_map(n_e / v, excess / p);
  const double s = tc < 0.0 ? -1.0 : 1.0;
  const double floor =
      tc == 0.0 ? -r.friction * ne : r.restitution * r.tangential_restitution * std::abs(tc);
  out.expansion = std::max(poisson, graph_distance(s * t_e, s * te, floor, r.friction * ne, v, p));
  const double work =
      0.5 * ((nc + ne) * (r.gap_rate_before + n_e) + (tc + te) * (r.slip_before + t_e));
  out.energy_gain = work / (v * p);
  return out;
}

inline ContactResidual contact_residual(double gap, double normal, double friction_force,
                                        double slip, double mu, double gap_scale,
                                        double force_scale, double slip_scale) {
  return {min_map(gap / gap_scale, normal / force_scale),
          graph_distance(slip, friction_force, -mu * normal, mu * normal, slip_scale, force_scale)};
}

}  // namespace rotorub
