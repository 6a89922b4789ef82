// The impacts of a step of `verlet`: located in the step, of one contact or of several, and those
// that take time.
#include <algorithm>
#include <array>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/step_contact.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/stepping/shared_impact.h"
#include "native_model/stepping/verlet_step.h"

namespace rotorub {
namespace {

// The command of the instant, q and v there, t: a continuous controller's of now, else the one that
// holds.
bool follows(const AuxiliaryBearing& at, double t) {
  return at.controller && at.sample_time == 0.0 && t >= at.control_on;
}
Eigen::Vector2d command_at_impact(const Model& m, std::size_t bearing, double t, const double* q,
                                  const double* v, const Eigen::Vector2d& held) {
  return follows(m.auxiliary[bearing], t) ? control_command(m, t, q, v, bearing) : held;
}

// An impact at the share theta of the step of h (s) from t on.
struct ImpactInstant {
  double t, h, theta;
  const double* q;                            // coordinates at which M and loads are taken
  const double *v, *acceleration;             // of the step's middle before the impact
  std::span<const Eigen::Vector2d> commands;  // that hold over the step
};

// jump: in, the load of the impulses; out, what the velocities jump by. missed: what the loads that
// depend on velocities miss of it, -(theta - 1/2) h M^-1 (F(v + jump) - F(v)). nq values each. A
// continuous controller sees the jump too. Gives the work that the mean of the step's velocities
// misses, J.
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

}  // namespace

// ------------------------------------------------------------------ of one contact
template <>
void VerletStep<OneContact>::collide(std::int64_t k) {
  const Model& m = x.m;
  const ContactParameters& c = *m.first().contact;
  const int nq = m.nq();
  const double h = x.h, kick = x.kick * h, t = x.time_of(k);
  const double* start = x.start.data();
  double *after = x.after.data(), *late = late_.data();
  double q[kMaxCoordinates], v[kMaxCoordinates], a[kMaxCoordinates];
  std::copy(x.seen.begin(), x.seen.end(), q);
  std::copy(x.free.begin(), x.free.end(), v);
  for (int i = 0; i < nq; ++i) a[i] = (v[i] - start[i]) / kick;

  FlightStep s;
  s.h = h;
  s.d = separation(m, q);
  s.velocity = contact_rates(m, v);
  s.acceleration = (s.velocity - contact_rates(m, start)) / kick;
  s.clearance = c.clearance;
  s.radius = c.radius;
  if (m.coupled_mass()) {  // M(phi) of the impact
    const double share = circle_exit(s.d, h * s.velocity.head<2>(), c.clearance);
    for (int i = 0; i < nq; ++i) q[i] += std::min(1.0, share) * h * v[i];
  }
  s.admittance = contact_admittance(m, t, q);
  s.duration = c.impact_time();
  const StepImpacts hits = locate_impacts(s, c.law());
  if (hits.status != Status::kOk) return x.fail(hits.status);
  double jump[kMaxCoordinates], missed[kMaxCoordinates];
  for (int n = 0; n < hits.count; ++n) {
    const LocatedImpact& hit = hits.impacts[static_cast<std::size_t>(n)];
    if (hits.takes_time && n + 1 == hits.count) return begin_slow_impact(k, v, a, hit.theta);
    const double normal = hit.law.normal(), friction = hit.law.friction();
    std::fill_n(jump, nq, 0.0);
    add_contact_load(m, contact_load(hit.e_r, c.radius, normal, friction), jump);
    const ImpactInstant instant{t, h, hit.theta, q, v, a, std::span(loads.command).first(1)};
    late_work_ += jump_velocities(m, instant, jump, missed);
    for (int i = 0; i < nq; ++i) {
      v[i] += jump[i];
      after[i] += (1.0 - hit.theta) * jump[i];
      late[i] += hit.theta * jump[i] + missed[i];
    }
    owes_ = true;
    contact.note_impact(impact_of(t + hit.theta * h, {normal, friction},
                                  {hit.gap_rate_before, hit.slip_before},
                                  {hit.law.gap_rate, hit.law.slip}));
  }
  contact.set_lasting(hits.closes);
}

// ------------------------------------------------------------------ impacts that take time
// A touch at the share theta of step k; v, a: velocities of the step's middle, accelerations.
template <>
void VerletStep<OneContact>::begin_slow_impact(std::int64_t k, const double* v, const double* a,
                                               double theta) {
  const Model& m = x.m;
  const double h = x.h, to_touch = (theta - 0.5) * h;
  const double t = x.origin + (static_cast<double>(k) + theta) * h;
  const double* seen = x.seen.data();
  double q[kMaxCoordinates], rates[kMaxCoordinates];
  for (int i = 0; i < m.nq(); ++i) {
    q[i] = seen[i] + theta * h * v[i];
    rates[i] = v[i] + to_touch * a[i];
  }
  FiniteImpact& impact = *slow_impact_;
  const Eigen::Vector2d command = command_at_impact(m, 0, t, q, rates, loads.command[0]);
  const Status found = impact.begin(t, q, rates, command, follows(m.first(), t));
  if (found != Status::kOk) return x.fail(found);
  // The kick went on to the middle of the step.
  late_work_ += to_touch * impact.power_at_touch() + impact.external_work();
  impact_time_ = impact.end() - t;
  contact.note_impact(impact.record());
  contact.set_lasting(false);
  follow_slow_impact(k);
}

// To the end of step k: within the impact, or in flight again.
template <>
void VerletStep<OneContact>::follow_slow_impact(std::int64_t k) {
  FiniteImpact& impact = *slow_impact_;
  const double h = x.h, end = x.time_of(k) + h;
  const int nq = x.nq();
  const double* seen = x.seen.data();
  double *after = x.after.data(), *late = late_.data();
  last_time_ = static_cast<double>(k) * h;
  if (end < impact.end()) {
    double to[kMaxCoordinates];
    impact.coordinates(end, to);
    for (int i = 0; i < nq; ++i) after[i] = (to[i] - seen[i]) / h;
    return;
  }
  const double *q, *v, *a;
  const double left = end - impact.end(), from_middle = left - 0.5 * h;
  late_work_ += from_middle * impact.power_at_end();
  const bool closes = impact.finish(q, v, a);
  for (int i = 0; i < nq; ++i) {
    const double flown = q[i] + left * (v[i] + 0.5 * left * a[i]);
    after[i] = (flown - seen[i]) / h;
    late[i] = v[i] + from_middle * a[i] - after[i];
  }
  owes_ = true;
  contact.now.lasts = closes;
}

// ------------------------------------------------------------------ of several contacts
// Each impact takes with it all that is closed there. A resting contact that one knocks open
// carries nothing from there on: the next step gives back (1/2 - theta) of its step impulse.
namespace {

constexpr double kOnCircle = 1e-12;  // of the clearance: as good as on it

// The flight through a step, from impact to impact.
struct Flight {
  double theta = 0.0;                             // share of the step that is over
  std::array<Eigen::Vector2d, kMaxContacts> d{};  // m, of each contact there
  std::array<bool, kMaxContacts> closed{};
  double v[kMaxCoordinates], a[kMaxCoordinates];  // of the step's middle, and accelerations
};

// The contact whose path leaves its circle first, with the flight at that instant; the number of
// contacts: none does. One that never comes inside is closed: it has no flight.
std::size_t next_touch(const SeveralContacts& contacts, double h, Flight& flight) {
  const std::size_t n = contacts.count();
  double share = 2.0;
  std::size_t first = n;
  std::array<Eigen::Vector2d, kMaxContacts> path;
  for (std::size_t i = 0; i < n; ++i) {
    const double clearance = contacts.law(i).clearance;
    path[i] = (1.0 - flight.theta) * h * contacts.rates(i, flight.v).head<2>();
    if (flight.closed[i] || (flight.d[i] + path[i]).norm() <= clearance) continue;
    const double exit = circle_exit(flight.d[i], path[i], clearance);
    if (exit > 1.0) {
      flight.closed[i] = flight.d[i].norm() >= clearance;
    } else if (exit < share) {
      share = exit;
      first = i;
    }
  }
  if (first == n) return n;
  for (std::size_t i = 0; i < n; ++i) flight.d[i] += share * path[i];
  flight.theta += share * (1.0 - flight.theta);
  return first;
}

}  // namespace

template <>
void VerletStep<SeveralContacts>::collide(std::int64_t k) {
  const Model& m = x.m;
  const std::size_t n = contact.count();
  const int nq = x.nq();
  bool hit = false;
  for (std::size_t i = 0; i < n; ++i) {
    contact.places[i].free = contact.rates(i, x.after.data());
    hit = hit || (!contact.now.of[i].lasts && contact.leaves(i, contact.places[i].free));
  }
  if (!hit) return;
  contact.keep_end(x);
  const double t = x.time_of(k), h = x.h;
  const double *start = x.start.data(), *seen = x.seen.data();
  double *after = x.after.data(), *late = late_.data();
  Flight flight;
  for (int i = 0; i < nq; ++i) {
    flight.v[i] = after[i];
    flight.a[i] = (after[i] - start[i]) / (x.kick * h);
  }
  for (std::size_t i = 0; i < n; ++i) {
    flight.d[i] = contact.places[i].d;
    flight.closed[i] = contact.now.of[i].lasts;
  }
  double now_v[kMaxCoordinates], now_q[kMaxCoordinates];
  double jump[kMaxCoordinates], missed[kMaxCoordinates];

  const int most = StepImpacts::kMost * static_cast<int>(n);
  for (int count = 0; count < most; ++count) {
    const std::size_t first_touch = next_touch(contact, h, flight);
    if (first_touch == n) break;
    // All that is closed there, with the velocities of that instant.
    const double theta = flight.theta;
    for (int i = 0; i < nq; ++i) {
      now_v[i] = flight.v[i] + (theta - 0.5) * h * flight.a[i];
      now_q[i] = seen[i] + theta * h * flight.v[i];
    }
    SharedImpact impact(contact);
    for (std::size_t i = 0; i < n; ++i) {
      const double on_circle = (1.0 - kOnCircle) * contact.law(i).clearance;
      if (!flight.closed[i] && i != first_touch && flight.d[i].norm() < on_circle) continue;
      impact.join(i, flight.closed[i], flight.d[i].normalized(), now_v, flight.a);
    }
    if (impact.approach() == 0.0) {  // a touch
      flight.closed[first_touch] = true;
      continue;
    }
    const Status found = impact.strike(x, t + theta * h, t, now_q, count + 1 == most, jump);
    if (found != Status::kOk) return x.fail(found);
    for (std::size_t i = 0; i < impact.count(); ++i) {
      const std::size_t index = impact.contact(i);
      SeveralContacts::Lasting::Of& c = contact.now.of[index];
      if (flight.closed[index] && c.lasts && !impact.rests(i)) {
        // Knocked open: it carries nothing from here on, and the kick was for a whole step.
        std::fill_n(missed, nq, 0.0);
        contact.push(index, c.normal, c.friction, std::span(missed).first(x.after.size()));
        for (int j = 0; j < nq; ++j) {
          late[j] += (theta - 0.5) * missed[j];
          flight.a[j] -= missed[j] / (x.kick * h);
        }
        c.lasts = false;
      }
      flight.closed[index] = impact.rests(i);
    }
    const ImpactInstant instant{
        t, h, theta, now_q, flight.v, flight.a, std::span(loads.command).first(n)};
    late_work_ += jump_velocities(m, instant, jump, missed);
    for (int i = 0; i < nq; ++i) {
      flight.v[i] += jump[i];
      after[i] += (1.0 - theta) * jump[i];
      late[i] += theta * jump[i] + missed[i];
    }
    owes_ = true;
  }
  for (std::size_t i = 0; i < n; ++i) contact.set_lasting(i, flight.closed[i]);
}

}  // namespace rotorub
