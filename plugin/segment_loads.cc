#include "plugin/segment_loads.h"

#include "native_model/dynamics/loads.h"

namespace rotorub::plugin {
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

int stored_address(const Config& config, int plane) {
  return config.dof_address[static_cast<std::size_t>(config.model.layout.integral() + plane)];
}

void scatter(const std::vector<JointAddress>& joints, const Eigen::VectorXd& values, mjtNum* to) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    to[joints[i].velocity] += values[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

void add_segment_loads(const Config& config, mjData* d) {
  const Segments& s = *config.segments;
  const Model &model = config.model, &bending = s.bending;
  const Layout& l = bending.layout;
  const Eigen::VectorXd q = bending_state(config, &JointAddress::position, d->qpos);
  Eigen::VectorXd v = bending_state(config, &JointAddress::velocity, d->qvel);
  for (int k = 0; k < l.integrals; ++k) v[l.integral() + k] = d->qvel[stored_address(config, k)];

  Eigen::VectorXd f = Eigen::VectorXd::Zero(l.nq());
  if (s.damping_x.size() > 0) {
    f.segment(l.x(), l.modes) -= s.damping_x * v.segment(l.x(), l.modes);
    f.segment(l.y(), l.modes) -= s.damping_y * v.segment(l.y(), l.modes);
  }
  // MuJoCo's spin, also where it is held: whoever linearises sets it.
  const Eigen::VectorXd spin = gather(s.spin, &JointAddress::velocity, d->qvel);
  const double omega = s.spin_share.dot(spin);
  const double working = bending.feedback && d->time < bending.feedback->law.fails_at ? 1.0 : 0.0;
  equations::add_linear_loads(bending, omega, working, q.data(), v.data(), f.data());
  equations::add_forces(bending, d->time, q.data(), f.data());
  // Blades that are lost; MuJoCo's bodies keep their masses.
  equations::DiscAngles<double> angles;
  angles.fill(bending, d->time, q.data());
  equations::add_unbalance(bending, angles, equations::spin_speed(bending, v.data()), f.data());
  scatter(s.x, f.segment(l.x(), l.modes), d->qfrc_passive);
  scatter(s.y, f.segment(l.y(), l.modes), d->qfrc_passive);
  for (int k = 0; k < l.integrals; ++k) {
    d->qfrc_passive[stored_address(config, k)] += f[l.integral() + k];
  }

  if (s.torsion_damping.size() > 0) {
    scatter(s.spin, -(s.torsion_damping * spin), d->qfrc_passive);
  }
  if (s.drive_node >= 0 && model.drive) {
    const JointAddress& motor = s.spin[static_cast<std::size_t>(s.drive_node)];
    d->qfrc_passive[motor.velocity] += model.drive_torque(
        d->time, d->qpos[motor.position] - model.drive_angle, d->qvel[motor.velocity]);
  }
  if (model.weight.size() > 0) {
    // The rotor's weight is MuJoCo's; the ring's mass is an armature, on which gravity does not
    // act.
    for (int i = model.layout.ring(); i < model.nq(); ++i) {
      d->qfrc_passive[config.dof_address[static_cast<std::size_t>(i)]] += model.weight[i];
    }
  }
}

}  // namespace rotorub::plugin
