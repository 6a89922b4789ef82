// MuJoCo's soft contact made to bounce like a given restitution.
//
// With an impedance d near 1 and direct solref (-K, -B) the gap of a closing contact obeys
//   x'' = -B x' - K x  while x < 0 and the force pushes,   zeta = B / (2 sqrt K),
// and it lets go when the force is 0, with the ratio of speeds
//   zeta < 1:  e = exp(-zeta/sqrt(1-zeta^2) (pi - atan2(2 zeta sqrt(1-zeta^2), 1 - 2 zeta^2)))
//   zeta > 1:  e = exp(-zeta/s ln((zeta+s)/(zeta-s))),  s = sqrt(zeta^2-1);   zeta = 1: e^-2.
#pragma once

#include <string>

#include "mjcf/mujoco_version.h"
#include "native_model/contact/friction.h"
#include "native_model/scene/forward.h"
#include "native_model/scene/mujoco.h"

namespace rotorub {

struct SoftContact {
  double stiffness = 0.0;  // 1/s^2, K > 0
  double damping = 0.0;    // 1/s, B >= 0
  double impedance = 0.0;  // 1, d, constant (solimp)
  bool gives = false;      // a contact that gives: stiffness and damping are the plugin's
};

// Ratio of the speeds after and before for a damping ratio zeta >= 0, in (0, 1].
double soft_restitution(double zeta);

// Its inverse for a restitution in [0, 1]. A plastic contact needs infinite damping: capped at
// kMaxDampingRatio (0.0096).
double soft_damping_ratio(double restitution);
inline constexpr double kMaxDampingRatio = 5.0;

// sqrt(K) step of the default stiffness. A bounce takes pi / 0.2 = 16 steps; the restitution met
// scatters by 2 % of the speed with the place in the step where the contact starts. Half as stiff
// halves that scatter and doubles how long and how deep a bounce is.
inline constexpr double kContactStepFraction = 0.2;

// `step`: s, > 0. `stiffness`: 1/s^2; 0: as stiff as the step allows. `damping`: 1/s; 0: that of
// the restitution.
SoftContact soft_contact(double restitution, double step, double stiffness = 0.0,
                         double damping = 0.0);

// Of a scene's contact with this contact model. What a scene does not say is chosen: for `coulomb`
// as stiff as the step allows; a cone's is a contact with a limit as the step goes to 0, and no
// stiffer than
//   K = (v / (kConeDepth c))^2,  v = max(r_c Omega, sqrt(2 g c), speed at the start),
// r_c = c the clearance, with which an impact at v goes kConeDepth of the clearance deep.
SoftContact soft_contact(const scene::Scene& scene, scene::ContactModel model, double step);
inline constexpr double kConeDepth = 0.005;

// Of a contact that gives: as its impedance d goes to 0 MuJoCo's contact is a spring k and a damper
// c, with K = k A / d and B = c A / d in a_ref, A the mobility that MuJoCo takes (diagApprox); the
// error is of order d. The plugin sets a_ref = R N by R as MuJoCo has it, N the law's force.
inline constexpr double kCompliantImpedance = 1e-4;

// A sentence that names what the scene's contacts say of rigid impacts and a soft contact has no
// part in, as its stiffness and damping decide how long it takes and what it does to the slip;
// empty where they say nothing of it.
std::string unused_by_soft_contacts(const scene::Scene& scene);

// Attributes of the <pair> of a rub, as each of the plugin's contact models sets it.
struct ContactPair {
  int condim = 1;         // 3: MuJoCo's own friction cone
  double friction = 0.0;  // mu, of both tangential directions; those of torsion and rolling are 0
  SoftContact soft;       // solref is (-K, -B), solimp (d, d, 0.001)
  double margin = 0.0;    // m, of `target`
  double gap = 0.0;       // m, of `target`
};

// clearance: m, > 0; friction: mu >= 0. Nobody but `cone` has friction in MuJoCo's contact.
// `kept_out`: of MuJoCo's solver, whatever the contact model.
ContactPair contact_pair(scene::ContactModel model, double clearance, const FrictionLaw& friction,
                         const SoftContact& soft, const MujocoVersion& target,
                         bool kept_out = false);

}  // namespace rotorub
