#include "native_model/stepping/euler.h"

#include <cmath>

#include "native_model/contact/impact.h"
#include "native_model/contact/impact_record.h"
#include "native_model/contact/rebound.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"

namespace rotorub {
namespace {

Eigen::Vector3d rates(const Model& m, const Eigen::VectorXd& v) {
  const Eigen::Vector2d d = rotor_point(m, v.data()) - stator_point(m, v.data());
  return {d.x(), d.y(), contact_spin(m, v.data())};  // of accelerations the first two alone
}

}  // namespace

FixedStep EulerStepper::step(std::int64_t k, const Eigen::Vector2d& u, bool works) {
  const Model& m = *model_;
  FixedStep out;
  const double t = static_cast<double>(k) * h_;
  const State start = state_;
  smooth_force(m, t, q(), v(), u, f_.data());
  solve_mass(m, t, q(), f_.data(), f_.data());
  free_ = start.v + h_ * f_;
  state_.v = free_;
  if (m.first().contact) touch(t, out);
  if (out.status == Status::kOk && !state_.v.allFinite()) out.status = Status::kDiverged;
  if (out.status != Status::kOk) {
    state_ = start;
    return out;
  }
  if (works) {
    const Eigen::Vector2d ring = actuator_state(m, start.q.data(), start.v.data(), u).force;
    const auto power = [&](const State& s, double at) {
      return external_power(m, at, s.q.data(), s.v.data(), ring);
    };
    State end = state_;
    end.q += h_ * end.v;
    out.external_work = 0.5 * h_ * (power(start, t) + power(end, t + h_));
    for (const Impact& hit : out.impacts) {
      const double held = m.layout.spin ? 0.0 : m.first().contact->radius * m.speed;
      out.contact_work += hit.energy_change - hit.friction_impulse * held;
    }
    if (out.impacts.empty() && out.normal_impulse > 0.0) {
      const Eigen::Vector2d e_r = separation(m, q()).normalized();
      const Eigen::Vector3d mean = 0.5 * (rates(m, start.v) + rates(m, state_.v));
      Eigen::Vector3d of_coordinates = mean;
      if (!m.layout.spin) of_coordinates.z() -= m.speed;
      out.contact_work =
          contact_load(e_r, m.first().contact->radius, out.normal_impulse, out.friction_impulse)
              .dot(of_coordinates);
    }
  }
  state_.q += h_ * state_.v;
  state_.t = t + h_;
  return out;
}

void EulerStepper::push(double t, const Eigen::Vector2d& e_r, double normal, double friction) {
  const Model& m = *model_;
  f_.setZero();
  add_contact_load(m, contact_load(e_r, m.first().contact->radius, normal, friction), f_.data());
  solve_mass(m, t, q(), f_.data(), f_.data());
  state_.v += f_;
}

// One row of an impact; its impulses are those of the step.
void EulerStepper::record(double t, const Eigen::Vector2d& e_r, FixedStep& out) {
  const double radius = model_->first().contact->radius;
  const Eigen::Vector2d before = rates_along(e_r, radius, rates(*model_, free_));
  const Eigen::Vector2d after = rates_along(e_r, radius, rates(*model_, state_.v));
  const ImpulseWork work = impulse_work(out.normal_impulse, out.friction_impulse, before, after);
  hit_ = {t + h_,     out.normal_impulse, out.friction_impulse, before.x(), after.x(),
          before.y(), after.y(),          work.total()};
  out.impacts = {&hit_, 1};
  out.mode = Mode::kFree;
}

void EulerStepper::touch(double t, FixedStep& out) {
  const Model& m = *model_;
  const ContactParameters& c = *m.first().contact;
  const Eigen::Vector2d d = separation(m, q());
  const bool lasted = in_contact_;
  in_contact_ = false;
  const double delta = d.norm();
  if (delta <= kNoNormal) return;
  const Eigen::Vector2d e_r = d / delta;
  const Eigen::Vector3d free = rates(m, free_), acceleration = rates(m, f_);
  // (12): the gap of the step's end, linearised about q.
  const double gap = c.clearance - delta - h_ * e_r.dot(free.head<2>());
  if (gap >= 0.0) return;
  const double closing = e_r.dot(free.head<2>());
  const double pressed = pressing(e_r, free, acceleration, c.clearance);
  const Delassus g = delassus(contact_admittance(m, t, q()), e_r, c.radius);
  if (!lasted && rebound_outlives_steps(h_, c.restitution, closing, pressed)) {
    const ImpactResult r = solve_impact(g, -closing, rates_along(e_r, c.radius, free).y(), c.law());
    out.status = r.status;
    if (r.status != Status::kOk) return;
    out.normal_impulse = r.normal();
    out.friction_impulse = r.friction();
    push(t, e_r, r.normal(), r.friction());
    return record(t, e_r, out);
  }
  const double slip = rates_along(e_r, c.radius, free).y();
  const CoulombSolution s = solve_coulomb(g, gap / h_, slip, c.friction.at(slip));
  out.status = status_of(s.solutions);
  if (out.status != Status::kOk) return;
  out.normal_impulse = s.normal;
  out.friction_impulse = s.friction;
  push(t, e_r, s.normal, s.friction);
  in_contact_ = true;
  out.mode = mode_of(s);
  // Closed without a rebound: the impact is in the step's impulse.
  if (!lasted) record(t, e_r, out);
}

}  // namespace rotorub
