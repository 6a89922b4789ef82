// Exact: planar impact with G_NT = 0. It sticks if and only if |v_T| <= mu G_TT L_NC, L_NC = -v_N /
// G_NN; then v_T+ = -eps_N eps_T v_T. When slipping with eps_T = 0, v_T+| = max(0, |v_T| - mu (1 +
// eps_N) G_TT L_NC). In all cases v_N+ = -eps_N v_N.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub::oracle {

struct PlanarImpact {
  double g_nn, g_tt;              // 1/kg, > 0
  double friction;                // mu
  double restitution;             // eps_N
  double tangential_restitution;  // eps_T

  // N s, L_NC for a closing velocity < 0.
  double compression(double normal_velocity) const { return -normal_velocity / g_nn; }
  bool sticks(double normal_velocity, double slip) const {
    return std::abs(slip) <= friction * g_tt * compression(normal_velocity);
  }
  double normal_after(double normal_velocity) const {
    return -restitution * normal_velocity;
  }  // m/s
  // Slip after the impact. If the compression slips, eps_T must be 0.
  double slip_after(double normal_velocity, double slip) const {
    if (sticks(normal_velocity, slip)) return -restitution * tangential_restitution * slip;
    assert(tangential_restitution == 0.0);
    const double loss = friction * (1.0 + restitution) * g_tt * compression(normal_velocity);
    return std::copysign(std::max(0.0, std::abs(slip) - loss), slip);
  }
};

}  // namespace rotorub::oracle
