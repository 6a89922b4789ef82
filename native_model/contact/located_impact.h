// Impacts of a fixed step, located in it: the straight path d + s w meets the circle at the share
// theta of the step, and Poisson's law (15)-(19) is solved there, with the normal and the velocity
// of that instant, v + (theta - 1/2) h a. What is left of the step flies with the velocities after
// it; more than one impact may follow, or lasting contact (rebound.h). An impact that takes time is
// located here and no more (system/finite_impact.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "native_model/contact/impact.h"

namespace rotorub {

struct FlightStep {
  double h = 0.0;                // s
  Eigen::Vector2d d{0.0, 0.0};   // m, ring's to rotor's centre at the begin
  Eigen::Vector3d velocity;      // (m/s, m/s, rad/s), of the middle of the step, without impact
  Eigen::Vector3d acceleration;  // of the same, without contact
  Eigen::Matrix3d admittance;    // J M^-1 J^T
  double clearance = 0.0, radius = 0.0;  // m
  double duration = 0.0;                 // s, of an impact: compression and expansion
};

struct LocatedImpact {
  double theta = 0.0;             // share of the step, in [0, 1]
  Eigen::Vector2d e_r{1.0, 0.0};  // outward normal
  ImpactResult law;
  double gap_rate_before = 0.0, slip_before = 0.0;  // m/s
};

struct StepImpacts {
  static constexpr int kMost = 8;  // of one step; the last has restitution 0
  Status status = Status::kOk;
  int count = 0;
  std::array<LocatedImpact, kMost> impacts;
  bool closes = false;      // contact lasts at the end of the step
  bool takes_time = false;  // the last of them has begun only, and has no law
};

StepImpacts locate_impacts(const FlightStep& step, const ImpactLaw& law);

}  // namespace rotorub
