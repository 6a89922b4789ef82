// The impacts of CoupledVerlet: located in the step, each with all that is closed there.

#include <algorithm>
#include <cmath>

#include "native_model/contact/circle.h"
#include "native_model/contact/located_impact.h"
#include "native_model/contact/rebound.h"
#include "native_model/dynamics/closed_contacts.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/coupled_verlet.h"

namespace rotorub {

// The impacts of the step, in their order. What flies leaves its circle; what is closed takes part.
void CoupledVerlet::collide(std::int64_t k) {
  const Model& m = *m_;
  const std::size_t n = contacts_.size(), nq = after_.size();
  const double kick = was_first_ ? 0.5 * h_ : h_, t = origin + static_cast<double>(k) * h_;
  std::vector<double> velocity = after_, acceleration(nq), at(nq);
  for (std::size_t i = 0; i < nq; ++i) acceleration[i] = (after_[i] - start_[i]) / kick;
  std::array<Eigen::Vector2d, kMaxContacts> d;
  std::array<bool, kMaxContacts> closed{};
  for (std::size_t i = 0; i < n; ++i) d[i] = contacts_[i].d, closed[i] = contacts_[i].lasts;
  double theta = 0.0;
  const int most = StepImpacts::kMost * static_cast<int>(n);
  for (int count = 0; count < most; ++count) {
    // The first that leaves its circle.
    double share = 2.0;
    std::size_t first = n;
    std::array<Eigen::Vector2d, kMaxContacts> path;
    for (std::size_t i = 0; i < n; ++i) {
      const double clearance = contacts_[i].law.clearance;
      path[i] = (1.0 - theta) * h_ * rates(i, velocity.data()).head<2>();
      if (closed[i] || (d[i] + path[i]).norm() <= clearance) continue;
      const double exit = circle_exit(d[i], path[i], clearance);
      if (exit > 1.0) {
        closed[i] = d[i].norm() >= clearance;  // it never comes inside: no flight
      } else if (exit < share) {
        share = exit;
        first = i;
      }
    }
    if (first == n) break;
    for (std::size_t i = 0; i < n; ++i) d[i] += share * path[i];
    theta += share * (1.0 - theta);

    // All that is closed there, with the velocities of that instant.
    const double late = (theta - 0.5) * h_;
    for (std::size_t i = 0; i < nq; ++i) at[i] = velocity[i] + late * acceleration[i];
    std::array<ClosedContact, kMaxContacts> group{};
    std::array<ImpactLaw, kMaxContacts> laws{};
    std::array<double, kMaxContacts> pressed{};
    ContactVector b(static_cast<Eigen::Index>(2 * n));
    Eigen::Index size = 0;
    double approach = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const Contact& c = contacts_[i];
      const bool touches = i == first || d[i].norm() >= (1.0 - kOnCircle) * c.law.clearance;
      if (!closed[i] && !touches) continue;
      const auto g = static_cast<std::size_t>(size);
      group[g].index = i;
      group[g].point.e_r = d[i].normalized();
      const Eigen::Vector3d v = rates(i, at.data());
      const Eigen::Vector3d a = contact_acceleration(m, acceleration.data(), i);
      const double gap_rate = closed[i] ? 0.0 : -group[g].point.e_r.dot(v.head<2>());
      b.segment<2>(2 * size) << gap_rate, slip_of(group[g].point.e_r, c.law.radius, v);
      approach = std::max(approach, -gap_rate);
      pressed[g] = pressing(group[g].point.e_r, v, a, c.law.clearance);
      laws[g] = c.law.law();
      ++size;
    }
    if (approach == 0.0) {  // a touch
      closed[first] = true;
      continue;
    }
    const auto members = static_cast<std::size_t>(size);
    std::vector<double> there(before_);
    for (std::size_t i = 0; i < nq; ++i) there[i] += theta * h_ * velocity[i];
    const ContactMatrix g = delassus(m, t, there.data(), std::span(group).first(members));
    for (std::size_t i = 0; i < members; ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      const Contact& c = contacts_[group[i].index];
      // Without the force that a lasting contact has.
      if (c.lasts && closed[group[i].index]) {
        pressed[i] += (g(row, row) * c.normal + g(row, row + 1) * c.friction) / kick;
      }
      const bool stays =
          count + 1 == most || !flight_outlives(h_, -c.law.restitution * b[row], pressed[i]);
      if (b[row] < 0.0 && stays) laws[i].restitution = laws[i].tangential_restitution = 0.0;
    }
    const ContactVector before = b.head(2 * size);
    const auto solved = [&] {
      return solve_coupled_impact(g, before, std::span(laws).first(members));
    };
    CoupledSolution s = solved();
    // One that it knocks open too little for a flight stays.
    bool again = false;
    for (std::size_t i = 0; i < members && s.solutions == 1; ++i) {
      const double opens = s.y[static_cast<Eigen::Index>(2 * i)];
      if (!closed[group[i].index] || !(opens > 0.0) || flight_outlives(h_, opens, pressed[i]))
        continue;
      laws[i].restitution = laws[i].tangential_restitution = 0.0;
      again = true;
    }
    if (again) s = solved();
    if (s.solutions != 1) return fail(0, status_of(s.solutions));

    std::fill(at.begin(), at.end(), 0.0);
    for (std::size_t i = 0; i < members; ++i) {
      const auto row = static_cast<Eigen::Index>(2 * i);
      const std::size_t index = group[i].index;
      Contact& c = contacts_[index];
      const double normal = s.p[row], friction = s.p[row + 1];
      add_contact_load(m, contact_load(group[i].point.e_r, c.law.radius, normal, friction),
                       at.data(), index);
      const bool rests = s.y[row] <= kOnCircle * approach ||
                         (closed[index] && !flight_outlives(h_, s.y[row], pressed[i]));
      if (normal > 0.0) {
        hits_.push_back(
            {t + theta * h_, normal, friction, before[row], s.y[row], before[row + 1], s.y[row + 1],
             0.5 *
                 (normal * (before[row] + s.y[row]) + friction * (before[row + 1] + s.y[row + 1])),
             static_cast<int>(index)});
      }
      if (closed[index] && c.lasts && !rests) {
        // It carries nothing from here on, and the kick was for a whole step.
        const Eigen::Vector3d p = contact_load(c.e_r, c.law.radius, c.normal, c.friction);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Columns& column = response_[3 * index + axis];
          for (std::size_t j = 0; j < nq; ++j) {
            const double kicked = column[j] * p[static_cast<Eigen::Index>(axis)];
            late_[j] += (theta - 0.5) * kicked;
            acceleration[j] -= kicked / kick;
          }
        }
        c.lasts = false;
      }
      closed[index] = rests;
    }
    apply_jump(t, theta, there.data(), at, velocity, acceleration);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (closed[i] != contacts_[i].lasts) contacts_[i].slip_sign = 0.0;
    contacts_[i].lasts = closed[i];
  }
}

// Of the actuators at these velocities: what a continuous controller asks now, of the others what
// they do over the step.
std::span<const Eigen::Vector2d> CoupledVerlet::ring_forces(
    double t, const double* q, const double* v, std::span<Eigen::Vector2d> forces) const {
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

// The jump of the velocities by the impulses `load` (on the coordinates): this step's part and the
// next one's, with what the loads that depend on velocities miss of it.
void CoupledVerlet::apply_jump(double t, double theta, const double* q, std::span<double> load,
                               std::span<double> velocity, std::span<const double> acceleration) {
  const Model& m = *m_;
  const std::size_t nq = load.size();
  const double late = (theta - 0.5) * h_;
  solve_mass(m, t, q, load.data(), load.data());
  std::vector<double> at(nq), before(nq), missed(nq);
  // Loads and their power by the velocities just before and just after; a continuous controller
  // sees the jump too.
  std::array<Eigen::Vector2d, kMaxContacts> rings;
  const auto loads = [&](std::vector<double>& f) {
    const std::span<const Eigen::Vector2d> forces = ring_forces(t, q, at.data(), rings);
    unactuated_force(m, t, q, at.data(), f.data());
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const int ring = m.auxiliary[i].ring;
      if (ring == kAbsent) continue;
      f[static_cast<std::size_t>(ring)] += forces[i].x();
      f[static_cast<std::size_t>(ring) + 1] += forces[i].y();
    }
    return external_power(m, t, q, at.data(), forces);
  };
  for (std::size_t i = 0; i < nq; ++i) at[i] = velocity[i] + late * acceleration[i];
  const double power = loads(before);
  for (std::size_t i = 0; i < nq; ++i) at[i] += load[i];
  late_work_ -= late * (loads(missed) - power);
  for (std::size_t i = 0; i < nq; ++i) missed[i] = -late * (missed[i] - before[i]);
  solve_mass(m, t, q, missed.data(), missed.data());
  for (std::size_t i = 0; i < nq; ++i) {
    velocity[i] += load[i];
    after_[i] += (1.0 - theta) * load[i];
    late_[i] += theta * load[i] + missed[i];
  }
}

}  // namespace rotorub
