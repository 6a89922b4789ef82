// One contact in MuJoCo's coordinates: (relative x, relative y, spin) = J qvel, with MuJoCo's mass
// matrix M and the matrix H of its step (step_matrix.h). J belongs to bodies (BodySpace) or to the
// modal chain (ChainSpace). The rows are on the stack of mjData.
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
#include "plugin/contact/relative_motion.h"
#include "plugin/contact/step_matrix.h"
#include "plugin/model/config.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

class ContactSpace {
 public:
  ContactSpace(const ContactSpace&) = delete;
  ContactSpace& operator=(const ContactSpace&) = delete;

  Eigen::Vector3d rates(const mjtNum* v) const { return product(jacobian_, v); }  // J v
  // J H^-1 f
  virtual Eigen::Vector3d response(const mjtNum* f) const { return product(damped_, f); }
  Eigen::Matrix3d step_admittance() const { return gram(damped_); }  // J H^-1 J^T
  Eigen::Matrix3d admittance() const { return gram(plain()); }       // J M^-1 J^T
  bool damped() const { return damped_ != plain_; }                  // true if H differs from M
  const mjtNum* acceleration_row(int k) const { return plain() + k * nv_; }  // row k of J M^-1

  // J H^-1 J_other^T and J M^-1 J_other^T: the effect of another contact's load on this one.
  Eigen::Matrix3d step_admittance(const ContactSpace& other) const { return gram(damped_, other); }
  Eigen::Matrix3d admittance(const ContactSpace& other) const { return gram(plain(), other); }

  // to += J^T load, where load is (x, y, torque) on the rotor.
  virtual void add_load(const Eigen::Vector3d& load, mjtNum* to) const {
    add_rows(jacobian_, load, to);
  }
  // The accelerations without the contact, J M^-1 f with f = qfrc_smooth.
  Eigen::Vector3d smooth() const { return product(plain(), d_->qfrc_smooth); }
  // MuJoCo's solver supplies the normal force of a soft contact. These functions add the remainder
  // of the load normal + friction: add_remainder() adds the generalised force, by default J^T
  // friction, and add_remainder_acceleration() the acceleration that it causes.
  virtual void add_remainder(const Eigen::Vector3d& /*normal*/, const Eigen::Vector3d& friction,
                             mjtNum* to) const {
    add_load(friction, to);
  }
  virtual void add_remainder_acceleration(const Eigen::Vector3d& /*normal*/,
                                          const Eigen::Vector3d& friction, mjtNum* to) const {
    add_acceleration(friction, to);
  }
  // to += M^-1 J^T load.
  void add_acceleration(const Eigen::Vector3d& load, mjtNum* to) const {
    add_rows(plain(), load, to);
  }
  // Like add_load, but for an impact to += H M^-1 J^T load. The factor H M^-1 compensates the
  // step's dampers, which would reduce the impulse.
  void add(const Eigen::Vector3d& load, bool impact, mjtNum* to) const {
    add_load(load, to);
    if (!impact) return;
    StackFrame room(d_);
    mjtNum* change = room.numbers(nv_);
    std::fill_n(change, nv_, 0.0);
    add_acceleration(load, change);
    for (const DofRange& tree : trees_) matrix_.add_excess(tree, change, to);
  }

 protected:
  // `matrix` must outlive the space.
  ContactSpace(const mjModel* m, mjData* d, StepMatrix& matrix)
      : d_(d), matrix_(matrix), nv_(count(m->nv)) {}
  virtual ~ContactSpace() = default;

  Eigen::Vector3d product(const mjtNum* rows, const mjtNum* v) const {
    return {mju_dot(rows, v, nv_), mju_dot(rows + nv_, v, nv_), mju_dot(rows + 2 * nv_, v, nv_)};
  }

  // Fills plain_ when it is first needed. A single lasting contact without constraint rows never
  // needs it.
  virtual void solve_plain() const {}
  const mjtNum* plain() const {
    if (!plain_known_) solve_plain();
    plain_known_ = true;
    return plain_;
  }

  mjData* d_;
  StepMatrix& matrix_;
  DofRange trees_[2];  // of rotor and ring; the second one is empty if they share a tree
  int nv_;
  mutable bool plain_known_ = false;
  mjtNum *jacobian_ = nullptr, *plain_ = nullptr, *damped_ = nullptr;  // 3 x nv: J, J M^-1, J H^-1

  void add_rows(const mjtNum* rows, const Eigen::Vector3d& load, mjtNum* to) const {
    for (int k = 0; k < 3; ++k) mju_addToScl(to, rows + k * nv_, load[k], nv_);
  }

 private:
  Eigen::Matrix3d gram(const mjtNum* rows) const {
    const Eigen::Matrix3d g = gram(rows, *this);
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

// A contact between bodies in contact space, for all contacts that are not on the modal chain:
// (relative x, relative y, spin) = J qvel along the axes of the contact, z along the ring's axis,
// with MuJoCo's own Jacobians and mass matrix. The ring may move, tilt and turn. Relative x and y
// are measured from the nearest point of the ring's axis to the rotor's centre, so that a ring that
// only turns does not change them. The spin is
//   Omega - (1 + delta / r) Omega_ring,
// because the ring's surface is at r + delta from its axis: gdot_T = e_t . (x, y)' + r spin. In
// contact 1 + delta / r equals R / r of the native model (ContactParameters::surface_ratio). If the
// step begins before the touch, rotor and ring still act on each other at a common point, so that
// no angular momentum is lost.

// kPlane: the rows above. kAxis: (velocity along the ring's axis, tilt rates about x and y)
// instead, where the ring's tilt rate has the same factor as its spin. The contact's slip along the
// axis is z' + r (e_r,y omega_x - e_r,x omega_y) (relative_motion.h).
enum class BodyRows { kPlane, kAxis };

// W_Z in the space of BodyRows::kAxis: its product with the rates is gdot_Z, and it is the load of
// a unit friction force along the axis.
inline Eigen::Vector3d axial_column(const Eigen::Vector2d& e_r, double radius) {
  return {1.0, radius * e_r.y(), -radius * e_r.x()};
}

// Uses the stack of mjData during its lifetime. Destroy the last one first.
class BodySpace final : public ContactSpace {
 public:
  BodySpace(const ContactPair& pair, const ContactPlace& place, const mjModel* m, mjData* d,
            StepMatrix& matrix, BodyRows rows = BodyRows::kPlane);

 private:
  void add_body(const mjtNum* axes, const mjtNum* point, int body, double sign, double spin);
  void solve();  // computes J H^-1; J M^-1 follows when it is needed
  void solve_plain() const override;

  const mjModel* m_;
  BodyRows rows_;
  StackFrame room_;
};

// The contact of a generated model on the modal chain in contact space. J is constant and contains
// the mode values at the contact. M(phi) and M(phi) + h D come from the native model, where
// unbalance and a drive couple spin and bending. MuJoCo's own matrix H0 is diagonal: a load p that
// must act through M(phi) + h D is handed to MuJoCo as H0 (M(phi) + h D)^-1 p.

// Uses the stack of mjData during its lifetime.
class ChainSpace final : public ContactSpace {
 public:
  // bearing: index in model.auxiliary.
  ChainSpace(const Config& config, std::size_t bearing, const mjModel* m, mjData* d,
             StepMatrix& matrix);

  // For MuJoCo's forces, which already contain the factor H0 (M(phi) + h D)^-1 (add_passive_force).
  Eigen::Vector3d response(const mjtNum* f) const override;
  void add_load(const Eigen::Vector3d& load, mjtNum* to) const override;
  void add_remainder(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                     mjtNum* to) const override;
  void add_remainder_acceleration(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                                  mjtNum* to) const override;

 private:
  const Config& config_;
  StackFrame room_;
  mjtNum* step_mass_;  // nq
};

// The directions of a contact's impulses (or forces) p = (normal, friction on the rotor along e_t,
// friction along the ring's axis) in its space, or in its two spaces if it also moves along its
// axis.
struct ContactRows {
  const ContactSpace* plane = nullptr;
  const ContactSpace* axial = nullptr;  // of BodyRows::kAxis; null: no motion along the axis
  Eigen::Vector2d e_r{1.0, 0.0};
  double radius = 0.0;  // m

  const ContactSpace& space(Eigen::Index k) const { return k == 2 ? *axial : *plane; }
  // The load in space(k) for p_k = 1: W_N, W_T, W_Z.
  Eigen::Vector3d column(Eigen::Index k) const;
  // Calls action(space, load) with the load of p in each space.
  template <typename Action>
  void for_each_load(const Eigen::Vector3d& p, Action action) const {
    action(*plane, contact_load(e_r, radius, p.x(), p.y()));
    if (axial && p.z() != 0.0) action(*axial, p.z() * column(2));
  }
  // (gap rate, slip, slip along the axis) for the rates of(space); also for accelerations.
  template <typename Of>
  Eigen::Vector3d contact_rates(Of of) const {
    const Eigen::Vector2d y = rates_along(e_r, radius, of(*plane));
    return {y.x(), y.y(), axial ? column(2).dot(of(*axial)) : 0.0};
  }
};

// The spaces of the contacts of a pass. They use the stack of mjData: the last one made is
// destroyed first.
class ContactSpaces {
 public:
  // Make it after mj_fwdActuation. config must outlive it.
  ContactSpaces(const Config& config, const mjModel* m, mjData* d)
      : config_(config), m_(m), d_(d), matrix_(m, d) {}
  ~ContactSpaces();
  ContactSpaces(const ContactSpaces&) = delete;
  ContactSpaces& operator=(const ContactSpaces&) = delete;

  struct PairSpaces {
    const ContactSpace* plane;
    const ContactSpace* axial;  // null: no motion along the axis
  };
  // place: of the pair in this pass. At most kMaxContacts.
  PairSpaces add(const ContactPair& pair, const ContactPlace& place);

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

// The effect of each contact's p_j on the rates of all contacts, with `rows` numbers for each
// contact (2, or 3 if one of them moves along its axis): by H for loads over the step, by M for
// impacts.
ContactMatrix contact_matrix(std::span<const ContactRows* const> contacts, Eigen::Index rows,
                             bool impact);

}  // namespace rotorub::plugin
