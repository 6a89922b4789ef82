// The system that a peer receives: a rotor of one mode in each plane, its ring and its spin, as
// numbers. Plain data that needs none of our libraries, so that a peer can be a separate module.
//
//   m_i x_i'' + d_i x_i' + k_i x_i = F_i(t) + contact_i      rotor, i = 1, 2 (x, y)
//   M_i s_i'' + D_i s_i' + K_i s_i =        - contact_i      ring; absent: fixed
//   J phi''  = gain (speed_d - phi') + r lambda_T            spin; held: phi' = speed
#pragma once

#include <array>
#include <cmath>
#include <vector>

namespace rotorub::peers {

using Pair = std::array<double, 2>;  // x, y

struct PlanarLoad {
  bool rotating = false;
  double amplitude = 0.0, frequency = 0.0, phase = 0.0;  // N, rad/s, rad
  Pair vector{0.0, 0.0};                                 // N, of a constant one
  double on = 0.0, off = 0.0, ramp = 0.0;                // s
};

struct PlanarSupport {
  Pair mass{}, damping{}, stiffness{};  // kg, N s/m, N/m
};

struct PlanarSystem {
  PlanarSupport rotor;
  bool ring_moves = false;
  PlanarSupport ring;
  bool spin_is_free = false;
  double inertia = 0.0;                        // kg m^2, of a free spin
  double drive_gain = 0.0, drive_speed = 0.0;  // N m s, rad/s
  std::vector<PlanarLoad> loads;
  double radius = 0.0, clearance = 0.0;  // m
  double friction = 0.0, restitution = 0.0;
  Pair position{}, velocity{}, ring_position{}, ring_velocity{};  // at t = 0
  double angle = 0.0, speed = 0.0;                                // rad, rad/s

  // N on the rotor at t.
  Pair load(double t) const {
    Pair sum{0.0, 0.0};
    for (const PlanarLoad& l : loads) {
      if (t < l.on || t >= l.off) continue;
      const double share = l.ramp > 0.0 && t < l.on + l.ramp ? (t - l.on) / l.ramp : 1.0;
      const double turn = l.frequency * t + l.phase;
      sum[0] += share * (l.rotating ? l.amplitude * std::cos(turn) : l.vector[0]);
      sum[1] += share * (l.rotating ? l.amplitude * std::sin(turn) : l.vector[1]);
    }
    return sum;
  }
};

// Geometry of the contact: d from the ring's to the rotor's centre, e_r = d/|d|, e_t = e_z x e_r;
// gap = clearance - |d|, gap_rate = -e_r . d', slip = e_t . d' + r Omega.
struct PlanarGap {
  Pair normal{1.0, 0.0};  // e_r
  double distance = 0.0, gap = 0.0, gap_rate = 0.0, slip = 0.0;
};
inline PlanarGap planar_gap(const PlanarSystem& s, const Pair& x, const Pair& v, const Pair& ring,
                            const Pair& ring_v, double spin) {
  PlanarGap g;
  const Pair d{x[0] - ring[0], x[1] - ring[1]};
  const Pair dv{v[0] - ring_v[0], v[1] - ring_v[1]};
  g.distance = std::hypot(d[0], d[1]);
  g.gap = s.clearance - g.distance;
  // At the centre the normal is undefined; any direction will do, because there is no contact
  // there.
  if (g.distance > 1e-15) g.normal = {d[0] / g.distance, d[1] / g.distance};
  g.gap_rate = -(g.normal[0] * dv[0] + g.normal[1] * dv[1]);
  g.slip = -g.normal[1] * dv[0] + g.normal[0] * dv[1] + s.radius * spin;
  return g;
}

}  // namespace rotorub::peers
