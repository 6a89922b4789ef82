// One contact of `coulomb` in accelerations (coulomb.h), of one or two spaces.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "native_model/contact/kinematics.h"
#include "plugin/config.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/relative_motion.h"

namespace rotorub::plugin {

struct TouchingPair {
  const ContactPair* pair = nullptr;
  const ContactSpace* space = nullptr;
  const ContactSpace* axial = nullptr;  // of one that moves along its ring's axis (axial_motion.h)
  int row = 0;                          // of MuJoCo's solver
  ContactPoint point;
  Eigen::Vector3d base;    // m/s^2, of y what is not the acceleration of a coordinate
  double curvature = 0.0;  // m/s^2, towards the ring, with that of centres that go in circles
  bool touches = false;
  Eigen::Vector3d force{0.0, 0.0, 0.0};  // N, (normal, friction, friction along the axis)
  bool sticks = false;

  mjtNum* entry(mjData* d) const { return d->userdata + pair->data; }
  Eigen::Vector3d load(double normal, double friction) const {
    return contact_load(point.e_r, pair->contact.radius, normal, friction);
  }
  Eigen::Vector3d column() const { return axial_column(point.e_r, pair->contact.radius); }
  // Calls action(space, load) for a force f as it is in each space.
  template <typename Action>
  void for_each_load(const Eigen::Vector3d& f, Action action) const {
    action(*space, load(f.x(), f.y()));
    if (axial && f.z() != 0.0) action(*axial, f.z() * column());
  }
  // Of the force, what MuJoCo is given beside what its solver finds.
  void add_side(mjtNum* to) const {
    space->add_side(load(force.x(), 0.0), load(0.0, force.y()), to);
    if (axial && force.z() != 0.0) axial->add_load(force.z() * column(), to);
  }
  // The accelerations by all of it.
  void add_acceleration(mjtNum* to) const {
    const Eigen::Vector3d normal = load(force.x(), 0.0);
    space->add_acceleration(normal, to);
    space->add_side_acceleration(normal, load(0.0, force.y()), to);
    if (axial && force.z() != 0.0) axial->add_acceleration(force.z() * column(), to);
  }
  // y = base + this of the coordinates' accelerations, of(space).
  template <typename Of>
  Eigen::Vector3d along(Of of) const {
    const Eigen::Vector3d a = of(*space);
    return {-point.e_r.dot(a.head<2>()),
            point.e_t().dot(a.head<2>()) + pair->contact.radius * a.z(),
            axial ? column().dot(of(*axial)) : 0.0};
  }
};

// row: of MuJoCo's solver; axial: null where it does not move along its axis.
TouchingPair touching_pair(const ContactPair& pair, const ContactPlace& place,
                           const ContactSpace& space, const ContactSpace* axial, const mjModel* m,
                           const mjData* d, int row);

}  // namespace rotorub::plugin
