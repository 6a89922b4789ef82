#include "plugin/contact/runge_kutta.h"

#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

void refuse_runge_kutta() {
  raise_error(
      "rotorub: <option integrator=\"RK4\">: contact model `rigid` gives its impulses once a step; "
      "accepted: Euler, implicit (or contact model coulomb or cone)");
}

}  // namespace rotorub::plugin
