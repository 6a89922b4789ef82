// The motion of a rotor relative to its ring: the motions that their joints allow, and the present
// one.
//
// If they can move relative to each other along the ring's axis, the contact slips in two
// directions: along the ring's circle, and along its axis with
//   gdot_Z = z' + r (e_r,y omega_x - e_r,x omega_y).
// z' is the velocity of the rotor's centre against the nearest point of the ring's axis; omega is
// the tilt rate of the rotor minus 1 + delta / r times that of the ring. gdot_Z is thus the motion
// at the point of contact. Friction opposes both slips together (native_model/contact/disc_law.h).
//
// If the centres stay in the contact plane, the planar law applies. A rotor that only tilts about a
// point of the axis does slip along it, by the tilt rate times r, but linear rotor dynamics leaves
// this out.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <optional>

#include "native_model/contact/contact_list.h"
#include "native_model/contact/kinematics.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {

// True if the contact has friction and a joint moves the rotor's centre or the ring along the axis;
// a hinge counts if its lever arm is longer than a clearance. Determined at qpos0.
bool slides_along_axis(const mjModel* m, const ContactPair& pair);

// True if the axis of a round rotor (cylinder, capsule; other shapes have none) is tilted from its
// ring's axis by 60 degrees or more at qpos0. A disc cannot lie in its ring like that.
bool lies_across(const mjModel* m, const ContactPair& pair);

// Three numbers of MuJoCo as a vector, and nine as the matrix with the columns x, y, z of a frame.
inline Eigen::Map<const Eigen::Vector3d> vector_at(const mjtNum* numbers) {
  return Eigen::Map<const Eigen::Vector3d>(numbers);
}
inline auto axes_at(const mjtNum* numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers);
}

// The place of a contact, and the point at which its rates are taken.
struct ContactPlace {
  const mjtNum* axes;       // frame of the contact, with the columns x, y, z, stored row by row
  mjtNum ring_point[3];     // m, point of the ring's axis nearest to the rotor's centre
  Eigen::Vector2d d;        // m, the rotor's centre relative to the ring's, along x and y
  double along;             // m, the same along z, the ring's axis
  double ring_spin_factor;  // 1 + delta / r
};
ContactPlace contact_place(const ContactPair& pair, const mjData* d);
// True if rotor and ring overlap along the ring's axis.
inline bool face_each_other(const ContactPair& pair, const ContactPlace& place) {
  return pair.in_world || std::abs(place.along) <= pair.reach;
}

// Gap, rates and slip of the state. Call it after MuJoCo's velocity stage.
ContactPoint contact_point_of(const ContactPair& pair, const mjModel* m, const mjData* d);

// The motion of one contact in a pass. Each part is computed when it is first needed, after
// MuJoCo's velocity stage.
class PairMotion {
 public:
  PairMotion() {}  // not = default, which would set all bytes of a list to 0
  PairMotion(const ContactPair& pair, const mjModel* m, const mjData* d)
      : pair_(&pair), m_(m), d_(d) {}

  const ContactPlace& place();
  // (relative x, relative y, spin) as in a BodySpace (contact_space.h).
  const Eigen::Vector3d& rates();
  ContactPoint point();
  // The part of d^2/dt^2 of `place().d` that exists without any acceleration of a coordinate,
  // J' qvel, m/s^2. It comes from centres that move on circles.
  const Eigen::Vector2d& turning();

 private:
  const ContactPair* pair_ = nullptr;
  const mjModel* m_ = nullptr;
  const mjData* d_ = nullptr;
  std::optional<ContactPlace> place_;
  std::optional<Eigen::Vector3d> rates_;
  std::optional<Eigen::Vector2d> turning_;
};

// The motions of all contacts in a pass. Neither places nor velocities may change while it lives.
class PassMotion {
 public:
  PassMotion(const Config& config, const mjModel* m, const mjData* d) : config_(config) {
    for (const ContactPair& pair : config.pairs) all_.push_back({pair, m, d});
  }
  PairMotion& of(const ContactPair& pair) {
    return all_[static_cast<std::size_t>(&pair - config_.pairs.data())];
  }

 private:
  const Config& config_;
  ContactList<PairMotion> all_;
};

// Decides whether the rotor can reach the ring within the step at all, by a bound that needs
// neither Jacobians nor the contact's own matrix. Nearly every step of a flight ends here. It is
// used for the contacts of a pass, one after the other; the effect of loads and constraints is
// computed once, when it is first needed. Call it after update_smooth_force.
class Reach {
 public:
  Reach(const mjModel* m, mjData* d) : m_(m), d_(d) {}

  // False if neither loads nor constraints can bring the rotor to the ring in this step; other
  // contacts of the plugin are not considered.
  //
  // In the metric of M the loads change the velocities by at most h |f|, |f|^2 = f^T M^-1 f.
  // MuJoCo's constraints, which minimise |a - a_smooth|^2 / 2 + s(J a - aref), change them by at
  // most h sqrt(2 s(J a_smooth - aref)), where 2 s <= sum of D_i (J a_smooth - aref)_i^2. A point
  // at the distance r from the centre of mass of a body with the mass m_b and the least inertia I_b
  // moves by at most sqrt(1 / m_b + r^2 / I_b) times that, and on slides with the masses m_i by at
  // most sqrt(sum of 1 / m_i) times that.
  bool may_reach(const ContactPair& pair, PairMotion& motion);

 private:
  const mjModel* m_;
  mjData* d_;
  double change_ = -1.0;  // change of the velocities per second in the metric of M; < 0: unknown
};

}  // namespace rotorub::plugin
