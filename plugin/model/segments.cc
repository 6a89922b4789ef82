#include "plugin/model/segments.h"

#include <Eigen/Core>
#include <algorithm>

#include "mjcf/names.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/loads.h"
#include "native_model/model/sampled_feedback.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/scene.h"
#include "native_model/stepping/step_limit.h"
#include "plugin/model/config.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

using AddressPart = int JointAddress::*;

// The joints' values in an array of mjData.
Eigen::VectorXd gather(const std::vector<JointAddress>& joints, AddressPart part,
                       const mjtNum* from) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(joints.size()));
  for (std::size_t i = 0; i < joints.size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = from[joints[i].*part];
  }
  return values;
}

void map_joints(Segments& s, const std::function<JointAddress(const std::string&)>& find) {
  s.x.push_back(find(names::kEndX));
  s.y.push_back(find(names::kEndY));
  for (std::size_t k = 0; k < s.chain.segments.size(); ++k) {
    s.x.push_back(find(names::tilt('x', k)));
    s.y.push_back(find(names::tilt('y', k)));
    s.spin.push_back(find(names::spin(k)));
  }
}

// Share of each mode in a state, (phi^T M phi)^-1 phi^T M. The modes are orthogonal.
Eigen::MatrixXd projection(const Eigen::MatrixXd& shape, const Eigen::MatrixXd& mass) {
  Eigen::MatrixXd p = shape.transpose() * mass;
  for (Eigen::Index j = 0; j < p.rows(); ++j) p.row(j) /= p.row(j).dot(shape.col(j));
  return p;
}

// The shares with the values that the modes miss at the contacts. rows: what the contacts have of
// the chain's coordinates; shapes: of the modes; one row for each contact. A single contact's value
// is added to the first mode that moves it. This mode is the softest, so the forces and
// accelerations that are computed from the modes change least. For several contacts it is the
// change with the least elastic energy.
Eigen::MatrixXd completed(const Eigen::MatrixXd& shares, const Eigen::MatrixXd& rows,
                          const Eigen::MatrixXd& shapes, const Eigen::VectorXd& stiffness) {
  constexpr double kLeast = 1e-9;  // relative to the largest stiffness; for modes without a spring
  const Eigen::Index contacts = rows.rows();
  if (contacts == 0 || shares.rows() == 0) return shares;
  const Eigen::MatrixXd missing = rows - shapes * shares;
  if (contacts == 1) {
    Eigen::MatrixXd all = shares;
    for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
      if (shapes(0, k) == 0.0) continue;
      all.row(k) += missing.row(0) / shapes(0, k);
      break;
    }
    return all;
  }
  const Eigen::VectorXd soft =
      stiffness.cwiseMax(kLeast * std::max(stiffness.maxCoeff(), 1.0)).cwiseInverse();
  const Eigen::MatrixXd spread = soft.asDiagonal() * shapes.transpose();
  const Eigen::MatrixXd moves = shapes * spread;
  Eigen::MatrixXd all = shares;
  for (Eigen::Index i = 0; i < missing.cols(); ++i) {
    all.col(i) += spread * least_squares(moves, Eigen::VectorXd(missing.col(i)));
  }
  return all;
}

void map_modes(const scene::Scene& scene, const Model& model, const SegmentMatrices& m,
               Segments& s) {
  const Layout& l = model.layout;
  const Eigen::Index nodes = m.spin_inertia.size();
  const auto contacts = static_cast<Eigen::Index>(std::ranges::count_if(
      scene.auxiliary, [](const auto& bearing) { return bearing.contact.has_value(); }));
  // Without a drive the first segment is held, and the torsion modes are relative to it.
  Eigen::RowVectorXd rigid = Eigen::RowVectorXd::Unit(nodes, 0);
  if (l.spin) rigid = s.spin_share.transpose();
  Eigen::MatrixXd rows(contacts, m.mass.cols()), twists(contacts, nodes);
  Eigen::MatrixXd shapes_x(contacts, l.modes), shapes_y(contacts, l.modes),
      shapes_torsion(contacts, l.torsion);
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < scene.auxiliary.size(); ++i) {
    if (!scene.auxiliary[i].contact) continue;
    const double station = scene.auxiliary[i].contact->station;
    rows.row(k) = s.chain.deflection(station);
    twists.row(k) = Eigen::RowVectorXd::Unit(nodes, s.chain.node_at(station)) - rigid;
    const AuxiliaryBearing& at = model.auxiliary[static_cast<std::size_t>(k)];
    shapes_x.row(k) = at.shape.x.transpose();
    shapes_y.row(k) = at.shape.y.transpose();
    if (l.torsion) shapes_torsion.row(k) = at.torsion_shape.transpose();
    ++k;
  }
  s.modes_x = completed(projection(m.shape_x, m.mass), rows, shapes_x,
                        model.stiffness.segment(l.x(), l.modes));
  s.modes_y = completed(projection(m.shape_y, m.mass), rows, shapes_y,
                        model.stiffness.segment(l.y(), l.modes));
  Eigen::MatrixXd torsion = projection(m.shape_torsion, m.spin_inertia.asDiagonal());
  if (!l.spin) torsion -= torsion.rowwise().sum() * rigid;
  s.modes_torsion =
      completed(torsion, twists, shapes_torsion, model.stiffness.segment(l.theta(), l.torsion));
  s.spin_row = rigid;
  // A rotor without torsion modes has the spin of its first contact.
  if (contacts > 0 && l.torsion == 0) s.spin_row += twists.row(0);
}

void to_native(const Segments& s, const Model& model, const mjtNum* from, AddressPart part,
               double* to) {
  const Layout& l = model.layout;
  using Vector = Eigen::Map<Eigen::VectorXd>;
  const Eigen::VectorXd spin = gather(s.spin, part, from);
  Vector(to + l.x(), l.modes).noalias() = s.modes_x * gather(s.x, part, from);
  Vector(to + l.y(), l.modes).noalias() = s.modes_y * gather(s.y, part, from);
  Vector(to + l.theta(), l.torsion).noalias() = s.modes_torsion * spin;
  if (l.spin) to[l.phi()] = s.spin_row.dot(spin);
}

// Segments::bending.
Model bending_loads(const scene::Scene& scene, const Model& model, const SegmentChain& chain,
                    const SegmentMatrices& matrices) {
  const auto shape = [&chain](double station) {
    const Eigen::VectorXd row = chain.deflection(station).transpose();
    return ModeShape{row, row};
  };
  Model loads;
  Layout& l = loads.layout;
  l.modes = static_cast<int>(chain.plane_size());
  l.spin = model.layout.spin;
  l.feedback_states = model.layout.feedback_states;
  loads.speed = model.speed;
  loads.spin_angle = model.spin_angle;
  loads.mass = Eigen::VectorXd::Zero(l.nq());
  loads.mass.tail(l.feedback_states) =
      model.mass.segment(model.layout.feedback_state(), l.feedback_states);
  loads.internal_xx = loads.internal_xy = loads.internal_yy = ModeMatrix(matrices.internal);
  // A translation of the whole chain moves only its end coordinates, because its tilts are
  // relative.
  loads.base = model.base;
  loads.gravity_mass = matrices.mass.col(0).replicate(2, 1);
  loads.forces = model.forces;  // in the scene's order, without the unbalances
  auto force = loads.forces.begin();
  for (const scene::Force& given : scene.forces) {
    if (given.kind != scene::ForceKind::kUnbalance) {
      (force++)->shape = shape(given.station);
    } else if (given.static_moment != 0.0) {
      loads.unbalances.push_back(
          {shape(given.station), given.static_moment, given.phase, given.on});
    }
  }
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    const double k = bearing.pull();
    if (bearing.is_spring()) loads.springs.push_back({shape(bearing.station), {-k, -k}});
  }
  for (StationFeedback feedback : model.feedbacks) {
    const scene::MagneticBearing& bearing = scene.magnetic_bearings[feedback.number];
    feedback.shape = shape(bearing.station);
    if (feedback.sensor) feedback.sensor = shape(*bearing.sensor_station);
    feedback.law.linear_spring = 0.0;  // the chain has no such spring
    feedback.states = feedback.states.moved(l.feedback_state() - model.layout.feedback_state());
    loads.feedbacks.push_back(std::move(feedback));
  }
  loads.samplers = model.samplers;
  for (SampledFeedback& sampler : loads.samplers) {
    for (int* at : {&sampler.command, &sampler.state}) {
      *at += l.feedback_state() - model.layout.feedback_state();
    }
  }
  return loads;
}

}  // namespace

Segments make_segments(const scene::Scene& scene, const Model& model,
                       const std::function<JointAddress(const std::string&)>& find) {
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  Segments s;
  s.chain = segment_chain(scene);
  map_joints(s, find);
  const SegmentMatrices m =
      segment_matrices(scene, s.chain, model.layout.modes, model.layout.torsion);
  if (geometry.damping_ratio > 0.0) {
    s.damping_x = m.damping_x;
    s.damping_y = m.damping_y;
  }
  s.bending = bending_loads(scene, model, s.chain, m);
  if (!m.torsion_damping.isZero(0.0)) s.torsion_damping = m.torsion_damping;
  if (scene.drive) s.drive_node = s.chain.node_at(scene.drive->station);
  s.spin_share = m.spin_inertia / m.spin_inertia.sum();
  map_modes(scene, model, m, s);
  s.highest = m.highest;
  return s;
}

void native_position(const Segments& segments, const Model& model, const mjtNum* qpos, double* q) {
  to_native(segments, model, qpos, &JointAddress::position, q);
}

void native_velocity(const Segments& segments, const Model& model, const mjtNum* qvel, double* v) {
  to_native(segments, model, qvel, &JointAddress::velocity, v);
}

std::string segment_step_refusal(const Segments& segments, double step) {
  const double limit = 2.0 / segments.highest;
  if (step < limit) return {};
  return step_limit_text(step, {limit, "the segment rotor"}) +
         "; lower run.step, or use fewer mujoco.segments";
}

namespace {

// The chain's state in the coordinates of Segments::bending.
Eigen::VectorXd bending_state(const Config& config, AddressPart part, const mjtNum* from) {
  const Segments& s = *config.segments;
  const Layout& l = s.bending.layout;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(l.nq());
  state.segment(l.x(), l.modes) = gather(s.x, part, from);
  state.segment(l.y(), l.modes) = gather(s.y, part, from);
  if (l.spin) state[l.phi()] = s.spin_share.dot(gather(s.spin, part, from));
  return state;
}

int stored_address(const Config& config, int k) {
  return config.dof_address[static_cast<std::size_t>(config.model.layout.feedback_state() + k)];
}

// Loads of the rings' supports beyond their joints' springs, nq values; empty if there are none.
Eigen::VectorXd support_loads(const Config& config, const mjModel* m, const mjData* d) {
  const Model& model = config.model;
  if (model.supports.empty()) return {};
  Eigen::VectorXd q = Eigen::VectorXd::Zero(model.nq()), v = q, f = q;
  for (int i = model.layout.ring(); i < model.nq(); ++i) {
    q[i] = d->qpos[config.qpos_address[static_cast<std::size_t>(i)]];
    v[i] = d->qvel[config.dof_address[static_cast<std::size_t>(i)]];
  }
  add_ring_supports(model, q.data(), v.data(), f.data());
  if (m->opt.integrator != mjINT_RK4) {
    step_bristles(model, v.data(), v.data(), m->opt.timestep, f.data());
  }
  return f;
}

void scatter(const std::vector<JointAddress>& joints, const Eigen::VectorXd& values, mjtNum* to) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    to[joints[i].velocity] += values[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

void add_segment_loads(const Config& config, const mjModel* m, mjData* d) {
  const Segments& s = *config.segments;
  const Model &model = config.model, &bending = s.bending;
  const Layout& l = bending.layout;
  const Eigen::VectorXd q = bending_state(config, &JointAddress::position, d->qpos);
  Eigen::VectorXd v = bending_state(config, &JointAddress::velocity, d->qvel);
  for (int k = 0; k < l.feedback_states; ++k)
    v[l.feedback_state() + k] = d->qvel[stored_address(config, k)];

  Eigen::VectorXd f = Eigen::VectorXd::Zero(l.nq());
  take_samples_in_step(bending, d->time, m->opt.timestep, q.data(), v.data(), f.data());
  if (s.damping_x.size() > 0) {
    f.segment(l.x(), l.modes) -= s.damping_x * v.segment(l.x(), l.modes);
    f.segment(l.y(), l.modes) -= s.damping_y * v.segment(l.y(), l.modes);
  }
  // MuJoCo's spin, even if it is held, because a program that linearises may change it.
  const Eigen::VectorXd spin = gather(s.spin, &JointAddress::velocity, d->qvel);
  const double omega = s.spin_share.dot(spin);
  const auto working = equations::working_at(bending, d->time);
  equations::add_linear_loads(bending, omega, working.data(), q.data(), v.data(), f.data());
  equations::add_forces(bending, d->time, q.data(), f.data());
  // Lost blades. MuJoCo's bodies keep their masses.
  equations::DiscAngles angles;
  angles.fill(bending, d->time, q.data());
  equations::add_unbalance(bending, angles, equations::spin_speed(bending, v.data()), f.data());
  scatter(s.x, f.segment(l.x(), l.modes), d->qfrc_passive);
  scatter(s.y, f.segment(l.y(), l.modes), d->qfrc_passive);
  for (int k = 0; k < l.feedback_states; ++k) {
    d->qfrc_passive[stored_address(config, k)] += f[l.feedback_state() + k];
  }

  if (s.torsion_damping.size() > 0) {
    scatter(s.spin, -(s.torsion_damping * spin), d->qfrc_passive);
  }
  if (s.drive_node >= 0 && model.drive) {
    const JointAddress& motor = s.spin[static_cast<std::size_t>(s.drive_node)];
    d->qfrc_passive[motor.velocity] += model.drive->torque(
        d->time, d->qpos[motor.position] - model.drive_angle, d->qvel[motor.velocity]);
  }
  // MuJoCo applies the rotor's weight. The ring's mass is an armature, on which gravity does not
  // act. The motion of the base loads it like the rotor.
  const Eigen::Vector2d base = model.base ? model.base->at(d->time) : Eigen::Vector2d(0.0, 0.0);
  const Eigen::VectorXd supports = support_loads(config, m, d);
  for (int i = model.layout.ring(); i < model.nq(); ++i) {
    mjtNum& force = d->qfrc_passive[config.dof_address[static_cast<std::size_t>(i)]];
    if (supports.size() > 0) force += supports[i];
    if (model.weight.size() > 0) force += model.weight[i];
    const int along = i - model.layout.ring();
    if (model.base && along < model.layout.stator) force -= model.gravity_mass[i] * base[along % 2];
  }
}

}  // namespace rotorub::plugin
