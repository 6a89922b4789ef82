// Parameters of MuJoCo's soft contact for a given restitution.
//
// With an impedance d near 1 and direct solref (-K, -B), the gap of a closing contact obeys
//   x'' = -B x' - K x  while x < 0 and the force is repulsive,   zeta = B / (2 sqrt K).
// It separates when the force is 0, with the ratio of speeds
//   zeta < 1:  e = exp(-zeta/sqrt(1-zeta^2) (pi - atan2(2 zeta sqrt(1-zeta^2), 1 - 2 zeta^2)))
//   zeta > 1:  e = exp(-zeta/s ln((zeta+s)/(zeta-s))),  s = sqrt(zeta^2-1);   zeta = 1: e^-2.
#pragma once

#include <cstddef>
#include <string>

#include "mjcf/mujoco_version.h"
#include "native_model/contact/friction.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/forward.h"
#include "native_model/scene/mujoco.h"

namespace rotorub {

struct SoftContact {
  double stiffness = 0.0;     // 1/s^2, K > 0
  double damping = 0.0;       // 1/s, B >= 0
  double impedance = 0.0;     // 1, d, constant (solimp)
  bool is_compliant = false;  // compliant contact: the plugin sets stiffness and damping
};

// Ratio of the speeds after and before an impact for a damping ratio zeta >= 0, in (0, 1].
double soft_restitution(double zeta);

// The inverse, for a restitution in [0, 1]. Restitution 0 would need infinite damping, so the
// result is capped at kMaxDampingRatio, whose restitution is 0.0093.
double soft_damping_ratio(double restitution);
inline constexpr double kMaxDampingRatio = 5.0;

// sqrt(K) step of the default stiffness. A bounce takes pi / 0.2 = 16 steps. The restitution
// scatters by 2 % of the speed, depending on where in the step the contact starts. Half this value
// halves the scatter and doubles the duration and depth of a bounce.
inline constexpr double kContactStepFraction = 0.2;

// `step`: s, > 0. `stiffness`: 1/s^2; 0: as stiff as the step allows. `damping`: 1/s; 0: from the
// restitution.
SoftContact soft_contact(double restitution, double step, double stiffness = 0.0,
                         double damping = 0.0);

// Parameters of a contact of the scene with this contact model. `shape`: values of the modes at the
// contact; without them they are 1. Values that the scene omits are chosen:
// for `coulomb` the contact is as stiff as the step allows. A cone must have a limit as the step
// goes to 0, so it is also no stiffer than
//   K = (v / (kConeDepth c))^2,  v = max(c Omega, sqrt(2 g c), speed at the start),
// with c the clearance. An impact at v then has a penetration of kConeDepth clearances.
SoftContact soft_contact(const scene::Scene& scene, scene::ContactModel model, double step,
                         std::size_t bearing = 0, const ModeShape& shape = {});
inline constexpr double kConeDepth = 0.005;

// Impedance d of a compliant contact. As d goes to 0, MuJoCo's contact becomes a spring k and a
// damper c if K = k A / d and B = c A / d in a_ref, where A is MuJoCo's mobility (diagApprox); the
// error is of order d. The plugin sets a_ref = R N, with MuJoCo's R and the force N of the law.
inline constexpr double kCompliantImpedance = 1e-4;

// A sentence that names the keys of rigid impacts that the scene's contacts set and a soft contact
// ignores, because its stiffness and damping determine the duration of an impact and the effect on
// the slip. Empty if there are none.
std::string unused_by_soft_contacts(const scene::Scene& scene);

// Attributes of the <pair> of a contact for each of the plugin's contact models.
struct ContactPair {
  int condim = 1;         // 3: MuJoCo's own friction cone
  double friction = 0.0;  // mu, in both tangential directions; torsional and rolling friction are 0
  SoftContact soft;       // solref is (-K, -B), solimp (d, d, 0.001)
  double margin = 0.0;    // m, as `target` defines it
  double gap = 0.0;       // m, as `target` defines it
};

// clearance: m, > 0; friction: mu >= 0. Only the cone models have friction in MuJoCo's contact.
// `kept_out`: keeps the contact out of MuJoCo's solver with any contact model.
ContactPair contact_pair(scene::ContactModel model, double clearance, const FrictionLaw& friction,
                         const SoftContact& soft, const MujocoVersion& target,
                         bool kept_out = false);

}  // namespace rotorub
