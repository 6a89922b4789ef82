// The impacts of CoupledVerlet: located in the step, each with all that is closed there.

#include <algorithm>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/step_contact.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/coupled_verlet.h"
#include "native_model/system/actuation.h"

namespace rotorub {

// The contact whose path leaves its circle first, with d_ and theta at that instant; the number of
// contacts: none does. One that never comes inside is closed: it has no flight.
std::size_t CoupledVerlet::next_touch(std::span<bool> closed, double& theta) {
  const std::size_t n = contacts_.size();
  double share = 2.0;
  std::size_t first = n;
  std::array<Eigen::Vector2d, kMaxContacts> path;
  for (std::size_t i = 0; i < n; ++i) {
    const double clearance = contacts_[i].law.clearance;
    path[i] = (1.0 - theta) * h_ * rates(i, velocity_.data()).head<2>();
    if (closed[i] || (d_[i] + path[i]).norm() <= clearance) continue;
    const double exit = circle_exit(d_[i], path[i], clearance);
    if (exit > 1.0) {
      closed[i] = d_[i].norm() >= clearance;
    } else if (exit < share) {
      share = exit;
      first = i;
    }
  }
  if (first == n) return n;
  for (std::size_t i = 0; i < n; ++i) d_[i] += share * path[i];
  theta += share * (1.0 - theta);
  return first;
}

// A lasting contact carries nothing from the share theta of the step on, and the kick was for a
// whole step.
void CoupledVerlet::knock_open(std::size_t contact, double theta) {
  Contact& c = contacts_[contact];
  const Eigen::Vector3d p = contact_load(c.e_r, c.law.radius, c.normal, c.friction);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Columns& column = response_[3 * contact + axis];
    for (std::size_t j = 0; j < column.size(); ++j) {
      const double kicked = column[j] * p[static_cast<Eigen::Index>(axis)];
      late_[j] += (theta - 0.5) * kicked;
      acceleration_[j] -= kicked / (kick_ * h_);
    }
  }
  c.lasts = false;
}

// The impacts of the step, in their order. What flies leaves its circle; what is closed takes part.
void CoupledVerlet::collide(std::int64_t k) {
  const std::size_t n = contacts_.size(), nq = after_.size();
  const double t = origin + static_cast<double>(k) * h_;
  velocity_ = after_;
  for (std::size_t i = 0; i < nq; ++i) acceleration_[i] = (after_[i] - start_[i]) / (kick_ * h_);
  std::array<bool, kMaxContacts> closed{};
  for (std::size_t i = 0; i < n; ++i) d_[i] = contacts_[i].d, closed[i] = contacts_[i].lasts;
  double theta = 0.0;
  const int most = StepImpacts::kMost * static_cast<int>(n);
  for (int count = 0; count < most; ++count) {
    const std::size_t first = next_touch(std::span(closed).first(n), theta);
    if (first == n) break;
    // All that is closed there, with the velocities of that instant.
    for (std::size_t i = 0; i < nq; ++i) {
      at_[i] = velocity_[i] + (theta - 0.5) * h_ * acceleration_[i];
      there_[i] = seen_[i] + theta * h_ * velocity_[i];
    }
    Blow blow;
    for (std::size_t i = 0; i < n; ++i) {
      const double on_circle = (1.0 - kOnCircle) * contacts_[i].law.clearance;
      if (!closed[i] && i != first && d_[i].norm() < on_circle) continue;
      join(blow, i, closed[i], d_[i].normalized(), at_, acceleration_);
    }
    if (blow.approach == 0.0) {  // a touch
      closed[first] = true;
      continue;
    }
    if (!strike(blow, t + theta * h_, t, there_.data(), count + 1 == most, jump_)) return;
    for (std::size_t i = 0; i < blow.count; ++i) {
      const std::size_t index = blow.of[i].index;
      if (closed[index] && contacts_[index].lasts && !blow.rests[i]) knock_open(index, theta);
      closed[index] = blow.rests[i];
    }
    apply_jump(t, theta);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (closed[i] != contacts_[i].lasts) contacts_[i].slip_sign = 0.0;
    contacts_[i].lasts = closed[i];
  }
}

// Of the actuators at the velocities at_: what a continuous controller asks now, of the others what
// they do over the step.
std::span<const Eigen::Vector2d> CoupledVerlet::ring_forces(
    double t, std::span<Eigen::Vector2d> forces) const {
  const double *q = there_.data(), *v = at_.data();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const AuxiliaryBearing& at = m_->auxiliary[i];
    forces[i].setZero();
    if (!at.moves()) continue;
    const auto ring = static_cast<std::size_t>(at.ring);
    const bool follows = at.controller && at.sample_time == 0.0 && t >= at.control_on;
    forces[i] = follows ? actuator_state(*m_, q, v, control_command(*m_, t, q, v, i), i).force
                        : Eigen::Vector2d(applied_[ring], applied_[ring + 1]);
  }
  return forces.first(contacts_.size());
}

// All loads at the velocities at_, and their power.
double CoupledVerlet::loads(double t, Columns& f) const {
  std::array<Eigen::Vector2d, kMaxContacts> rings;
  const std::span<const Eigen::Vector2d> forces = ring_forces(t, rings);
  unactuated_force(*m_, t, there_.data(), at_.data(), f.data());
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const int ring = m_->auxiliary[i].ring;
    if (ring == kAbsent) continue;
    f[static_cast<std::size_t>(ring)] += forces[i].x();
    f[static_cast<std::size_t>(ring) + 1] += forces[i].y();
  }
  return external_power(*m_, t, there_.data(), at_.data(), forces);
}

// The jump of the velocities by the impulses in jump_: this step's part and the next one's, with
// what the loads that depend on velocities miss of it.
void CoupledVerlet::apply_jump(double t, double theta) {
  const double late = (theta - 0.5) * h_;
  solve_mass(*m_, t, there_.data(), jump_.data(), jump_.data());
  // By the velocities just before and just after; a continuous controller sees the jump too.
  for (std::size_t i = 0; i < at_.size(); ++i) at_[i] = velocity_[i] + late * acceleration_[i];
  const double power = loads(t, before_);
  for (std::size_t i = 0; i < at_.size(); ++i) at_[i] += jump_[i];
  late_work_ -= late * (loads(t, missed_) - power);
  for (std::size_t i = 0; i < at_.size(); ++i) missed_[i] = -late * (missed_[i] - before_[i]);
  solve_mass(*m_, t, there_.data(), missed_.data(), missed_.data());
  for (std::size_t i = 0; i < at_.size(); ++i) {
    velocity_[i] += jump_[i];
    after_[i] += (1.0 - theta) * jump_[i];
    late_[i] += theta * jump_[i] + missed_[i];
  }
}

}  // namespace rotorub
