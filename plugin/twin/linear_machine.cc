#include "plugin/twin/linear_machine.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "native_model/numerics/linear_solve.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/twin/probe.h"

namespace rotorub::plugin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTurns = 4;        // number of rotor angles for the means
constexpr double kNudge = 1e-5;  // m, rad
constexpr double kSlow = 1.0;    // rad/s, speed instead of 0 if the rotor is at rest
constexpr int kTorques = 9;

// Means over a turn of the rotor.
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
    for (int k = 0; k < turns(); ++k) sum += force_at(k, q, v);
    return sum / turns();
  }
  VectorXd force_at(int k, const VectorXd& q, const VectorXd& v) {
    probe_.pose(q + turn(k));
    return probe_.force(v);
  }

  // -df/dq and -df/dv at the velocities v.
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

// Fills the mean of M and the parts of M that turn with the rotor.
void fill_mass(const Turned& turned, Probe& probe, LinearMachine& machine) {
  std::array<MatrixXd, kTurns> at;
  const auto nv = turned.turn(0).size();
  MatrixXd sum = MatrixXd::Zero(nv, nv);
  for (int k = 0; k < turned.turns(); ++k) {
    probe.pose(turned.turn(k));
    at[static_cast<std::size_t>(k)] = probe.mass();
    sum += at[static_cast<std::size_t>(k)];
  }
  machine.mass = sum / turned.turns();
  if (turned.turns() == 1) return;
  // Each row and column in units of its diagonal.
  const VectorXd scale = machine.mass.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd even = 0.25 * (at[0] + at[2] - at[1] - at[3]);
  machine.uneven_inertia = (scale.asDiagonal() * even * scale.asDiagonal()).cwiseAbs().maxCoeff();
  // With a hinge whose axis is against z, b turns backwards and its column has the other sign, so
  // that b at the quarter turn is unchanged.
  const int spin = machine.spin.dof;
  machine.unbalance[0] = 0.5 * machine.spin.sense * (at[0] - at[2]).col(spin);
  machine.unbalance[1] = 0.5 * (at[1] - at[3]).col(spin);
  for (VectorXd& b : machine.unbalance) b[spin] = 0.0;
}

void fill_forces(const mjModel* m, const mjData* start, Turned& turned, LinearMachine& machine) {
  const VectorXd rest = VectorXd::Zero(m->nv);
  machine.force = turned.force(rest, rest);
  machine.stiffness = turned.stiffness(rest);
  machine.damping = turned.damping(rest, kSlow);
  machine.gyroscopic = MatrixXd::Zero(m->nv, m->nv);
  const int spin = machine.spin.dof;
  if (spin < 0) return;
  for (int k = 0; k < kTurns; ++k) {
    const double torque = turned.force_at(k, rest, rest)[spin] - machine.force[spin];
    machine.unbalance_torque = std::max(machine.unbalance_torque, std::abs(torque));
  }
  const double speed = start->qvel[spin];
  machine.speed = std::abs(speed) > kSlow ? speed : kSlow;
  const VectorXd spinning = machine.speed * VectorXd::Unit(m->nv, spin);
  machine.gyroscopic = (turned.damping(spinning, kSlow) - machine.damping) / machine.speed;
  for (int k = 0; k < kTorques; ++k) {
    const double at = 2.0 * k / (kTorques - 1);
    machine.torque.push_back(turned.force(rest, at * spinning)[spin]);
  }
}

// The ring's drag at the greatest speed that it may reach: its own speed, or the rotor's.
void fill_ring_drag(const mjData* start, Turned& turned, const LinearMachine& machine,
                    LinearContact& contact) {
  const int turn = contact.ring_turn.dof;
  if (turn < 0) return;
  const auto nv = machine.force.size();
  const double speed = std::max({std::abs(start->qvel[turn]), std::abs(machine.speed), kSlow});
  const VectorXd turning = speed * VectorXd::Unit(nv, turn);
  const double torque = turned.force(VectorXd::Zero(nv), turning)[turn] - machine.force[turn];
  contact.bent_drag = std::abs(torque + machine.damping(turn, turn) * speed);
}

// Fills the changes, at a deflection of one clearance at a contact, of the quantities that the
// linear machine holds constant.
void fill_bent(const ContactPair& pair, const LinearContact& contact, Turned& turned, Probe& probe,
               LinearMachine& machine) {
  const double clearance = pair.contact.clearance;
  const VectorXd rest = VectorXd::Zero(machine.force.size());
  const MatrixXd relative = contact.rotor - contact.ring;
  const VectorXd scale = machine.mass.diagonal().cwiseSqrt().cwiseInverse();
  probe.pose(rest);
  const MatrixXd mass = probe.mass();
  for (int k = 0; k < 2; ++k) {
    VectorXd q = ldlt_solve(machine.mass, relative.row(k).transpose());
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
    machine.bent_mass =
        std::max(machine.bent_mass,
                 (scale.asDiagonal() * change * scale.asDiagonal()).cwiseAbs().maxCoeff());
    const Eigen::Vector2d place = probe.apart(pair) - contact.apart - relative * q;
    machine.bent_contact = std::max(machine.bent_contact, place.norm() / clearance);
  }
}

}  // namespace

LinearMachine linear_machine(const mjModel* m, const Config& config, const mjData* start) {
  Probe probe(m, config, start);
  LinearMachine machine;
  for (const ContactPair& pair : config.pairs) {
    constexpr double kParallel = 1e-9;
    if (std::abs(probe.along_axis(pair.ring_geom) - 1.0) > kParallel) {
      refuse(message("<geom name=\"{}\">", m->names + m->name_geomadr[pair.ring_geom]),
             "its z axis differs from the first ring's; `compare` needs rings with one axis");
    }
    machine.contacts.push_back(
        {find_ring_turn(m, pair, probe), probe.geom_jacobian(pair.rotor_geom).topRows<2>(),
         probe.geom_jacobian(pair.ring_geom).topRows<2>(), probe.apart(pair)});
  }
  machine.spin = find_spin(m, config, probe);
  Turned turned(m, machine.spin.dof, probe);
  fill_mass(turned, probe, machine);
  fill_forces(m, start, turned, machine);
  for (std::size_t k = 0; k < machine.contacts.size(); ++k) {
    fill_ring_drag(start, turned, machine, machine.contacts[k]);
    fill_bent(config.pairs[k], machine.contacts[k], turned, probe, machine);
  }
  return machine;
}

}  // namespace rotorub::plugin
