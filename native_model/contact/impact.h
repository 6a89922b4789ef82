// Poisson's impact law with Coulomb friction and tangential restitution, (15)-(19), in closed form
// by cases. Compression: solve_coulomb on momenta. Expansion:
//
//   normal:      L_NE >= eps_N L_NC,  gdot_NE >= 0,  gdot_NE (L_NE - eps_N L_NC) = 0
//   tangential (Beitelschmidt, gdot_TE0 = 0), s = sign(L_TC), u = s gdot_TE:
//     u < 0:  s L_TE = mu L_NE
//     u = 0:  s L_TE in [eps_N eps_T |L_TC|, mu L_NE]
//     u > 0:  s L_TE = eps_N eps_T |L_TC|
//   L_TC = 0: the symmetric Coulomb set |L_TE| <= mu L_NE.
#pragma once

#include "native_model/contact/coulomb.h"
#include "native_model/contact/friction.h"
#include "native_model/numerics/status.h"

namespace rotorub {

struct ImpactLaw {
  FrictionLaw friction{};
  double restitution = 0.0;             // eps_N in [0, 1]
  double tangential_restitution = 0.0;  // eps_T in [0, 1]
};

// One phase: velocities at its end y = matrix L + velocity. With a finite duration tau the matrix
// and the velocity hold the terms of (16): C_N = (W_N + What_N tau)^T M^-1 and so on.
struct ImpactPhase {
  Delassus matrix;
  double gap_rate = 0.0;  // m/s, gdot_N at its end without impulse
  double slip = 0.0;      // m/s, gdot_T at its end without impulse
};

struct ImpactResult {
  Status status = Status::kOk;
  double normal_compression = 0.0, friction_compression = 0.0;  // N s, L_NC, L_TC
  double normal_expansion = 0.0, friction_expansion = 0.0;      // N s, L_NE, L_TE
  double gap_rate_compression = 0.0, slip_compression = 0.0;    // m/s, gdot_NC, gdot_TC
  double gap_rate = 0.0, slip = 0.0;                            // m/s, gdot_NE, gdot_TE
  double normal() const { return normal_compression + normal_expansion; }
  double friction() const { return friction_compression + friction_expansion; }
};

// The compression phase alone: fills the L_C and gdot_C. Each phase has the mu of phase.slip.
ImpactResult compress(const ImpactPhase& phase, const ImpactLaw& law);
// The expansion that follows `result`'s compression; phase.gap_rate and slip are those at the end
// of the expansion without its impulses. Fills the rest.
void expand(const ImpactPhase& phase, const ImpactLaw& law, ImpactResult& result);

// The classical, instantaneous law (tau_C = tau_E = 0): gap_rate and slip just before.
ImpactResult solve_impact(const Delassus& g, double gap_rate, double slip, const ImpactLaw& law);

}  // namespace rotorub
