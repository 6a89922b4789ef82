// What the event-driven integrator does about contact: impacts, and the change between free flight,
// sliding and sticking.
#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/contact/impact_map.h"
#include "native_model/integrate/event.h"
#include "native_model/dynamics/dynamics.h"

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
  } else if (mode == Mode::kSlide && sign != phase_.sign()) {
    recorder_->add(Event{t_, EventKind::kReverse});
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
  Phase::Contact c = phase_.contact(t_, y_.data());
  // On an orbit as wide as the clearance the ring carries nothing but round-off, of either sign:
  // lasting contact, next to without force.
  const double none = options_.no_force * c.acceleration_scale;
  if (std::abs(c.gap_acceleration) < none) c.gap_acceleration = -none;
  force_scale_ = std::max(force_scale_, c.acceleration_scale / c.g.nn);
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
  record.gap_rate_after = r.gap_rate;
  record.slip_after = r.slip;
  const bool stuck = r.slip == 0.0;
  account(record, r.normal(), r.friction(), {p.gap_rate, p.slip}, {r.gap_rate, r.slip});
  impact_impulse_ += r.normal();
  if (r.gap_rate == 0.0) project(true, stuck);
  book(record, held);
  if (r.gap_rate > 0.0) return leave(Departure::kRebound);
  decide(stuck, Departure::kParting);
}

// Impulses that change the rates (gdot_N, gdot_T) from `before` to `after`, and their work.
void EventIntegrator::account(Impact& record, double normal, double friction,
                              const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  const double rubbed = 0.5 * friction * (before.y() + after.y());
  record.normal_impulse += normal;
  record.friction_impulse += friction;
  record.energy_change += 0.5 * normal * (before.x() + after.x()) + rubbed;
  recorder_->statistics().friction_work += rubbed;
}

// One row and one event; what the machine that holds a prescribed speed does is no work on the
// coordinates.
void EventIntegrator::book(const Impact& record, double held_slip) {
  impact_work_ += record.energy_change - record.friction_impulse * held_slip;
  Statistics& s = recorder_->statistics();
  s.impulse_total += record.normal_impulse;
  s.friction_impulse += record.friction_impulse;
  recorder_->add(record);
  recorder_->add(Event{record.t, EventKind::kImpact});
}

void EventIntegrator::fail_impact(ImpactStatus status) {
  fail(status == ImpactStatus::kNoSolution ? Status::kNoSolution : Status::kAmbiguous,
       "the impact laws have " +
           std::string(status == ImpactStatus::kNoSolution ? "no solution" : "several solutions"));
}

// An impact that takes tau_C + tau_E, (15)-(19): the loads of the touch act on during it, the
// coordinates move by qdot_C tau_C + qdot_E tau_E, and the clock goes on.
void EventIntegrator::finite_impact(const ContactPoint& p, ImpactInput in, Impact& record) {
  const Model& m = *model_;
  const ContactParameters& c = *m.contact;
  smooth_force(m, t_, q(), v(), phase_.command(t_, y_.data()), touch_.force.data());
  solve_mass(m, t_, q(), touch_.force.data(), touch_.acceleration.data());
  const double* a = touch_.acceleration.data();
  in.acceleration = in_contact_space(m, a);
  if (!m.layout.spin) in.acceleration.z() -= m.speed;
  in.compression_time = c.compression_time;
  in.expansion_time = c.expansion_time;
  const ImpactResult r = solve_impact(in, {c.friction, c.restitution, c.tangential_restitution});
  if (r.status != ImpactStatus::kOk) return fail_impact(r.status);
  impact_phase(p.e_r, c.compression_time, r.normal_compression, r.friction_compression, record);
  impact_phase(p.e_r, c.expansion_time, r.normal_expansion, r.friction_expansion, record);
  const ContactPoint after = contact_point(m, q(), v());
  record.gap_rate_after = after.gap_rate;
  record.slip_after = after.slip;
  book(record, m.layout.spin ? 0.0 : c.radius * m.speed);
  if (after.gap > 0.0 || t_ >= end_) return leave(Departure::kInside);
  // The straight path has left the circle: the way back to it is no work of the contact.
  const double stored = energy(m, t_, q(), v());
  project(after.gap_rate <= 0.0, false);
  y_[static_cast<std::size_t>(2 * m.nq() + kExternalWork)] += energy(m, t_, q(), v()) - stored;
  if (after.gap_rate > 0.0) return leave(Departure::kRebound);
  decide(false, Departure::kParting);
}

// One phase of it, over tau: velocities go straight from v_0 to v_1 = v_0 + tau a + M^-1 W p, the
// coordinates with v_1, normal and friction force are p / tau. A run that ends within it takes the
// part until then.
//
// Work: of the impulse W p between v_0 + tau a and v_1, which friction and Poisson's law keep from
// being a gain; of the loads between v_0 and v_0 + tau a; and, since the path goes with v_1 and the
// springs are held, what the stored energy grows by along the path at v_1.
void EventIntegrator::impact_phase(const Eigen::Vector2d& e_r, double tau, double normal,
                                   double friction, Impact& record) {
  if (t_ >= end_) return;
  const Model& m = *model_;
  const int n = m.nq();
  const double dt = std::min(tau, end_ - t_), share = tau > 0.0 ? dt / tau : 1.0;
  const double* a = touch_.acceleration.data();
  // Rates along the normal of the touch, which the impulses have.
  const auto rates = [&] {
    const Eigen::Vector3d w = in_contact_space(m, v());
    const Eigen::Vector2d e_t{-e_r.y(), e_r.x()};
    return Eigen::Vector2d(-e_r.dot(w.head<2>()), e_t.dot(w.head<2>()) + m.contact->radius * w.z());
  };
  const auto accelerate = [&](double time) {
    for (int i = 0; i < n; ++i) v()[i] += time * a[i];
  };
  // v_1, then the velocity at the end of what there is of the phase.
  std::copy_n(v(), n, touch_.before.data());
  const double gap_rate_before = rates().x();
  accelerate(tau);
  apply(e_r, normal, friction);
  std::copy_n(v(), n, touch_.after.data());
  const double *v0 = touch_.before.data(), *v1 = touch_.after.data();
  std::copy_n(v0, n, v());
  accelerate(dt);
  double work = 0.0;
  for (int i = 0; i < m.layout.mechanical(); ++i) {
    work += 0.5 * dt * touch_.force[static_cast<std::size_t>(i)] * (v0[i] + v()[i]);
  }
  const Eigen::Vector2d loaded = rates();
  apply(e_r, share * normal, share * friction);
  const Eigen::Vector2d after = rates();
  account(record, share * normal, share * friction, loaded, after);
  y_[static_cast<std::size_t>(2 * n + kGapRateSquare)] +=
      dt / 3.0 *
      (gap_rate_before * (gap_rate_before + after.x()) + after.x() * after.x());

  if (tau > 0.0) {
    impact_force_ = normal / tau;
    const double until = t_ + dt, last = share < 1.0 ? until : std::nextafter(until, t_);
    while (recorder_->next_time() <= last) {
      const double time = recorder_->next_time(), passed = time - t_;
      for (int i = 0; i < n; ++i) {
        row_[static_cast<std::size_t>(i)] = q()[i] + passed * v1[i];
        row_[static_cast<std::size_t>(n + i)] = v0[i] + passed / tau * (v1[i] - v0[i]);
      }
      Snapshot s = snapshot(time, row_.data());
      s.normal_force = normal / tau;
      s.friction_force = friction / tau;
      recorder_->row(s);
    }
    bins_until(until);
    impact_force_ = 0.0;
    contact_time_ += dt;
  }
  impact_impulse_ += share * normal;
  const double stored = energy(m, t_, q(), v());
  for (int i = 0; i < n; ++i) q()[i] += dt * v1[i];
  t_ = share < 1.0 ? end_ : t_ + dt;
  y_[static_cast<std::size_t>(2 * n + kExternalWork)] += work + energy(m, t_, q(), v()) - stored;
}

}  // namespace rotorub
