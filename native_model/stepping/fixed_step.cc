#include "native_model/stepping/fixed_step.h"

#include "native_model/contact/kinematics.h"
#include "native_model/model/dynamics.h"

namespace rotorub {

Impact impact_of(double t, const Eigen::Vector2d& impulses, const Eigen::Vector2d& before,
                 const Eigen::Vector2d& after, std::size_t contact) {
  const double energy = impulse_work(impulses.x(), impulses.y(), before, after).total();
  return {t,          impulses.x(), impulses.y(),
          before.x(), after.x(),    before.y(),
          after.y(),  energy,       static_cast<int>(contact)};
}

double impact_work(const Model& m, std::span<const Impact> impacts) {
  double work = 0.0;
  for (const Impact& hit : impacts) {
    const double radius = m.auxiliary[static_cast<std::size_t>(hit.contact)].contact->radius;
    work += hit.energy_change - hit.friction_impulse * (radius * m.prescribed_spin());
  }
  return work;
}

double lasting_work(const Model& m, std::size_t contact, const Eigen::Vector2d& e_r,
                    const Eigen::Vector2d& impulses, const Eigen::Vector3d& mean_rates) {
  if (!(impulses.x() > 0.0)) return 0.0;
  const Eigen::Vector3d load =
      contact_load(e_r, m.auxiliary[contact].contact->radius, impulses.x(), impulses.y());
  return load.dot(mean_rates - Eigen::Vector3d(0.0, 0.0, m.prescribed_spin()));
}

}  // namespace rotorub
