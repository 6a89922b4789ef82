#include "plugin/contact/runge_kutta.h"

namespace rotorub::plugin {

void refuse_runge_kutta() {
  mju_error(
      "rotorub: <option integrator=\"RK4\">: contact model `rigid` gives its impulses once a step; "
      "accepted: Euler, implicit (or contact model coulomb or cone)");
}

}  // namespace rotorub::plugin
