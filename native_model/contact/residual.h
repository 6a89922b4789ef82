// Checks of the contact laws that share no code with the solvers: how far given numbers are from
// satisfying them. Scaled: 0 is exact, 1 is as wrong as the quantities are large.
#pragma once

namespace rotorub {

// The laws of one impact in momenta and velocities, (15)-(19); symmetric matrix with G_NT.
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
  double energy_gain;  // J over the energy scale, <= 0 for a dissipative impact
};

ImpactResidual impact_residual(const ImpactRecord& record);

// Lasting contact: gap (m), normal force (N), friction force (N), slip (m/s) at one instant, with
// the scales of gap, force and slip.
struct ContactResidual {
  double complementarity;  // max of violated signs and of gap x force, scaled
  double coulomb;          // violation of |T| <= mu N, of T = -mu N sign(slip) where it slips
};

ContactResidual contact_residual(double gap, double normal, double friction_force, double slip,
                                 double mu, double gap_scale, double force_scale,
                                 double slip_scale);

}  // namespace rotorub
