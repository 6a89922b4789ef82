#include "native_model/prepare/orbit_start.h"

#include <string>

#include "native_model/linear/free_motion.h"
#include "native_model/linear/steady_orbit.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {

void add_orbit_start(const scene::Scene& scene, Model& m) {
  const Layout& l = m.layout;
  FreeMotion motion = free_motion(scene, m);
  m.q0.head(2 * l.modes) += motion.q;
  m.v0.head(2 * l.modes) += motion.v;
  m.v0.segment(l.feedback_state(), l.feedback_states) += motion.stored;
  for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
    const std::string beyond = beyond_limit(scene, m.feedbacks[k], motion.current[k].maxCoeff());
    if (beyond.empty()) continue;
    refuse_steady(scene, "the steady free orbit" + beyond + "; raise the limit, or set false");
  }
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = m.auxiliary[k];
    const RingRest rest = ring_at_rest(scene, m, at);
    if (at.moves()) m.q0.segment<2>(at.ring) += rest.ring;
    if (at.housing != kAbsent) m.q0.segment<2>(at.housing) += rest.housing;
    motion.orbits[k].centre = -rest.ring - at.ring_offset;
  }
  if (l.torsion && m.drive && scene.initial.torsion.empty()) {
    const double torque = m.drive->torque(0.0, 0.0, m.speed);
    m.q0.segment(l.theta(), l.torsion) +=
        torque * m.drive_shape.cwiseQuotient(m.stiffness.segment(l.theta(), l.torsion));
  }
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    if (!m.auxiliary[k].contact) continue;
    const double largest = motion.orbits[k].largest();
    const double clearance = m.auxiliary[k].contact->clearance;
    if (largest < clearance) continue;
    const std::string key =
        m.auxiliary.size() > 1 ? scene::list_element("contact", k) : std::string("contact");
    refuse_steady(scene, "the steady free orbit touches: it comes to " +
                             scene::number_text(largest) +
                             " m from the middle of the ring, but it must stay within " + key +
                             ".clearance = " + scene::number_text(clearance) +
                             " m; start on the rub instead (initial.rub = \"synchronous\"), or set "
                             "false and give your own start");
  }
}

}  // namespace rotorub
