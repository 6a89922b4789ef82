// What the event-driven integrator does about contact: impacts, and the change between free flight,
// sliding and sticking.
#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/contact/impact_map.h"
#include "native_model/integrate/event.h"
#include "native_model/system/dynamics.h"

namespace rotorub {
namespace {

// (ddot, Omega_c) of generalized velocities; accelerations likewise, but for a prescribed spin.
Eigen::Vector3d in_contact_space(const Model& m, const double* v) {
  const Eigen::Vector2d d = rotor_point(m, v) - stator_point(m, v);
  return {d.x(), d.y(), contact_spin(m, v)};
}

}  // namespace

void EventIntegrator::apply(const Eigen::Vector2d& e_r, double normal, double friction) {
  const Model& m = *model_;
  std::fill(load_.begin(), load_.end(), 0.0);
  add_contact_load(m, contact_load(e_r, m.contact->radius, normal, friction), load_.data());
  solve_mass(m, t_, q(), load_.data(), load_.data());
  for (int i = 0; i < m.nq(); ++i) v()[i] += load_[static_cast<std::size_t>(i)];
}

// Coordinates back on the circle by the least change in the norm of M.
void EventIntegrator::to_circle(double t, double* q) {
  const Model& m = *model_;
  for (int k = 0; k < 2; ++k) {  // one Newton step and what round-off leaves
    const ContactPoint p = contact_point(m, q, v());
    const Delassus g = delassus(contact_admittance(m, t, q), p.e_r, m.contact->radius);
    std::fill(load_.begin(), load_.end(), 0.0);
    add_contact_load(m, contact_load(p.e_r, 0.0, -p.gap / g.nn, 0.0), load_.data());
    solve_mass(m, t, q, load_.data(), load_.data());
    for (int i = 0; i < m.nq(); ++i) q[i] += load_[static_cast<std::size_t>(i)];
  }
}

// Back on the circle (position), along it (velocity), without slip (slip): by the least change in
// the norm of M.
void EventIntegrator::project(bool velocity, bool slip) {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  to_circle(t_, q());
  if (!velocity) return;
  const ContactPoint p = contact_point(m, q(), v());
  const Delassus g = delassus(contact_admittance(m, t_, q()), p.e_r, c.radius);
  if (!slip) {
    apply(p.e_r, -p.gap_rate / g.nn, 0.0);
    return;
  }
  const PlanarImpulse<double> l = stick(g, p.gap_rate, p.slip);
  apply(p.e_r, l.normal, l.friction);
}

void EventIntegrator::enter(Mode mode, double sign) {
  if (!std::isfinite(phase_.first_touch())) phase_.first_touch(t_);
  if (mode != phase_.mode()) {
    recorder_->add(Event{t_, mode == Mode::kSlide ? EventKind::kSlide : EventKind::kStick});
  }
  phase_.set(mode, sign);
}

void EventIntegrator::leave(Departure departure) {
  if (phase_.mode() != Mode::kFree) recorder_->add(Event{t_, EventKind::kLiftOff});
  phase_.set(Mode::kFree, 1.0);
  departure_ = departure;
}

// On the circle with gap rate 0: free, sliding or sticking from here on.
void EventIntegrator::decide(bool slip_is_zero, Departure departure) {
  const double mu = model_->contact->friction;
  const Phase::Contact c = phase_.contact(t_, y_.data());
  if (!slip_is_zero && c.point.slip != 0.0) {
    const double sign = c.point.slip > 0.0 ? 1.0 : -1.0;
    if (carried(c.g, mu * sign) <= 0.0) {
      return fail(
          c.gap_acceleration < 0.0 ? Status::kNoSolution : Status::kAmbiguous,
          "sliding pushes itself in (mu |G_NT| > G_NN, Painleve): the contact forces have " +
              std::string(c.gap_acceleration < 0.0 ? "no solution" : "several solutions"));
    }
    if (c.gap_acceleration >= 0.0) return leave(departure);
    return enter(Mode::kSlide, sign);
  }
  const CoulombSolution s = solve_coulomb(c.g, c.gap_acceleration, c.slip_acceleration, mu);
  if (s.solutions != 1) {
    return fail(s.solutions == 0 ? Status::kNoSolution : Status::kAmbiguous,
                "the contact forces have " + std::to_string(s.solutions) + " solutions (Painleve)");
  }
  switch (s.contact_case) {
    case ContactCase::kOpen:
      return leave(departure);
    case ContactCase::kStick:
      return enter(Mode::kStick, 0.0);
    case ContactCase::kSlidePositive:
      return enter(Mode::kSlide, 1.0);
    case ContactCase::kSlideNegative:
      return enter(Mode::kSlide, -1.0);
  }
}

// A margin of lasting contact is reached.
void EventIntegrator::end_of_contact() {
  phase_.derivative(before_break(t_), y_.data(), row_slope_.data());
  const Phase::Margins m = phase_.margins();
  const Multipliers lambda = phase_.multipliers();
  const double speed = std::max(largest_speed_, model_->contact->radius * largest_spin_);
  const bool sliding = phase_.mode() == Mode::kSlide;
  const bool opens = m.force / force_scale_ <= m.cone / (sliding ? speed : force_scale_);
  project(true, sliding ? !opens : true);
  if (opens) return leave(Departure::kLiftOff);
  if (sliding) return decide(true, Departure::kParting);
  // Friction at its limit: slip begins against it.
  enter(Mode::kSlide, lambda.friction > 0.0 ? -1.0 : 1.0);
}

// With compression and expansion times: pressed by gddot_N < 0, the flight after an impact takes
// 2 eps_N |gdot_N| / |gddot_N|. Where the impact itself lasts as long there is no flight.
bool EventIntegrator::outlasts_its_flight(const ContactPoint& p) {
  const ContactParameters& c = *model_->contact;
  const double duration = c.compression_time + c.expansion_time;
  if (duration == 0.0) return false;
  const double pressed = -phase_.contact(t_, y_.data()).gap_acceleration;
  return -2.0 * c.restitution * p.gap_rate < pressed * duration;
}

void EventIntegrator::impact() {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  if (!std::isfinite(phase_.first_touch())) phase_.first_touch(t_);
  project(false, false);
  const ContactPoint p = contact_point(m, q(), v());
  if (p.gap_rate >= 0.0) {  // a touch
    project(true, false);
    return decide(false, Departure::kParting);
  }
  Impact record;
  record.t = t_;
  record.gap_rate_before = p.gap_rate;
  record.slip_before = p.slip;
  const double held = m.layout.spin ? 0.0 : c.radius * m.speed;
  ImpactInput in;
  in.admittance = contact_admittance(m, t_, q());
  in.e_r = p.e_r;
  in.radius = c.radius;
  in.delta = c.clearance;
  in.velocity = in_contact_space(m, v());
  in.acceleration.setZero();
  const bool closes = -p.gap_rate < options_.closing_gap_rate || outlasts_its_flight(p);
  const double duration = c.compression_time + c.expansion_time;
  if (duration > 0.0 && !closes) return finite_impact(p, in, record);

  const ImpactLaw law{c.friction, closes ? 0.0 : c.restitution,
                      closes ? 0.0 : c.tangential_restitution};
  const ImpactResult r = solve_impact(in, law);
  if (r.status != ImpactStatus::kOk) return fail_impact(r.status);
  apply(p.e_r, r.normal(), r.friction());
  record.normal_impulse = r.normal();
  record.friction_impulse = r.friction();
  record.gap_rate_after = r.gap_rate;
  record.slip_after = r.slip;
  const bool stuck = r.slip == 0.0;
  record.energy_change = 0.5 * (r.normal() * (record.gap_rate_before + r.gap_rate) +
                                r.friction() * (record.slip_before + r.slip));
  if (r.gap_rate == 0.0) project(true, stuck);
  book(record, held);
  if (r.gap_rate > 0.0) return leave(Departure::kRebound);
  decide(stuck, Departure::kParting);
}

// Impulses and works into statistics, one row and one event.
void EventIntegrator::book(Impact& record, double held_slip) {
  impact_work_ += record.energy_change - record.friction_impulse * held_slip;
  Statistics& s = recorder_->statistics();
  s.impulse_total += record.normal_impulse;
  impact_impulse_ += record.normal_impulse;
  s.friction_impulse += record.friction_impulse;
  s.friction_work += 0.5 * record.friction_impulse * (record.slip_before + record.slip_after);
  recorder_->add(record);
  recorder_->add(Event{record.t, EventKind::kImpact});
}

void EventIntegrator::fail_impact(ImpactStatus status) {
  fail(status == ImpactStatus::kNoSolution ? Status::kNoSolution : Status::kAmbiguous,
       "the impact laws have " +
           std::string(status == ImpactStatus::kNoSolution ? "no solution" : "several solutions"));
}

// An impact that takes tau_C + tau_E, (15)-(19): the loads act on during it, the coordinates move
// by qdot_C tau_C + qdot_E tau_E, and the clock goes on.
void EventIntegrator::finite_impact(const ContactPoint& p, ImpactInput in, Impact& record) {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  phase_.derivative(t_, y_.data(), row_slope_.data());
  const double* a = row_slope_.data() + m.nq();
  const Eigen::Vector2d dd = rotor_point(m, a) - stator_point(m, a);
  double spin = m.layout.spin ? a[m.layout.phi()] : 0.0;
  for (int k = 0; k < m.layout.torsion; ++k) spin += m.torsion_contact[k] * a[m.layout.theta() + k];
  in.acceleration = {dd.x(), dd.y(), spin};
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  const ImpactResult r = solve_impact(in, {c.friction, c.restitution, c.tangential_restitution});
  if (r.status != ImpactStatus::kOk) return fail_impact(r.status);
  // Rates along the normal of the touch, which the impulses have.
  const auto rates = [&] {
    const Eigen::Vector3d w = in_contact_space(m, v());
    const Eigen::Vector2d e_t{-p.e_r.y(), p.e_r.x()};
    return Eigen::Vector2d(-p.e_r.dot(w.head<2>()), e_t.dot(w.head<2>()) + c.radius * w.z());
  };
  const auto phase = [&](double tau, double normal, double friction) {
    tau = std::min(tau, end_ - t_);
    Eigen::Map<Eigen::VectorXd> velocity(v(), m.nq()), mean(row_.data(), m.nq());
    mean = 0.5 * velocity;
    velocity += tau * Eigen::Map<const Eigen::VectorXd>(a, m.nq());
    const Eigen::Vector2d before = rates(), impulse{normal, friction};
    apply(p.e_r, normal, friction);
    mean += 0.5 * velocity;
    record.energy_change += 0.5 * impulse.dot(before + rates());
    y_[static_cast<std::size_t>(2 * m.nq() + kExternalWork)] +=
        tau * external_power(m, t_, q(), mean.data(),
                             actuator_state(m, q(), v(), phase_.command(t_, y_.data())).force);
    for (int i = 0; i < m.nq(); ++i) q()[i] += tau * v()[i];
    t_ += tau;
  };
  phase(c.compression_time, r.normal_compression, r.friction_compression);
  phase(c.expansion_time, r.normal_expansion, r.friction_expansion);
  const ContactPoint after = contact_point(m, q(), v());
  record.normal_impulse = r.normal();
  record.friction_impulse = r.friction();
  record.gap_rate_after = after.gap_rate;
  record.slip_after = after.slip;
  book(record, m.layout.spin ? 0.0 : c.radius * m.speed);
  if (after.gap > 0.0) return leave(Departure::kInside);
  project(after.gap_rate <= 0.0, false);
  if (after.gap_rate > 0.0) return leave(Departure::kRebound);
  decide(false, Departure::kParting);
}

}  // namespace rotorub
