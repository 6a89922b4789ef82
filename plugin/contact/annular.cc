#include "plugin/contact/annular.h"

#include <cmath>

#include "native_model/contact/kinematics.h"

namespace rotorub::plugin {

int collide_annular(const Config& config, const mjData* d, CollisionContact* con, int g1,
                    double margin) {
  const ContactParameters& c = *config.model.contact;
  const mjtNum* rotor = d->geom_xpos + 3 * config.rotor_geom;
  // The ring's geom is a rod beside the plane; its x and y are the ring's.
  const mjtNum* ring = d->geom_xpos + 3 * config.ring_geom;
  const double dx = rotor[0] - ring[0], dy = rotor[1] - ring[1];
  const double delta = std::sqrt(dx * dx + dy * dy);
  const double gap = c.clearance - delta;
  if (!(gap < margin) || delta <= kNoNormal) return 0;

  const double ex = dx / delta, ey = dy / delta;
  // MuJoCo's normal points from geom 1 to geom 2; a force on geom 2 along it is positive. The disc
  // presses the ring outward.
  const double side = g1 == config.rotor_geom ? 1.0 : -1.0;
  con->dist = gap;
  con->pos[0] = rotor[0] + c.radius * ex;
  con->pos[1] = rotor[1] + c.radius * ey;
  con->pos[2] = rotor[2];
  set_frame(con, {side * ex, side * ey, 0.0}, {-side * ey, side * ex, 0.0}, {0.0, 0.0, 1.0});
  return 1;
}

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
