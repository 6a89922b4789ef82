// One rigid contact over one step of MuJoCo, in contact space: (relative x, relative y, spin at the
// contact).
//
// Numbers of equations are those of Chavez and Ulbrich. MuJoCo's Euler step is semi-implicit,
//   v_k+1 = v_k + H^-1 (h f(t_k, q_k) + J^T p),  H = M + h D,   q_k+1 = q_k + h v_k+1,
// which is the paper's scheme (11) with q_k for its midpoints. Therefore, as there:
// - The normal and the lever arm are those at q_k. An impulse along q_k leaves q_k x v unchanged,
//   so that a billiard keeps its speed and its angular momentum to round-off.
// - The gap in (12) is the gap at q_k+1, so that a lasting contact does not drift.
// - Poisson's law (15)-(19) holds for a contact that was open and whose rebound outlasts two
//   steps (rebound_outlives_steps() in native_model/contact/impact.h). If the loads and the
//   curvature of the ring undo the rebound earlier, the contact lasts.
#pragma once

#include <Eigen/Core>

#include "native_model/contact/contact_parameters.h"
#include "native_model/contact/planar_contact.h"
#include "native_model/numerics/status.h"

namespace rotorub::plugin {

struct RigidStep {
  double h = 0.0;               // s
  Eigen::Vector2d d{0.0, 0.0};  // m, from the ring's centre to the rotor's, at q_k
  // m/s, m/s, rad/s: v_k, and v_k+1 without contact, or with the impulses found so far.
  Eigen::Vector3d start{0.0, 0.0, 0.0}, free{0.0, 0.0, 0.0};
  bool was_in_contact = false;     // over the previous step
  Eigen::Vector2d bend{0.0, 0.0};  // m, by how much the path departs from h v within the step
};

struct RigidResult {
  // kNoSolution, kAmbiguous: the contact gets no impulse. The exception is `converged` = false,
  // with constraints: it then gets the impulse with the least error that was found.
  Status status = Status::kOk;
  bool converged = true;
  bool impact = false;  // true: impact by Poisson's law; false: lasting contact or none
  ContactMode mode =
      ContactMode::kFree;         // mode of a contact that lasts at the end, also after an impact
  Eigen::Vector2d e_r{1.0, 0.0};  // normal of the impulses
  double normal = 0.0;            // N s, >= 0
  double friction = 0.0;          // N s, on the rotor along e_t
  // Rates before and after an impact, m/s.
  double gap_rate_before = 0.0, gap_rate_after = 0.0, slip_before = 0.0, slip_after = 0.0;
};

// True if the step would end outside the ring without a contact; only then is the contact closed.
// Needs h, d, free and bend.
bool reaches_ring(const RigidStep& step, double clearance);

// m, from the ring's centre to the rotor's: the position at the end of the step without a contact.
inline Eigen::Vector2d end_of(const RigidStep& step) {
  return step.d + step.h * step.free.head<2>() + step.bend;
}

// The normal along the path of the step (native_model/contact/kinematics.h).
Eigen::Vector2d contact_normal(const RigidStep& step, double clearance);

// True for an impact: the contact was open, and its rebound outlasts two steps.
bool is_impact(const RigidStep& step, const Eigen::Vector2d& e_r, const ContactParameters& contact);

// y_N of (12) without the contact: gap / h at the end of the step, m/s. An existing penetration (a
// start inside the ring's wall) is removed only in part in one step.
double gap_over_step(const RigidStep& step, const ContactParameters& contact);

}  // namespace rotorub::plugin
