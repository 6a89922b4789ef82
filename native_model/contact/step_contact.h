// Contact over one fixed step: impacts, and lasting contact.
//
// Impacts are located in the step: the straight path d + s w meets the circle at the share
// theta of the step, and Poisson's law (15)-(19) is solved there, with the normal and the velocity
// of that instant, v + (theta - 1/2) h a. What is left of the step flies with the velocities after
// it; more than one impact may follow, or lasting contact (impact.h). An impact that takes time is
// located here and no more (system/finite_impact.h).
#pragma once

#include <Eigen/Core>
#include <array>

#include "native_model/contact/friction.h"
#include "native_model/contact/impact.h"
#include "native_model/contact/planar_contact.h"

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

// Lasting contact over one fixed step, solved on positions: the step's normal and friction impulse,
// along the normal e_r, for which the relative centre ends exactly on the circle,
//
//   |d + h (w + A p)| = delta_0,   N >= 0,   p = contact_load(N, T),
//
// a quadratic in N for T in a fixed ratio to it (sliding) or for a slip of 0 (sticking). Friction
// follows the slip of the middle of the step (set-valued law), and so does its mu. Where the slip
// reverses within the step, T is the mean of its two values by the time that each holds, so that a
// reversal costs no order. Where friction can carry more than the normal row, and where no such
// point of the circle is in reach, (12), (13) of the linearised gap decide.
struct LastingStep {
  double h = 0.0;                 // s
  Eigen::Vector2d d{0.0, 0.0};    // m, ring's to rotor's centre at the begin
  Eigen::Vector2d e_r{1.0, 0.0};  // outward normal: that of d, if the path leads out along it
  Eigen::Vector3d start, free;    // (m/s, m/s, rad/s): before the step, and without contact
  Eigen::Matrix3d admittance;     // A = J (M + h D/2)^-1 J^T
  double clearance = 0.0, radius = 0.0;  // m
  FrictionLaw friction{};
};

struct LastingResult {
  double normal = 0.0;    // N s, >= 0
  double friction = 0.0;  // N s, on the rotor along e_t
  ContactCase contact_case = ContactCase::kOpen;
  int solutions = 1;  // 0: none (frictional jamming, Painleve); above 1: the first is given
};

// For a path that ends outside the circle.
LastingResult solve_lasting_contact(const LastingStep& step);

}  // namespace rotorub
