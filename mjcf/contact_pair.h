// How the <pair> of a rub is set in MuJoCo for each of the plugin's contact models.
#pragma once

#include "mjcf/mujoco_version.h"
#include "mjcf/soft_contact.h"
#include "native_model/contact/friction.h"
#include "native_model/scene/contact_models.h"

namespace rotorub {

// Attributes of <pair>.
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
