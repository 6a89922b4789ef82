// The impact law in contact space: from the relative velocity before to the impulses, with the
// compression and expansion times of (15)-(19).
#pragma once

#include <Eigen/Core>

#include "native_model/contact/impact.h"

namespace rotorub {

struct ImpactInput {
  Eigen::Matrix3d admittance;    // J M^-1 J^T
  Eigen::Vector2d e_r;           // outward normal
  double radius = 0.0;           // m
  double delta = 0.0;            // m, distance of the centres
  Eigen::Vector3d velocity;      // (ddot, Omega_c) before the impact
  Eigen::Vector3d acceleration;  // of the same without contact; used over tau_C and tau_E only
  double compression_time = 0.0, expansion_time = 0.0;  // s
};

// With tau = 0 the classical law. Otherwise the rows of (16): gdot_N at the end of a phase is
// -e_r . ddot + What_N . (ddot tau), and
//   What_N . Delta d = -(e_t . ddot) (e_t . Delta d) / delta,
//   What_T . Delta d =  gdot_N (e_t . Delta d) / delta                                       (8)
ImpactResult solve_impact(const ImpactInput& input, const ImpactLaw& law);

}  // namespace rotorub
