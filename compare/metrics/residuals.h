// How well a recorded series satisfies the laws of unilateral contact and Coulomb friction, from
// any engine. Shares no code with the solvers: gaps are computed from the positions in the series.
#pragma once

#include <vector>

#include "compare/metrics/relative_motion.h"
#include "native_model/contact/friction.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// The constants of the laws.
struct ContactFacts {
  double clearance = 0.0;  // m, delta_0, > 0
  double radius = 0.0;     // m, r, > 0
  FrictionLaw friction{};
  double impact_time = 0.0;  // s, duration of an impact, compression and expansion
  bool is_compliant =
      false;  // compliant contact: the penetration obeys a law, so g_N >= 0 does not hold
};

// Largest violation over all rows: dimensionless, >= 0, and 0 for an exact series. Forces are
// scaled by `force_scale` F, lengths by the clearance.
struct Residuals {
  double force_scale = 0.0;      // N: mean normal force of the rows in contact; 1 N without any
  double penetration = 0.0;      // max(0, -g_N) / delta_0                        g_N >= 0
  double adhesion = 0.0;         // max(0, -lambda_N) / F                         lambda_N >= 0
  double complementarity = 0.0;  // max(0, g_N) max(0, lambda_N) / (delta_0 F)    g_N lambda_N = 0
  double cone = 0.0;             // max(0, |lambda_T| - mu lambda_N) / F          |lambda_T| <= ...
  double sliding = 0.0;          // |lambda_T + mu lambda_N sign(gdot_T)| / F     rows that slide
  double power = 0.0;            // max(0, lambda_T gdot_T) / (F v)               friction brakes
  double gap_error = 0.0;        // |gap column - (delta_0 - |d|)| / delta_0      the series itself
};

// A row slides if it is in contact and |gdot_T| exceeds this share of the largest |gdot_T| of the
// series (v above); below it the direction of slip is undefined.
inline constexpr double kSlipThreshold = 1e-3;

// Rows within an impact of finite duration obey its law and not (12) and (13) of lasting contact:
// there may be a force while the gap opens, and restitution may hold friction against the slip.
// These rows are left out of complementarity, sliding and power. contact: index, from 0.
Residuals contact_residuals(const Trajectory& trajectory, const ContactFacts& facts,
                            std::size_t contact = 0);
// The largest over all contacts; 0 without a contact.
Residuals largest_residuals(const Trajectory& trajectory,
                            const std::vector<ContactFacts>& contacts);

}  // namespace rotorub
