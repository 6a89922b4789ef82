// One contact in MuJoCo's coordinates: (relative x, relative y, spin) = J qvel, with MuJoCo's mass
// matrix M and the matrix H of its step (step_matrix.h). J is of bodies (BodySpace) or of the modal
// chain (ChainSpace); the rows live on the stack of mjData.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <variant>

#include "native_model/contact/coupled_law.h"
#include "native_model/contact/kinematics.h"
#include "plugin/contact/step_matrix.h"
#include "plugin/model/config.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

class ContactSpace {
 public:
  ContactSpace(const ContactSpace&) = delete;
  ContactSpace& operator=(const ContactSpace&) = delete;

  Eigen::Vector3d rates(const mjtNum* v) const { return product(jacobian_, v); }  // J v
  virtual Eigen::Vector3d response(const mjtNum* f) const {
    return product(damped_, f);
  }                                                                          // J H^-1 f
  Eigen::Matrix3d flexibility() const { return gram(damped_); }              // J H^-1 J^T
  Eigen::Matrix3d admittance() const { return gram(plain()); }               // J M^-1 J^T
  bool damped() const { return damped_ != plain_; }                          // H is not M
  const mjtNum* acceleration_row(int k) const { return plain() + k * nv_; }  // row k of J M^-1

  // J H^-1 J_other^T and J M^-1 J_other^T: what a load of another contact does here.
  Eigen::Matrix3d flexibility(const ContactSpace& other) const { return gram(damped_, other); }
  Eigen::Matrix3d admittance(const ContactSpace& other) const { return gram(plain(), other); }

  // to += J^T load, load: (x, y, torque) on the rotor.
  virtual void add_load(const Eigen::Vector3d& load, mjtNum* to) const {
    add_rows(jacobian_, load, to);
  }
  // The accelerations without the contact, J M^-1 f of qfrc_smooth.
  virtual Eigen::Vector3d smooth() const { return rates(d_->qacc_smooth); }
  // What MuJoCo is given beside the normal force that its solver finds, for the contact's load
  // normal + friction: to += J^T friction, and the acceleration by it.
  virtual void add_side(const Eigen::Vector3d& /*normal*/, const Eigen::Vector3d& friction,
                        mjtNum* to) const {
    add_load(friction, to);
  }
  virtual void add_side_acceleration(const Eigen::Vector3d& /*normal*/,
                                     const Eigen::Vector3d& friction, mjtNum* to) const {
    add_acceleration(friction, to);
  }
  // to += M^-1 J^T load.
  void add_acceleration(const Eigen::Vector3d& load, mjtNum* to) const {
    add_rows(plain(), load, to);
  }
  // Calls add_impact or add_load.
  void add(const Eigen::Vector3d& load, bool impact, mjtNum* to) const {
    impact ? add_impact(load, to) : add_load(load, to);
  }
  // to += H M^-1 J^T load, so that the step's dampers take nothing from the impulse.
  void add_impact(const Eigen::Vector3d& load, mjtNum* to) const {
    add_load(load, to);
    StackFrame room(d_);
    mjtNum* change = room.numbers(nv_);
    std::fill_n(change, nv_, 0.0);
    add_acceleration(load, change);
    for (const DofRange& tree : trees_) matrix_.add_excess(tree, change, to);
  }

 protected:
  // `matrix` must outlive the space.
  ContactSpace(const mjModel* m, mjData* d, const StepMatrix& matrix)
      : d_(d), matrix_(matrix), nv_(count(m->nv)) {}
  virtual ~ContactSpace() = default;

  Eigen::Vector3d product(const mjtNum* rows, const mjtNum* v) const {
    return {mju_dot(rows, v, nv_), mju_dot(rows + nv_, v, nv_), mju_dot(rows + 2 * nv_, v, nv_)};
  }

  // Fills plain_ when it is first asked for: a lasting contact never does.
  virtual void solve_plain() const {}
  const mjtNum* plain() const {
    if (!plain_known_) solve_plain();
    plain_known_ = true;
    return plain_;
  }

  mjData* d_;
  const StepMatrix& matrix_;
  DofRange trees_[2];  // of rotor and ring; the second empty where they share one
  int nv_;
  mutable bool plain_known_ = false;
  mjtNum *jacobian_ = nullptr, *plain_ = nullptr, *damped_ = nullptr;  // 3 x nv

  void add_rows(const mjtNum* rows, const Eigen::Vector3d& load, mjtNum* to) const {
    for (int k = 0; k < 3; ++k) mju_addToScl(to, rows + k * nv_, load[k], nv_);
  }

 private:
  Eigen::Matrix3d gram(const mjtNum* rows) const {
    Eigen::Matrix3d g;
    for (int j = 0; j < 3; ++j) g.col(j) = product(rows, jacobian_ + j * nv_);
    // The matrix of an implicit step may be unsymmetric. Its antisymmetric part does not change the
    // rate along the load itself.
    return 0.5 * (g + g.transpose());
  }
  Eigen::Matrix3d gram(const mjtNum* rows, const ContactSpace& other) const {
    Eigen::Matrix3d g;
    for (int j = 0; j < 3; ++j) g.col(j) = product(rows, other.jacobian_ + j * nv_);
    return g;
  }
};

// The contact of a user's own model in contact space: (relative x, relative y, spin) = J qvel along
// the axes of the ring's geom, z the ring's axis, with MuJoCo's own Jacobians and mass matrix. The
// ring may move, tilt and turn. Relative x and y are of the rotor's centre and the point of the
// ring's axis beside it, so that a turning ring alone does not move them; the spin is
//   Omega - (1 + delta / r) Omega_ring,
// as the ring's surface is at r + delta from its axis: gdot_T = e_t . (x, y)' + r spin. In contact
// that is the native model's R / r (ContactParameters::surface_ratio); a step before the touch
// rotor and ring are still pressed at one point, so that no angular momentum is lost.

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
// omega_y) (relative_motion.h).
enum class BodyRows { kPlane, kAxis };

// W_Z in the space of BodyRows::kAxis: gdot_Z of its rates, and the load of a friction of 1 along
// the axis.
inline Eigen::Vector3d axial_column(const Eigen::Vector2d& e_r, double radius) {
  return {1.0, radius * e_r.y(), -radius * e_r.x()};
}

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

// The contact of a generated model on the modal chain in contact space: J constant, the mode values
// at the contact; M(phi) and M(phi) + h D by the native model, where unbalance and a drive couple
// spin and bending. MuJoCo's own matrix, H0, is diagonal: a load p that is to act through M(phi) +
// h D is handed over as H0 (M(phi) + h D)^-1 p.

// Lives on the stack of mjData for as long as the object does.
class ChainSpace final : public ContactSpace {
 public:
  // bearing: in model.auxiliary.
  ChainSpace(const Config& config, std::size_t bearing, const mjModel* m, mjData* d,
             const StepMatrix& matrix);

  // Of MuJoCo's forces, which have been through H0 (M(phi) + h D)^-1 already
  // (add_passive_force).
  Eigen::Vector3d response(const mjtNum* f) const override;
  // With the masses of the native model: MuJoCo's links weigh a little.
  Eigen::Vector3d smooth() const override { return product(plain_, d_->qfrc_smooth); }
  void add_load(const Eigen::Vector3d& load, mjtNum* to) const override;
  void add_side(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                mjtNum* to) const override;
  void add_side_acceleration(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                             mjtNum* to) const override;

 private:
  const Config& config_;
  StackFrame room_;
  mjtNum* step_mass_;  // nq
};

// The directions of a contact's impulses (or forces) p = (normal, friction on the rotor along e_t,
// friction along the ring's axis) in its space, or spaces where it moves along its axis too.
struct ContactRows {
  const ContactSpace* plane = nullptr;
  const ContactSpace* axial = nullptr;  // of BodyRows::kAxis; null: it does not move along its axis
  Eigen::Vector2d e_r{1.0, 0.0};
  double radius = 0.0;  // m

  const ContactSpace& space(Eigen::Index k) const { return k == 2 ? *axial : *plane; }
  // The load in space(k) of a p_k of 1: W_N, W_T, W_Z.
  Eigen::Vector3d column(Eigen::Index k) const;
  // Calls action(space, load) for p as it is in each space.
  template <typename Action>
  void for_each_load(const Eigen::Vector3d& p, Action action) const {
    action(*plane, contact_load(e_r, radius, p.x(), p.y()));
    if (axial && p.z() != 0.0) action(*axial, p.z() * column(2));
  }
  // Gap rate, slip and slip along the axis of the rates of(space), or their accelerations.
  template <typename Of>
  Eigen::Vector3d along(Of of) const {
    const Eigen::Vector2d y = rates_along(e_r, radius, of(*plane));
    return {y.x(), y.y(), axial ? column(2).dot(of(*axial)) : 0.0};
  }
};

// The spaces of the contacts of a pass, each in its form, ready to be asked. On the stack of
// mjData: the last made goes first.
class ContactSpaces {
 public:
  // After mj_fwdActuation. config must outlive it.
  ContactSpaces(const Config& config, const mjModel* m, mjData* d)
      : config_(config), m_(m), d_(d), matrix_(m, d) {}
  ~ContactSpaces();
  ContactSpaces(const ContactSpaces&) = delete;
  ContactSpaces& operator=(const ContactSpaces&) = delete;

  struct Made {
    ContactPlace place;
    const ContactSpace* plane;
    const ContactSpace* axial;  // null: it does not move along its axis
  };
  Made add(const ContactPair& pair);  // at most kMaxContacts

 private:
  struct Spaces {
    std::variant<std::monostate, BodySpace, ChainSpace> plane;
    std::optional<BodySpace> axial;
  };
  const Config& config_;
  const mjModel* m_;
  mjData* d_;
  StepMatrix matrix_;
  std::array<Spaces, kMaxContacts> all_;
  std::size_t count_ = 0;
};

// What p_j of each contact does to the rates of each, `rows` (2, or 3 where one of them moves along
// its axis) numbers a contact: by H for loads over the step, by M for impacts.
ContactMatrix contact_matrix(std::span<const ContactRows* const> contacts, Eigen::Index rows,
                             bool impact);

}  // namespace rotorub::plugin
