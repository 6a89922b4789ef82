#include "plugin/twin/linear_machine.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "plugin/message.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTurns = 4;            // angles of the rotor that means are of
constexpr double kNudge = 1e-5;      // m, rad
constexpr double kSlow = 1.0;        // rad/s, where the rotor stands still
constexpr double kParallel = 1e-9;   // of directions, 1 or m
constexpr int kTorques = 9;

struct DeleteData {
  void operator()(mjData* d) const { mj_deleteData(d); }
};

// One pose of the machine.
class Probe {
 public:
  Probe(const mjModel* m, const Config& config, const mjData* start)
      : m_(m), config_(config), d_(mj_makeData(m)) {
    if (!d_) throw ConfigError("rotorub: no memory for mjData");
    std::copy_n(start->ctrl, m->nu, d_->ctrl);
    std::copy_n(start->act, m->na, d_->act);
    pose(VectorXd::Zero(m->nv));
    // The contact's axes are those of the ring's geom at rest.
    const mjtNum* axes = d_->geom_xmat + 9 * config.ring_geom;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) axes_(i, k) = axes[3 * k + i];  // rows: x, y, z
    }
  }

  // qpos0 moved by q, at rest.
  void pose(const VectorXd& q) {
    std::copy_n(m_->qpos0, m_->nq, d_->qpos);
    mj_integratePos(m_, d_->qpos, q.data(), 1.0);
    mj_kinematics(m_, d_.get());
    mj_comPos(m_, d_.get());
    make_mass(m_, d_.get());
    mj_tendon(m_, d_.get());
    mj_transmission(m_, d_.get());
  }

  MatrixXd mass() const {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> full(m_->nv, m_->nv);
    full_mass(m_, d_.get(), full.data());
    return full;
  }

  // All forces but constraints and contacts, at velocities v.
  VectorXd force(const VectorXd& v) {
    std::copy_n(v.data(), m_->nv, d_->qvel);
    mj_fwdVelocity(m_, d_.get());
    mj_fwdActuation(m_, d_.get());
    VectorXd f(m_->nv);
    for (int i = 0; i < m_->nv; ++i) {
      f[i] = d_->qfrc_passive[i] + d_->qfrc_actuator[i] - d_->qfrc_bias[i];
    }
    return f;
  }

  Eigen::Vector3d place(int geom) const { return axes_ * vector(d_->geom_xpos + 3 * geom); }
  Eigen::Vector2d apart() const {
    return (place(config_.rotor_geom) - place(config_.ring_geom)).head<2>();
  }

  // 6 x nv: of a point that moves with the body, then of its rotation; in the contact's axes.
  MatrixXd jacobian(const Eigen::Vector3d& world, int body) const {
    using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
    Rows move(3, m_->nv), turn(3, m_->nv);
    mj_jac(m_, d_.get(), move.data(), turn.data(), world.data(), body);
    MatrixXd all(6, m_->nv);
    all << axes_ * move, axes_ * turn;
    return all;
  }
  MatrixXd geom_jacobian(int geom) const {
    return jacobian(vector(d_->geom_xpos + 3 * geom), m_->geom_bodyid[geom]);
  }

  const Eigen::Matrix3d& axes() const { return axes_; }
  const mjData* data() const { return d_.get(); }

  static Eigen::Vector3d vector(const mjtNum* x) { return {x[0], x[1], x[2]}; }

 private:
  const mjModel* m_;
  const Config& config_;
  std::unique_ptr<mjData, DeleteData> d_;
  Eigen::Matrix3d axes_;
};

// The joint that turns the rotor about the contact's axis and does not move its centre.
int find_spin(const mjModel* m, const Config& config, const Probe& probe) {
  const MatrixXd j = probe.geom_jacobian(config.rotor_geom);
  int found = -1;
  for (int i = 0; i < m->nv; ++i) {
    if (std::abs(j(5, i)) <= kParallel) continue;
    const int joint = m->dof_jntid[i];
    if (m->jnt_type[joint] != mjJNT_HINGE) {
      refuse(joint_element(m, joint), "turns the rotor, for a twin; accepted: one hinge about its axis");
    }
    const double off = j.col(i).head<2>().norm() + j.col(i).segment<2>(3).norm();
    if (off > kParallel || found >= 0) {
      refuse(joint_element(m, joint),
             found >= 0 ? "a second joint about the rotor's axis, for a twin; accepted: one"
                        : "turns the rotor about another axis than that of the ring's geom through "
                          "its centre, for a twin; accepted: that axis");
    }
    found = i;
  }
  return found;
}

void refuse_turning_ring(const mjModel* m, const Config& config, const Probe& probe) {
  const MatrixXd j = probe.geom_jacobian(config.ring_geom);
  for (int i = 0; i < m->nv; ++i) {
    if (std::abs(j(5, i)) <= kParallel) continue;
    refuse(joint_element(m, m->dof_jntid[i]),
           "turns the ring about its axis, for a twin; accepted: a ring that does not turn");
  }
}

bool moves_with(const mjModel* m, int body, int ancestor) {
  while (body > ancestor) body = m->body_parentid[body];
  return body == ancestor;
}

// The bodies whose centres of mass lie off the axis that they turn about.
std::vector<Eccentricity> find_unbalance(const mjModel* m, int spin, const Probe& probe) {
  constexpr double kNone = 1e-12;  // kg m
  std::vector<Eccentricity> all;
  if (spin < 0) return all;
  const int joint = m->dof_jntid[spin], turning = m->dof_bodyid[spin];
  const Eigen::Vector3d anchor = Probe::vector(probe.data()->xanchor + 3 * joint);
  const Eigen::Vector3d axis = Probe::vector(probe.data()->xaxis + 3 * joint);
  for (int body = turning; body < m->nbody; ++body) {
    if (!moves_with(m, body, turning) || m->body_mass[body] == 0.0) continue;
    const Eigen::Vector3d centre = Probe::vector(probe.data()->xipos + 3 * body);
    const Eigen::Vector3d foot = anchor + axis * axis.dot(centre - anchor);
    const Eigen::Vector3d arm = probe.axes() * (centre - foot);
    const double moment = m->body_mass[body] * arm.norm();
    if (moment <= kNone) continue;
    all.push_back({probe.jacobian(foot, turning).topRows<2>(), moment,
                   std::atan2(arm.y(), arm.x())});
  }
  return all;
}

// Means over a turn.
class Turned {
 public:
  Turned(const mjModel* m, int spin, Probe& probe)
      : nv_(count(m->nv)), spin_(spin), probe_(probe) {}

  VectorXd turn(int k) const {
    VectorXd q = VectorXd::Zero(nv_);
    if (spin_ >= 0) q[spin_] = 2.0 * std::numbers::pi * k / kTurns;
    return q;
  }
  int turns() const { return spin_ < 0 ? 1 : kTurns; }

  VectorXd force(const VectorXd& q, const VectorXd& v) {
    VectorXd sum = VectorXd::Zero(nv_);
    for (int k = 0; k < turns(); ++k) {
      probe_.pose(q + turn(k));
      sum += probe_.force(v);
    }
    return sum / turns();
  }

  // -df/dq and -df/dv, about velocities v.
  MatrixXd stiffness(const VectorXd& v) {
    MatrixXd k(nv_, nv_);
    for (int j = 0; j < nv_; ++j) {
      const VectorXd nudge = kNudge * VectorXd::Unit(nv_, j);
      k.col(j) = (force(-nudge, v) - force(nudge, v)) / (2.0 * kNudge);
    }
    return k;
  }
  MatrixXd damping(const VectorXd& v, double nudge) {
    const VectorXd rest = VectorXd::Zero(nv_);
    MatrixXd c(nv_, nv_);
    for (int j = 0; j < nv_; ++j) {
      const VectorXd change = nudge * VectorXd::Unit(nv_, j);
      c.col(j) = (force(rest, v - change) - force(rest, v + change)) / (2.0 * nudge);
    }
    return c;
  }

 private:
  int nv_, spin_;
  Probe& probe_;
};

// M, its mean and what turns in it.
void fill_mass(const Turned& turned, Probe& probe, LinearMachine& machine) {
  std::array<MatrixXd, kTurns> at;
  MatrixXd sum = MatrixXd::Zero(machine.rotor.cols(), machine.rotor.cols());
  for (int k = 0; k < turned.turns(); ++k) {
    probe.pose(turned.turn(k));
    at[static_cast<std::size_t>(k)] = probe.mass();
    sum += at[static_cast<std::size_t>(k)];
  }
  machine.mass = sum / turned.turns();
  if (turned.turns() == 1) return;
  // Each row and column in its own unit.
  const VectorXd scale = machine.mass.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd even = 0.25 * (at[0] + at[2] - at[1] - at[3]);
  machine.uneven_inertia =
      (scale.asDiagonal() * even * scale.asDiagonal()).cwiseAbs().maxCoeff();
  // b, the bending column of the spin, by the eccentric masses at angle 0.
  VectorXd b = VectorXd::Zero(scale.size());
  for (const Eccentricity& e : machine.unbalance) {
    b += machine.sense * e.static_moment * (-std::sin(e.phase) * e.jacobian.row(0).transpose() +
                                    std::cos(e.phase) * e.jacobian.row(1).transpose());
  }
  b[machine.spin] = 0.0;
  VectorXd met = 0.5 * (at[0] - at[2]).col(machine.spin);
  met[machine.spin] = 0.0;
  const VectorXd scaled = scale.cwiseProduct(met - b) * scale[machine.spin];
  machine.uneven_coupling = scaled.cwiseAbs().maxCoeff();
}

void fill_forces(const mjModel* m, const mjData* start, Turned& turned, LinearMachine& machine) {
  const VectorXd rest = VectorXd::Zero(m->nv);
  machine.force = turned.force(rest, rest);
  machine.stiffness = turned.stiffness(rest);
  machine.damping = turned.damping(rest, kSlow);
  machine.gyroscopic = MatrixXd::Zero(m->nv, m->nv);
  if (machine.spin < 0) return;
  const double speed = start->qvel[machine.spin];
  machine.speed = std::abs(speed) > kSlow ? speed : kSlow;
  const VectorXd spinning = machine.speed * VectorXd::Unit(m->nv, machine.spin);
  machine.gyroscopic = (turned.damping(spinning, kSlow) - machine.damping) / machine.speed;
  for (int k = 0; k < kTorques; ++k) {
    const double at = 2.0 * k / (kTorques - 1);
    machine.torque.push_back(turned.force(rest, at * spinning)[machine.spin]);
  }
}

// How much a deflection of one clearance changes what is held constant.
void fill_bent(const mjModel* m, const Config& config, Turned& turned, Probe& probe,
               LinearMachine& machine) {
  const double clearance = config.model.contact->clearance;
  const VectorXd rest = VectorXd::Zero(m->nv);
  const MatrixXd relative = machine.rotor - machine.ring;
  const VectorXd scale = machine.mass.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<MatrixXd> factor(machine.mass);
  probe.pose(rest);
  const MatrixXd mass = probe.mass();
  for (int k = 0; k < 2; ++k) {
    VectorXd q = factor.solve(relative.row(k).transpose());
    const double moved = relative.row(k).dot(q);
    if (!(moved > 0.0)) continue;
    q *= clearance / moved;
    const VectorXd linear = machine.force - machine.stiffness * q;
    const VectorXd away = turned.force(q, rest) - linear;
    const double springs = (machine.stiffness * q).norm();
    if (springs > 0.0) {
      machine.bent_stiffness = std::max(machine.bent_stiffness, away.norm() / springs);
    }
    probe.pose(q);
    const MatrixXd change = probe.mass() - mass;
    machine.bent_mass = std::max(
        machine.bent_mass, (scale.asDiagonal() * change * scale.asDiagonal()).cwiseAbs().maxCoeff());
    const Eigen::Vector2d place = probe.apart() - machine.apart - relative * q;
    machine.bent_contact = std::max(machine.bent_contact, place.norm() / clearance);
  }
}

}  // namespace

LinearMachine linear_machine(const mjModel* m, const Config& config, const mjData* start) {
  Probe probe(m, config, start);
  LinearMachine machine;
  machine.apart = probe.apart();
  machine.rotor = probe.geom_jacobian(config.rotor_geom).topRows<2>();
  machine.ring = probe.geom_jacobian(config.ring_geom).topRows<2>();
  if (!(m->opt.disableflags & mjDSBL_GRAVITY)) {
    machine.gravity = (probe.axes() * Probe::vector(m->opt.gravity)).head<2>();
  }
  refuse_turning_ring(m, config, probe);
  machine.spin = find_spin(m, config, probe);
  if (machine.spin >= 0) {
    machine.sense = probe.geom_jacobian(config.rotor_geom)(5, machine.spin) > 0.0 ? 1.0 : -1.0;
  }
  machine.unbalance = find_unbalance(m, machine.spin, probe);
  Turned turned(m, machine.spin, probe);
  fill_mass(turned, probe, machine);
  fill_forces(m, start, turned, machine);
  fill_bent(m, config, turned, probe, machine);
  return machine;
}

}  // namespace rotorub::plugin
