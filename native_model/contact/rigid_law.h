// The set-valued contact (12)-(19) over one step of MuJoCo, in contact space: (relative x, relative
// y, spin at the contact). The laws are the native model's (native_model/contact).
//
// MuJoCo's Euler step is semi-implicit,
//   v_k+1 = v_k + H^-1 (h f(t_k, q_k) + J^T p),  H = M + h D,   q_k+1 = q_k + h v_k+1,
// which is the paper's scheme (11) with q_k for its midpoints. So, as there:
// - normal and lever arm are those of q_k. An impulse along q_k leaves q_k x v alone, so that a
//   billiard keeps speed and angular momentum to round-off;
// - the gap of (12) is that of q_k+1, so that lasting contact does not drift;
// - Poisson's law (15)-(19) is for a contact that was open, and whose rebound outlives the step: a
//   rebound that the loads and the ring's curvature undo within it is lasting contact.
#pragma once

#include <Eigen/Core>

#include "native_model/contact/impact.h"

namespace rotorub {

struct RigidStep {
  double h = 0.0;                      // s
  Eigen::Vector2d d{0.0, 0.0};         // m, ring's to rotor's centre, at q_k
  Eigen::Vector3d start, free;         // m/s, m/s, rad/s: v_k, and v_k+1 without contact
  bool was_in_contact = false;         // over the step before
  Eigen::Vector2d bend{0.0, 0.0};      // m, what the path bends off h v within the step
  Eigen::Matrix3d lasting_admittance;  // J H^-1 J^T: a force over the step
  Eigen::Matrix3d impact_admittance;   // J M^-1 J^T: an impulse in no time
};

// What MuJoCo's solver answers where constraints act on the same bodies: the rates at the end of
// the step under an impulse load on the rotor (x, y, torque), in contact space.
class StepResponse {
 public:
  virtual ~StepResponse() = default;
  virtual Eigen::Vector3d end(const Eigen::Vector3d& load, bool impact) = 0;
  // The change of the rates by an impulse in no time (constrained_law.h).
  virtual Eigen::Vector3d sudden(const Eigen::Vector3d& load) = 0;
  virtual double accuracy() const = 0;  // m/s, how far it may be off
};

struct RigidResult {
  Status status = Status::kOk;    // kNoSolution, kAmbiguous: no impulse is given
  bool converged = true;          // false: beside constraints, the least error found (kNoSolution)
  bool impact = false;            // by Poisson's law; else lasting contact or none
  Mode mode = Mode::kFree;        // of contact that lasts at the end, after an impact too
  Eigen::Vector2d e_r{1.0, 0.0};  // normal of the impulses
  double normal = 0.0;            // N s, >= 0
  double friction = 0.0;          // N s, on the rotor along e_t
  // Of an impact: m/s.
  double gap_rate_before = 0.0, gap_rate_after = 0.0, slip_before = 0.0, slip_after = 0.0;
};

// Where the step would end, ring's to rotor's centre, m.
inline Eigen::Vector2d end_of(const RigidStep& step) {
  return step.d + step.h * step.free.head<2>() + step.bend;
}

// True where the step would end outside the ring without a contact: only then is the contact
// closed. Needs h, d and free alone.
bool reaches_ring(const RigidStep& step, double clearance);

// Parts of solve_rigid_step, for contacts that are solved together (contact/coupled_step.h).
// Along the path of the step (kinematics.h).
Eigen::Vector2d contact_normal(const RigidStep& step, double clearance);
// An impact: the contact was open, and its rebound outlives the step.
bool is_impact(const RigidStep& step, const Eigen::Vector2d& e_r, const ContactParameters& contact);
// y_N of (12) without the contact: gap / h at the end of the step, m/s; of a depth that is there
// already (a start inside the ring's wall) a part.
double gap_over_step(const RigidStep& step, const ContactParameters& contact);

// The contact's impulses over a step that reaches the ring. With `held` they are solved together
// with the constraints (constrained_law.h); `free` is then that without the contact alone, and
// compression and expansion take no time.
RigidResult solve_rigid_step(const RigidStep& step, const ContactParameters& contact,
                             StepResponse* held = nullptr);

}  // namespace rotorub
