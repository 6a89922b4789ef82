#include "plugin/contact/find_contact.h"

namespace rotorub::plugin {

const mjContact* find_contact(int rotor_geom, int ring_geom, const mjData* d) {
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& c = d->contact[i];
    const bool pair = (c.geom1 == rotor_geom && c.geom2 == ring_geom) ||
                      (c.geom1 == ring_geom && c.geom2 == rotor_geom);
    if (pair) return c.efc_address >= 0 ? &c : nullptr;
  }
  return nullptr;
}

}  // namespace rotorub::plugin
