// Exact: planar impact with G_NT = 0. It sticks if and only if |v_T| <= mu G_TT L_NC, L_NC = -v_N /
// G_NN; then v_T+ = -eps_N eps_T v_T. When slipping with eps_T = 0, v_T+| = max(0, |v_T| - mu (1 +
// eps_N) G_TT L_NC). In all cases v_N+ = -eps_N v_N.
#pragma once

namespace rotorub::oracle {

struct PlanarImpact {
  double g_nn, g_tt;              // 1/kg, > 0
  double friction;                // mu
  double restitution;             // eps_N
  double tangential_restitution;  // eps_T

  double compression(double normal_velocity) const;  // N s, L_NC for a closing velocity < 0
  bool sticks(double normal_velocity, double slip) const;
  double normal_after(double normal_velocity) const;  // m/s
  // Slip after the impact. If the compression slips, eps_T must be 0.
  double slip_after(double normal_velocity, double slip) const;
};

}  // namespace rotorub::oracle
