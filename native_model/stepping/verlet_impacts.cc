#include "native_model/stepping/verlet_impacts.h"

#include <algorithm>
#include <array>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/step_contact.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/stepping/verlet_step.h"
#include "native_model/system/actuation.h"

namespace rotorub {

namespace {

// The commands of the instant, q and v there, t: a continuous controller's of now, else those that
// hold.
Eigen::Vector2d command_at_impact(const Model& m, std::size_t bearing, double t, const double* q,
                                  const double* v, const Eigen::Vector2d& held) {
  const AuxiliaryBearing& at = m.auxiliary[bearing];
  const bool follows = at.controller && at.sample_time == 0.0 && t >= at.control_on;
  return follows ? control_command(m, t, q, v, bearing) : held;
}

}  // namespace

double jump_velocities(const Model& m, const ImpactInstant& at, double* jump, double* missed) {
  const int nq = m.nq();
  const std::size_t n = m.auxiliary.size();
  const double late = (at.theta - 0.5) * at.h;
  double v[kMaxCoordinates], before[kMaxCoordinates];
  solve_mass(m, at.t, at.q, jump, jump);
  // All loads, by the velocities just before and just after, and their power.
  const auto loads = [&](double* f) {
    std::array<Eigen::Vector2d, kMaxContacts> commands, rings;
    for (std::size_t i = 0; i < n; ++i) {
      commands[i] = command_at_impact(m, i, at.t, at.q, v, at.commands[i]);
      rings[i] = actuator_state(m, at.q, v, commands[i], i).force;
    }
    smooth_force(m, at.t, at.q, v, std::span(commands).first(n), f);
    return external_power(m, at.t, at.q, v, std::span(rings).first(n));
  };
  for (int i = 0; i < nq; ++i) v[i] = at.v[i] + late * at.acceleration[i];
  const double power = loads(before);
  for (int i = 0; i < nq; ++i) v[i] += jump[i];
  const double gained = loads(missed) - power;
  for (int i = 0; i < nq; ++i) missed[i] = -late * (missed[i] - before[i]);
  solve_mass(m, at.t, at.q, missed, missed);
  return -late * gained;
}

// ------------------------------------------------------------------ of one contact
template <class M, class Contacts>
void VerletStep<M, Contacts>::collide(const Mask& hits, std::int64_t k) {
  for (int lane = 0; lane < kLanes; ++lane) {
    if (lanes::get(hits, lane)) collide_lane(lane, k);
  }
}

template <class M, class Contacts>
void VerletStep<M, Contacts>::collide_lane(int lane, std::int64_t k) {
  const Model& m = lane_model(x.m, lane);
  const ContactParameters& c = *m.first().contact;
  const int nq = m.nq();
  const double h = x.h, kick = x.kick * h, t = x.time_of(k);
  double q[kMaxCoordinates], a[kMaxCoordinates], v[kMaxCoordinates];
  read_lane(x, x.seen, lane, q);
  read_lane(x, x.start, lane, a);
  read_lane(x, x.free, lane, v);

  FlightStep s;
  s.h = h;
  s.d = separation(m, q);
  s.velocity = rates_of_lane(x, x.free, lane);
  s.acceleration = (s.velocity - rates_of_lane(x, x.start, lane)) / kick;
  s.clearance = c.clearance;
  s.radius = c.radius;
  if (m.coupled_mass()) {  // M(phi) of the impact
    const double share = circle_exit(s.d, h * s.velocity.head<2>(), c.clearance);
    for (int i = 0; i < nq; ++i) q[i] += std::min(1.0, share) * h * v[i];
  }
  s.admittance = contact_admittance(m, t, q);
  s.duration = c.impact_time();
  const StepImpacts hits = locate_impacts(s, c.law());
  if (hits.status != Status::kOk) return x.fail(lane, hits.status);
  for (int i = 0; i < nq; ++i) a[i] = (v[i] - a[i]) / kick;
  const Eigen::Vector2d held{lanes::get(loads.command[0].x, lane),
                             lanes::get(loads.command[0].y, lane)};
  double jump[kMaxCoordinates], missed[kMaxCoordinates];
  for (int n = 0; n < hits.count; ++n) {
    const LocatedImpact& hit = hits.impacts[static_cast<std::size_t>(n)];
    if (hits.takes_time && n + 1 == hits.count) return begin_slow_impact(lane, k, v, a, hit.theta);
    const double normal = hit.law.normal(), friction = hit.law.friction();
    std::fill_n(jump, nq, 0.0);
    add_contact_load(m, contact_load(hit.e_r, c.radius, normal, friction), jump);
    late_work += jump_velocities(m, {t, h, hit.theta, q, v, a, std::span(&held, 1)}, jump, missed);
    for (int i = 0; i < nq; ++i) {
      v[i] += jump[i];
      add_to_lane(x.after[at(i)], lane, (1.0 - hit.theta) * jump[i]);
      add_to_lane(late[at(i)], lane, hit.theta * jump[i] + missed[i]);
    }
    owes = 1.0;
    contact.note_impact(
        lane, impact_of(t + hit.theta * h, {normal, friction},
                        {hit.gap_rate_before, hit.slip_before}, {hit.law.gap_rate, hit.law.slip}));
  }
  contact.set_lasting(lane, hits.closes);
}

// ------------------------------------------------------------------ impacts that take time
// The lanes in one, before the step.
template <class M, class Contacts>
void VerletStep<M, Contacts>::find_slow_impacts() {
  contact.held_open = false;
  for (int lane = 0; lane < kLanes; ++lane) {
    const bool active = slow_impacts[at(lane)].active();
    lanes::set(contact.flying, lane, active ? 0.0 : 1.0);
    contact.held_open = contact.held_open || active;
  }
}

template <class M, class Contacts>
void VerletStep<M, Contacts>::show_slow_impacts(std::int64_t k, T* now) const {
  double v[kMaxCoordinates];
  for (int lane = 0; lane < kLanes; ++lane) {
    if (lanes::get(contact.flying, lane) != 0.0) continue;
    slow_impacts[at(lane)].velocities(x.time_of(k), v);
    for (int i = 0; i < x.nq(); ++i) lanes::set(now[i], lane, v[i]);
  }
}

template <class M, class Contacts>
void VerletStep<M, Contacts>::go_on_with_slow_impacts(std::int64_t k) {
  last_time = static_cast<double>(k) * x.h;
  for (int lane = 0; lane < kLanes; ++lane) {
    if (lanes::get(contact.flying, lane) == 0.0) follow_slow_impact(lane, k);
  }
}

// A touch at the share theta of step k; v, a: velocities of the step's middle, accelerations.
template <class M, class Contacts>
void VerletStep<M, Contacts>::begin_slow_impact(int lane, std::int64_t k, const double* v,
                                                const double* a, double theta) {
  const Model& m = lane_model(x.m, lane);
  const double h = x.h, to_touch = (theta - 0.5) * h;
  const double t = x.origin + (static_cast<double>(k) + theta) * h;
  double q[kMaxCoordinates], rates[kMaxCoordinates];
  for (int i = 0; i < m.nq(); ++i) {
    q[i] = lanes::get(x.seen[at(i)], lane) + theta * h * v[i];
    rates[i] = v[i] + to_touch * a[i];
  }
  const AuxiliaryBearing& bearing = m.first();
  const bool follows = bearing.controller && bearing.sample_time == 0.0 && t >= bearing.control_on;
  const Eigen::Vector2d held{lanes::get(loads.command[0].x, lane),
                             lanes::get(loads.command[0].y, lane)};
  FiniteImpact& impact = slow_impacts[at(lane)];
  const Status found =
      impact.begin(t, q, rates, command_at_impact(m, 0, t, q, rates, held), follows);
  if (found != Status::kOk) return x.fail(lane, found);
  // The kick went on to the middle of the step.
  late_work += to_touch * impact.power_at_touch() + impact.external_work();
  impact_time[lane] = impact.end() - t;
  contact.note_impact(lane, impact.record());
  contact.set_lasting(lane, false);
  follow_slow_impact(lane, k);
}

// To the end of step k: within the impact, or in flight again.
template <class M, class Contacts>
void VerletStep<M, Contacts>::follow_slow_impact(int lane, std::int64_t k) {
  FiniteImpact& impact = slow_impacts[at(lane)];
  const double h = x.h, from = x.time_of(k), end = from + h;
  const int nq = x.nq();
  double to[kMaxCoordinates];
  if (end < impact.end()) {
    impact.coordinates(end, to);
    for (int i = 0; i < nq; ++i) {
      lanes::set(x.after[at(i)], lane, (to[i] - lanes::get(x.seen[at(i)], lane)) / h);
    }
    return;
  }
  const double *q, *v, *a;
  const double left = end - impact.end(), from_middle = left - 0.5 * h;
  late_work += from_middle * impact.power_at_end();
  const bool closes = impact.finish(q, v, a);
  for (int i = 0; i < nq; ++i) {
    const double flown = q[i] + left * (v[i] + 0.5 * left * a[i]);
    const double after = (flown - lanes::get(x.seen[at(i)], lane)) / h;
    lanes::set(x.after[at(i)], lane, after);
    lanes::set(late[at(i)], lane, v[i] + from_middle * a[i] - after);
  }
  owes = 1.0;
  lanes::set(contact.now.lasts, lane, closes ? 1.0 : 0.0);
}

#define ROTORUB_DEFINE(...)                                                         \
  template void VerletStep<__VA_ARGS__>::collide(const Mask&, std::int64_t);        \
  template void VerletStep<__VA_ARGS__>::find_slow_impacts();                       \
  template void VerletStep<__VA_ARGS__>::show_slow_impacts(std::int64_t, T*) const; \
  template void VerletStep<__VA_ARGS__>::go_on_with_slow_impacts(std::int64_t);
ROTORUB_ALL_MODELS(ROTORUB_DEFINE)
#undef ROTORUB_DEFINE

}  // namespace rotorub
