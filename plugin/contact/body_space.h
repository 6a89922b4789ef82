// The contact of a user's own model in contact space: (relative x, relative y, spin) = J qvel along
// the axes of the ring's geom, z the ring's axis, with MuJoCo's own Jacobians and mass matrix. The
// ring may move, tilt and turn. Relative x and y are of the rotor's centre and the point of the
// ring's axis beside it, so that a turning ring alone does not move them; the spin is
//   Omega - (1 + delta / r) Omega_ring,
// as the ring's surface is at r + delta from its axis: gdot_T = e_t . (x, y)' + r spin. In contact
// that is the native model's R / r (ContactParameters::surface_ratio); a step before the touch
// rotor and ring are still pressed at one point, so that no angular momentum is lost.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "plugin/config.h"
#include "plugin/contact/contact_space.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

// The frame of the contact, columns x, y, z, row by row.
const mjtNum* contact_axes(const ContactPair& pair, const mjData* d);
// Where the rotor's centre is in the ring, m.
Eigen::Vector2d position_of(const ContactPair& pair, const mjData* d);
// Whether rotor and ring overlap along the ring's axis.
bool face_each_other(const ContactPair& pair, const mjData* d);

// Where a contact is looked at.
struct ContactPlace {
  const mjtNum* axes;
  mjtNum ring_point[3];  // m, of the ring's axis, beside the rotor's centre
  Eigen::Vector2d d;     // m, position_of
  double ring_spin;      // 1 + delta / r
};
ContactPlace contact_place(const ContactPair& pair, const mjData* d);
// The part of d^2/dt^2 of `d` that is there without any acceleration of a coordinate, J' qvel,
// m/s^2: of centres that go in circles. After MuJoCo's velocity stage.
Eigen::Vector2d turning_of(const ContactPair& pair, const ContactPlace& place, const mjModel* m,
                           const mjData* d);

// kAxis: (velocity along the ring's axis, tilt rates about x and y) instead, the ring's tilt
// weighed as its spin is: the contact's slip along the axis is z' + r (e_r,y omega_x - e_r,x
// omega_y) (axial_motion.h).
enum class BodyRows { kPlane, kAxis };

// Lives on the stack of mjData for as long as the object does; the last made goes first.
class BodySpace final : public ContactSpace {
 public:
  BodySpace(const ContactPair& pair, const ContactPlace& place, const mjModel* m, mjData* d,
            const StepMatrix& matrix, BodyRows rows = BodyRows::kPlane);

  // Solves with M and H; needed once, before all but `rates` and `add_load`.
  void solve();

 private:
  void add_body(const mjtNum* axes, const mjtNum* point, int body, double sign, double spin);
  void solve_plain() const override;

  const mjModel* m_;
  BodyRows rows_;
  StackFrame room_;
};

}  // namespace rotorub::plugin
