#include "plugin/segment_loads.h"

#include <cmath>

#include "native_model/dynamics/dynamics.h"

namespace rotorub::plugin {
namespace {

void scatter(const std::vector<JointAddress>& joints, const Eigen::VectorXd& values, mjtNum* to) {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    to[joints[i].velocity] += values[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace

void add_segment_loads(const Config& config, mjData* d) {
  const Segments& s = *config.segments;
  const Model& model = config.model;
  const Eigen::VectorXd vx = gather(s.x, &JointAddress::velocity, d->qvel);
  const Eigen::VectorXd vy = gather(s.y, &JointAddress::velocity, d->qvel);
  const Eigen::VectorXd spin = gather(s.spin, &JointAddress::velocity, d->qvel);
  Eigen::VectorXd fx = Eigen::VectorXd::Zero(vx.size()), fy = fx;
  if (s.damping_x.size() > 0) {
    fx -= s.damping_x * vx;
    fy -= s.damping_y * vy;
  }
  if (s.internal.size() > 0) {
    // -D_i (qdot - Omega e_z x q): the part with q.
    const double omega = s.spin_share.dot(spin);
    fx -= omega * (s.internal * gather(s.y, &JointAddress::position, d->qpos));
    fy += omega * (s.internal * gather(s.x, &JointAddress::position, d->qpos));
  }
  const double phi = model.layout.spin
                         ? s.spin_share.dot(gather(s.spin, &JointAddress::position, d->qpos))
                         : spin_angle(model, d->time, nullptr);
  for (std::size_t i = 0; i < s.force_rows.size(); ++i) {
    const Eigen::Vector2d force = model.forces[i].at(d->time, phi);
    fx += force.x() * s.force_rows[i].transpose();
    fy += force.y() * s.force_rows[i].transpose();
  }
  // Blades that are lost; MuJoCo's bodies keep their masses. The spin is held (mjcf/writer.cc).
  for (std::size_t i = 0; i < s.lost_rows.size(); ++i) {
    const DiscUnbalance& lost = s.lost[i];
    if (d->time < lost.on) continue;
    const double size = lost.static_moment * model.speed * model.speed;
    fx += size * std::cos(phi + lost.phase) * s.lost_rows[i].transpose();
    fy += size * std::sin(phi + lost.phase) * s.lost_rows[i].transpose();
  }
  if (model.feedback) {
    MagneticFeedback<double> law = model.feedback->law;
    law.held = 0.0;  // the chain has no such spring
    const double share = d->time < law.fails_at ? 1.0 : 0.0;
    const Layout& l = model.layout;
    const auto pull = [&](int plane, const std::vector<JointAddress>& joints,
                          const Eigen::VectorXd& rates) {
      const double r = s.magnet_row.dot(gather(joints, &JointAddress::position, d->qpos));
      const double rate = s.magnet_row.dot(rates);
      if (l.integrals == 0) return law.force(share, r, rate, 0.0);
      const int dof = config.dof_address[static_cast<std::size_t>(l.integral() + plane)];
      const double stored = d->qvel[dof];
      d->qfrc_passive[dof] +=
          model.mass[l.integral() + plane] * law.stored_rate(share, r, rate, stored);
      return law.force(share, r, rate, stored);
    };
    fx += pull(0, s.x, vx) * s.magnet_row.transpose();
    fy += pull(1, s.y, vy) * s.magnet_row.transpose();
  } else if (s.magnet_row.size() > 0) {
    const auto pull = [&](const std::vector<JointAddress>& joints) {
      return s.magnet_stiffness *
             s.magnet_row.dot(gather(joints, &JointAddress::position, d->qpos));
    };
    fx += pull(s.x) * s.magnet_row.transpose();
    fy += pull(s.y) * s.magnet_row.transpose();
  }
  scatter(s.x, fx, d->qfrc_passive);
  scatter(s.y, fy, d->qfrc_passive);

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
