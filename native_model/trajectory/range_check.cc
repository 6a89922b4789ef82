#include "native_model/trajectory/range_check.h"

#include <cstdio>

#include "native_model/bearing/actuator_axes.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

std::string out_of_range(const Model& m, const double* q, double penetration) {
  char text[160];
  if (m.contact && !(penetration <= m.contact->clearance)) {
    std::snprintf(text, sizeof text,
                  "the rotor is %.3g m outside the ring, more than the clearance of %.3g m",
                  penetration, m.contact->clearance);
    return text;
  }
  if (!m.magnets || !m.layout.stator) return {};
  const double ring = to_axes(stator_point(m, q)).cwiseAbs().maxCoeff();
  if (ring <= m.magnets->law->reach()) return {};
  std::snprintf(text, sizeof text,
                "the ring is %.3g m along an axis of the magnets, beyond their air gap of %.3g m", ring,
                m.magnets->law->reach());
  return text;
}

}  // namespace rotorub
