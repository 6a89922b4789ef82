#include "plugin/twin/native_twin.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/scene.h"
#include "plugin/model/message.h"
#include "plugin/twin/linear_machine.h"
#include "plugin/twin/planes.h"
#include "plugin/twin/twin_limits.h"

namespace rotorub::plugin {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// relative size below which a part is the error of differences
constexpr double kNegligible = 1e-9;
constexpr double kFree = 1e-6;  // (rad/s)^2 and rad/s^2, the same for parts that turn freely
constexpr double kNoUnbalance = 1e-12;  // kg m

std::vector<double> list(const VectorXd& v) { return {v.data(), v.data() + v.size()}; }

class Maker {
 public:
  Maker(const mjModel* m, const Config& config, const mjData* start)
      : m_(m),
        config_(config),
        start_(start),
        machine_(linear_machine(m, config, start)),
        planes_(part_planes(m, machine_)),
        n_(planes_.x.mass.size()) {}

  NativeTwin make() {
    const Layout l = layout();
    twin_.coordinates = MatrixXd::Zero(l.nq(), m_->nv);
    twin_.offset = VectorXd::Zero(l.nq());
    rotor_.force_shapes.push_back({VectorXd::Zero(n_), VectorXd::Zero(n_)});
    fill_plane(planes_.x, l.x(), 0, rotor_.x, rotor_.force_shapes[0].x);
    fill_plane(planes_.y, l.y(), 1, rotor_.y, rotor_.force_shapes[0].y);
    const std::size_t contacts = config_.pairs.size();
    for (std::size_t k = 0; k < contacts; ++k) {
      rotor_.contacts.push_back({planes_.x.contacts[k], planes_.y.contacts[k]});
    }
    rotor_.torsion = no_torsion(contacts);
    rotor_.gravity_x = rotor_.gravity_y = VectorXd::Zero(n_);
    rotor_.internal_xx = rotor_.internal_xy = rotor_.internal_yy = MatrixXd::Zero(n_, n_);
    const MatrixXd g = machine_.gyroscopic(planes_.x.dofs, planes_.y.dofs);
    rotor_.gyroscopic = machine_.spin.sense * planes_.x.shapes.transpose() * g * planes_.y.shapes;
    fill_load();
    fill_contacts(l);
    fill_spin(l);
    fill_scene(l);
    twin_.limits = twin_limits(m_, machine_, planes_);
    if (std::any_of(config_.pairs.begin(), config_.pairs.end(),
                    [](const ContactPair& pair) { return pair.axial; })) {
      twin_.limits.push_back(
          "friction along the ring's axis, and its work, exist only in MuJoCo; the native model's "
          "friction "
          "acts round the ring");
    }
    return std::move(twin_);
  }

 private:
  Layout layout() const {
    Layout l;
    l.modes = static_cast<int>(n_);
    l.spin = machine_.spin.dof >= 0 ? 1 : 0;
    for (const std::vector<int>& ring : planes_.rings) l.stator += static_cast<int>(ring.size());
    for (const LinearContact& c : machine_.contacts) l.ring_spin += c.ring_turn.dof >= 0 ? 1 : 0;
    return l;
  }

  // Fills modes, their dampers, constant loads and coordinates of one plane. Their zero is where
  // the centres of the first contact coincide. If the rotor is not at the ring's centre at qpos0,
  // this is a deflection that the springs do not feel.
  void fill_plane(const TwinPlane& plane, int at, int row, PlaneModes& modes, VectorXd& load) {
    modes = {plane.mass, plane.stiffness, VectorXd::Zero(n_)};
    const MatrixXd d =
        plane.shapes.transpose() * machine_.damping(plane.dofs, plane.dofs) * plane.shapes;
    const MatrixXd even = 0.5 * (d + d.transpose());
    const MatrixXd off_diagonal = even - MatrixXd(even.diagonal().asDiagonal());
    if (off_diagonal.cwiseAbs().maxCoeff() <= kNegligible * even.cwiseAbs().maxCoeff()) {
      modes.damping = even.diagonal();
    } else {
      add_dampers(even, row);
    }
    const VectorXd& contact = plane.contacts.front();
    const VectorXd compliance = contact.cwiseQuotient(plane.mass);
    const VectorXd offset =
        machine_.contacts.front().apart[row] / compliance.dot(contact) * compliance;
    load = plane.shapes.transpose() * machine_.force(plane.dofs) +
           plane.stiffness.cwiseProduct(offset);
    twin_.coordinates(Eigen::seqN(at, n_), plane.dofs) = plane.inverse;
    twin_.offset.segment(at, n_) = offset;
  }

  // Adds damping that couples modes, as dashpots of rank one.
  void add_dampers(const MatrixXd& damping, int row) {
    const std::optional<SymmetricModes> parts = symmetric_modes(damping);
    if (!parts)
      throw ConfigError(
          "rotorub: damping: its dashpots are not found, so there is no native model to compare "
          "with");
    const double largest = parts->values.cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < n_; ++k) {
      const double value = parts->values[k];
      if (std::abs(value) <= kNegligible * largest) continue;
      StationDamper damper{{VectorXd::Zero(n_), VectorXd::Zero(n_)}, Eigen::Vector2d::Zero()};
      (row == 0 ? damper.shape.x : damper.shape.y) = parts->vectors.col(k);
      damper.damping[row] = value;
      rotor_.bearing_dampers.push_back(std::move(damper));
    }
  }

  void fill_load() {
    scene::Force force;
    force.kind = scene::ForceKind::kConstant;
    force.vector = {1.0, 1.0};
    const ModeShape& shape = rotor_.force_shapes[0];
    if (shape.x.isZero(0.0) && shape.y.isZero(0.0)) {
      rotor_.force_shapes.clear();
    } else {
      twin_.scene.forces.push_back(force);
    }
  }

  void fill_contacts(const Layout& l) {
    scene::Scene& scene = twin_.scene;
    scene.auxiliary.resize(config_.pairs.size());
    int ring = l.ring(), angle = l.ring_angle();
    for (std::size_t k = 0; k < config_.pairs.size(); ++k) {
      const ContactParameters& c = config_.pairs[k].contact;
      scene::Contact& contact = scene.auxiliary[k].contact.emplace();
      contact.radius = c.radius;
      contact.clearance = c.clearance;
      contact.friction = c.friction;
      contact.restitution = c.restitution;
      contact.tangential_restitution = c.tangential_restitution;
      if (k > 0) {
        const Eigen::Vector2d zero(planes_.x.contacts[k].dot(twin_.offset.segment(l.x(), n_)),
                                   planes_.y.contacts[k].dot(twin_.offset.segment(l.y(), n_)));
        contact.offset = zero - machine_.contacts[k].apart;
      }
      if (!planes_.rings[k].empty()) fill_ring(k, std::exchange(ring, ring + 2));
      if (machine_.contacts[k].ring_turn.dof >= 0) fill_ring_turn(k, angle++);
    }
  }

  void fill_ring(std::size_t contact, int at) {
    scene::Stator& ring = twin_.scene.auxiliary[contact].stator.emplace();
    Eigen::Vector2d weight;
    for (int k = 0; k < 2; ++k) {
      const int dof = planes_.rings[contact][static_cast<std::size_t>(k)];
      const double a = machine_.contacts[contact].ring(k, dof), square = a * a;
      ring.mass[k] = machine_.mass(dof, dof) / square;
      ring.stiffness[k] = machine_.stiffness(dof, dof) / square;
      ring.damping[k] = machine_.damping(dof, dof) / square;
      weight[k] = machine_.force[dof] / a / ring.mass[k];
      twin_.coordinates(at + k, dof) = a;
    }
    // The scene has one gravity, which acts on rings alone here.
    std::optional<scene::Gravity>& gravity = twin_.scene.gravity;
    if (!gravity) gravity.emplace().acceleration = weight;
    if ((gravity->acceleration - weight).norm() <= kNegligible * weight.norm()) return;
    refuse(joint_of_dof(m_, planes_.rings[contact].front()),
           "carries another load for its mass than the first ring; `compare` needs rings that only "
           "gravity loads");
  }

  void refuse_spring(int turn, const std::string& body) const {
    if (std::abs(machine_.stiffness(turn, turn)) <= kFree * machine_.mass(turn, turn)) return;
    refuse(joint_of_dof(m_, turn),
           "turns the " + body + " against a spring; `compare` needs stiffness=\"0\"");
  }

  // J Omega_r' = -c Omega_r + the contact's torque, and nothing else (scene::RingSpin).
  void fill_ring_turn(std::size_t contact, int at) {
    const auto& [turn, sense] = machine_.contacts[contact].ring_turn;
    refuse_spring(turn, "ring");
    const double inertia = machine_.mass(turn, turn), drag = machine_.damping(turn, turn);
    if (std::abs(machine_.force[turn]) > kFree * inertia) {
      refuse(joint_of_dof(m_, turn),
             "turns the ring by " + text(machine_.force[turn]) +
                 " N m at rest; for `compare` only the rub and a drag may turn it");
    }
    if (m_->dof_frictionloss[turn] > 0.0) {
      refuse(joint_of_dof(m_, turn),
             "loses " + text(m_->dof_frictionloss[turn]) +
                 " N m to dry friction as the ring turns; `compare` needs frictionloss=\"0\"");
    }
    if (drag < 0.0 || machine_.contacts[contact].bent_drag > kFree * inertia) {
      refuse(
          joint_of_dof(m_, turn),
          "has a drag that is negative or not linear in its speed; `compare` needs a damping >= 0");
    }
    twin_.coordinates(at, turn) = sense;
    twin_.scene.auxiliary[contact].stator->spin = scene::RingSpin{inertia, drag, 0.0};
  }

  void fill_spin(const Layout& l) {
    if (l.spin == 0) return;
    const int spin = machine_.spin.dof;
    refuse_spring(spin, "rotor");
    twin_.coordinates(l.phi(), spin) = machine_.spin.sense;
    rotor_.spin_inertia = machine_.mass(spin, spin);
    fill_unbalance();
    fill_drive(twin_.scene.drive.emplace());
  }

  // An unbalance of phase 0 has b = -X sin phi in x and b = Y cos phi in y (model/equations.h). One
  // that leads it by a quarter turn has the other two of the four vectors that the two angles
  // supply:
  //
  //   x + i x':  -b(90 degrees) - i b(0),      y + i y':  b(0) - i b(90 degrees)
  //
  // for each mode. Turned by the phase of the largest part, they are real if one unbalance is
  // sufficient.
  void fill_unbalance() {
    const VectorXd* b = machine_.unbalance;
    const auto part = [](const TwinPlane& plane, const VectorXd& of) -> VectorXd {
      return plane.shapes.transpose() * of(plane.dofs);
    };
    Eigen::VectorXcd all(2 * n_);
    all.real() << -part(planes_.x, b[1]), part(planes_.y, b[0]);
    all.imag() << -part(planes_.x, b[0]), -part(planes_.y, b[1]);
    const double largest = all.cwiseAbs().maxCoeff();
    if (largest <= kNoUnbalance) return;
    const double phase = 0.5 * std::arg(all.cwiseProduct(all).sum());
    for (const double turned : {phase, phase + 0.5 * std::numbers::pi}) {
      const VectorXd shape = (all * std::polar(1.0, -turned)).real();
      const double size = shape.cwiseAbs().maxCoeff();
      if (size <= kNegligible * largest) continue;
      const double sign = shape.sum() < 0.0 ? -1.0 : 1.0;
      rotor_.unbalances.push_back({{sign / size * shape.head(n_), sign / size * shape.tail(n_)},
                                   size,
                                   sign < 0.0 ? turned + std::numbers::pi : turned});
    }
  }

  // Fills T(Omega): linear if it is, else a table.
  void fill_drive(scene::Drive& drive) const {
    const std::vector<double>& torque = machine_.torque;
    const double sense = machine_.spin.sense,
                 step = 2.0 * machine_.speed / static_cast<double>(torque.size() - 1);
    double largest = 0.0, curved = 0.0;
    const double slope = (torque.back() - torque.front()) / (2.0 * machine_.speed);
    for (std::size_t k = 0; k < torque.size(); ++k) {
      largest = std::max(largest, std::abs(torque[k]));
      curved = std::max(
          curved, std::abs(torque[k] - torque.front() - slope * step * static_cast<double>(k)));
    }
    if (largest == 0.0) return;
    if (curved <= kNegligible * largest && slope < 0.0) {
      drive.kind = scene::DriveKind::kLinear;
      drive.gain = -slope;
      drive.speed = sense * torque.front() / drive.gain;
      return;
    }
    drive.kind = scene::DriveKind::kTable;
    for (std::size_t k = 0; k < torque.size(); ++k) {
      drive.table_speed.push_back(sense * step * static_cast<double>(k));
      drive.table_torque.push_back(sense * torque[k]);
    }
    if (drive.table_speed.front() <= drive.table_speed.back()) return;
    std::reverse(drive.table_speed.begin(), drive.table_speed.end());
    std::reverse(drive.table_torque.begin(), drive.table_torque.end());
  }

  void fill_scene(const Layout& l) {
    scene::Scene& scene = twin_.scene;
    scene.run.step = m_->opt.timestep;
    scene.mujoco.contact = config_.contact_model();
    // Pictures and pages read these lists.
    scene::RotorModal& modal = scene.rotor.modal.emplace();
    modal.mass = list(rotor_.x.mass);
    modal.mass_y = list(rotor_.y.mass);
    modal.stiffness = list(rotor_.x.stiffness);
    modal.stiffness_y = list(rotor_.y.stiffness);
    modal.inertia = rotor_.spin_inertia;
    scene.rotor.assembled = std::make_shared<const ModalRotor>(rotor_);

    VectorXd q(l.nq()), v(l.nq());
    twin_.read(m_, start_, q.data(), v.data());
    scene::Initial& initial = scene.initial;
    initial.x = list(q.segment(l.x(), n_));
    initial.y = list(q.segment(l.y(), n_));
    initial.vx = list(v.segment(l.x(), n_));
    initial.vy = list(v.segment(l.y(), n_));
    if (l.spin) {
      initial.spin_angle = q[l.phi()];
      scene.rotor.speed = v[l.phi()];
    }
    int ring = l.ring(), angle = l.ring_angle();
    for (scene::AuxiliaryBearing& bearing : scene.auxiliary) {
      if (!bearing.stator) continue;
      bearing.stator->position = q.segment<2>(ring);
      bearing.stator->velocity = v.segment<2>(ring);
      ring += 2;
      if (bearing.stator->spin) bearing.stator->spin->speed = v[angle++];
    }
  }

  const mjModel* m_;
  const Config& config_;
  const mjData* start_;
  LinearMachine machine_;
  TwinPlanes planes_;
  Eigen::Index n_;
  ModalRotor rotor_;
  NativeTwin twin_;
};

}  // namespace

void NativeTwin::read(const mjModel* m, const mjData* d, double* q, double* v) const {
  const auto nq = coordinates.rows();
  VectorXd moved(m->nv);
  mj_differentiatePos(m, moved.data(), 1.0, m->qpos0, d->qpos);
  Eigen::Map<VectorXd>(q, nq) = coordinates * moved + offset;
  Eigen::Map<VectorXd>(v, nq) = coordinates * Eigen::Map<const VectorXd>(d->qvel, m->nv);
}

NativeTwin make_native_twin(const mjModel* m, const Config& config, const mjData* start) {
  for (const ContactPair& pair : config.pairs) {
    if (pair.contact_model == config.contact_model()) continue;
    refuse("<custom>",
           message("has contacts by {} and {}; `compare` needs one contact model",
                   scene::to_string(config.contact_model()), scene::to_string(pair.contact_model)));
  }
  return Maker(m, config, start).make();
}

}  // namespace rotorub::plugin
