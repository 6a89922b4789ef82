#include "native_model/stepping/verlet.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/contact/kinematics.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/stepping/shared_impact.h"

namespace rotorub {
namespace {

// Fraction of a step; jumps of loads or commands closer to its ends differ from them only by
// round-off.
constexpr double kLeastPart = 1e-9;
constexpr double kOnCircle = 1e-12;  // of the clearance; smaller gaps count as closed

bool impacts_take_time(const Model& m) {
  return m.auxiliary.size() == 1 && m.first().contact && m.first().contact->impact_time() > 0.0;
}

}  // namespace

VerletStep::VerletStep(const Model& model, double h)
    : x(model, h),
      loads(model, h),
      contacts(x, loads),
      deferred_(x.q),
      switches_(std::isfinite(next_switch(model, 0.0, std::numeric_limits<double>::infinity()))),
      mean_after_(x.q),
      part_sum_(x.q) {
  if (impacts_take_time(model)) slow_impact_.emplace(model);
}

std::size_t VerletStep::count_kept(const Model& model) {
  const auto n = static_cast<std::size_t>(model.nq());
  const std::size_t origin = 1, state = 2 * n, flags = 2, late = n;
  return StepContacts::count_kept(model) + origin + state + LoadKick::count_kept(model) + flags +
         late + (impacts_take_time(model) ? FiniteImpact::count_kept(model) : 0);
}

// ------------------------------------------------------------------ the step
void VerletStep::step(std::int64_t k) {
  work_correction_ = impact_time_ = 0.0;
  contacts.forget_last();
  const bool later = iterates_with_contact();
  x.begin(has_deferred_ ? deferred_.data() : nullptr);
  const bool kicked = looked_at_ == k && loads.exchange_commands(x, looked_commands_);
  looked_at_ = kNoStep;
  if (!kicked) kick(k, later);
  if (has_deferred_) std::fill(deferred_.begin(), deferred_.end(), 0.0);
  has_deferred_ = false;
  was_first_ = first_;
  in_slow_impact_ = slow_impact_ && slow_impact_->active();
  if (in_slow_impact_) {
    follow_slow_impact(k);
  } else if (contacts.exists()) {
    const double end = x.time_of(k) + 0.5 * x.h, begin = was_first_ ? x.time_of(k) : end - x.h;
    const double share = share_before_jump(begin, end);
    if (share > 0.0) before_parts_ = contacts.now;
    x.kick = was_first_ ? 0.5 : 1.0;
    contacts.go_on(x, later);
    if (share > 0.0) split(share, begin, end);
    if (contacts.leave_flight(x)) collide(k);
    x.kick = 1.0;
  }
  if (has_command_jumps_) forget_command_jumps();
  first_ = false;
  x.move();
}

// True if the free velocity is iterated together with the contacts, and not before.
bool VerletStep::iterates_with_contact() const {
  return loads.iterates() && !first_ && !slow_impact_ && contacts.iterates_free();
}

// Computes x.free and x.after of step k without contact; later: see LoadKick.
void VerletStep::kick(std::int64_t k, bool later) {
  const double t = x.time_of(k);
  loads.free_velocity(x, k, first_ ? t : t - 0.5 * x.h, t, later);
  if (first_) halve_kick();
}

// A first step has only half of the kick.
void VerletStep::halve_kick() {
  for (std::size_t i = 0; i < x.free.size(); ++i) x.free[i] = 0.5 * (x.start[i] + x.free[i]);
  x.after = x.free;
  loads.forget_forces();
}

void VerletStep::velocity_now(std::int64_t k, double* now) {
  if (first_) {
    std::copy(x.v.begin(), x.v.end(), now);
    return;
  }
  x.look(has_deferred_ ? deferred_.data() : nullptr);
  // In lasting contact the force of the step before makes an error of order h^2 anyway.
  kick(k, iterates_with_contact());
  looked_at_ = k;
  looked_commands_ = loads.command;
  if (slow_impact_ && slow_impact_->active()) return slow_impact_->velocities(x.time_of(k), now);
  if (contacts.exists()) contacts.add_last_forces(x);
  for (std::size_t i = 0; i < x.free.size(); ++i) now[i] = 0.5 * (x.start[i] + x.free[i]);
}

void VerletStep::restart() {
  first_ = true;
  has_deferred_ = false;
  forget_look();
  std::fill(deferred_.begin(), deferred_.end(), 0.0);
  loads.forget();
  if (slow_impact_) slow_impact_->cancel();
  contacts.begin(x);
}

void VerletStep::last_velocity(double* now) const {
  const double *start = x.start.data(), *end = contacts.end_without_impacts(x);
  for (int i = 0; i < x.nq(); ++i) now[i] = was_first_ ? start[i] : 0.5 * (start[i] + end[i]);
  for (int i = x.m.sampled_states(); i < x.m.layout.coil(); ++i) now[i] = start[i];
  if (in_slow_impact_) slow_impact_->velocities(x.origin + slow_impact_step_, now);
}

double VerletStep::external_work() {
  if (in_slow_impact_) return work_correction_;  // the impact books this work
  const double kick = was_first_ ? 0.5 : 1.0;
  return kick * loads.external_work(x, contacts.end_without_impacts(x)) + work_correction_;
}

// ------------------------------------------------------------------ jumps of loads and commands
// In flight only the mean load over the step matters. In lasting contact the contact force is not
// that of the mean load: contact ends, or friction reverses, at the instant of the jump. Therefore
// the velocities of the step are the weighted sum of those that the loads before and after the jump
// would give if they held throughout,
//
//   v_{k+1/2} = s v_before + (1 - s) v_after,   (N, T) likewise,
//
// with the fraction s of the step before the jump. This keeps order 2. If contact goes on unchanged
// in both parts, the mean load gives the same result, and the step ends on the circle.
//
// announce_command_jump() notes the jump of a command, split() takes the step in its two parts,
// after it was taken with its mean loads.
void VerletStep::announce_command_jump(std::size_t ring, const CommandJump& command) {
  command_jumps_[ring] = command;
  has_command_jumps_ = has_command_jumps_ || command.share > 0.0;
  if (has_command_jumps_) loads.command_jumps = command_jumps_;
}

void VerletStep::forget_command_jumps() {
  command_jumps_.fill({});
  has_command_jumps_ = false;
  loads.command_jumps = {};
}

// The fraction of the kick from `begin` to `end` (s) before a load or a command jumps in lasting
// contact; 0: none jumps, or it jumps at an end of the kick. If commands jump at several instants,
// the first counts; a switched load counts only if no command jumps.
double VerletStep::share_before_jump(double begin, double end) {
  if (!(switches_ || has_command_jumps_) || !contacts.lasts()) return 0.0;
  constexpr double kNone = 2.0;
  double share = kNone;
  for (const CommandJump& command : command_jumps_) {
    if (has_command_jumps_ && command.share > 0.0) share = std::min(share, command.share);
  }
  if (share == kNone) {
    if (!(begin >= switch_from_ && begin < switch_at_)) {
      switch_from_ = begin;
      switch_at_ = next_switch(x.m, begin, std::numeric_limits<double>::infinity());
    }
    if (switch_at_ >= end) return 0.0;
    share = (switch_at_ - begin) / (end - begin);
  }
  return share > kLeastPart && share < 1.0 - kLeastPart ? share : 0.0;
}

void VerletStep::split(double share, double begin, double end) {
  const StepContacts::State& was = before_parts_;
  const double rest = 1.0 - share, middle = begin + share * (end - begin);
  const LoadKick::Commands mean_commands = loads.command;
  const StepContacts::State mean = contacts.now;
  mean_after_ = x.after;
  command_part(true, share);
  take_part(was, begin, middle);
  const StepContacts::State before = contacts.now;
  for (std::size_t i = 0; i < part_sum_.size(); ++i) part_sum_[i] = share * x.after[i];
  command_part(false, share);
  take_part(contacts.second_part(was, before), middle, end);
  for (std::size_t i = 0; i < part_sum_.size(); ++i) part_sum_[i] += rest * x.after[i];

  // Restores the loads of the whole step: x.free, and the basis of the works.
  loads.command = mean_commands;
  loads.free_velocity_of_part(x, begin, end);
  if (was_first_) halve_kick();
  if (contacts.alike(mean, was) && contacts.alike(before, was) &&
      contacts.alike(contacts.now, was)) {
    contacts.go_on_as(mean);
    x.after = mean_after_;
  } else {
    contacts.join_parts(share, rest, before, x.kick);
    x.after = part_sum_;
  }
}

// Takes the whole step as if the loads from `begin` to `end` held throughout: x.after and the
// contacts.
void VerletStep::take_part(const StepContacts::State& was, double begin, double end) {
  loads.free_velocity_of_part(x, begin, end);
  if (was_first_) halve_kick();
  contacts.now = was;
  contacts.go_on(x);
}

// A command that jumps at a later instant keeps its mean.
void VerletStep::command_part(bool before, double share) {
  for (std::size_t i = 0; i < command_jumps_.size(); ++i) {
    if (command_jumps_[i].share == 0.0 || command_jumps_[i].share - share > kLeastPart) continue;
    loads.command[i] = before ? command_jumps_[i].before : command_jumps_[i].after;
  }
}

// ------------------------------------------------------------------ impacts
// The flight through a step, from impact to impact.
struct VerletStep::Flight {
  double theta = 0.0;                             // fraction of the step that is over
  std::array<Eigen::Vector2d, kMaxContacts> d{};  // m, of each contact at theta
  std::array<bool, kMaxContacts> closed{};
  double v[kMaxCoordinates], a[kMaxCoordinates];  // at the step's middle; accelerations
};

// Returns the contact whose path leaves its circle first, and advances the flight to that instant;
// returns the number of contacts if none leaves. A contact whose path never comes inside has no
// flight and counts as closed.
std::size_t VerletStep::next_touch(Flight& flight) const {
  const std::size_t n = contacts.count();
  double share = 2.0;
  std::size_t first = n;
  std::array<Eigen::Vector2d, kMaxContacts> path;
  path.fill(Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < n; ++i) {
    if (!contacts.is_rigid(i) || !x.m.auxiliary[i].contact) continue;
    const double clearance = contacts.law(i).clearance;
    path[i] = (1.0 - flight.theta) * x.h * contacts.rates(i, flight.v).head<2>();
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

// Solves the impacts of the step; each one includes all contacts that are closed at its instant.
void VerletStep::collide(std::int64_t k) {
  const std::size_t n = contacts.count();
  const int nq = x.nq();
  contacts.keep_end(x);
  const double t = x.time_of(k), h = x.h;
  Flight flight;
  for (int i = 0; i < nq; ++i) {
    const auto at = static_cast<std::size_t>(i);
    flight.v[i] = x.after[at];
    flight.a[i] = (x.after[at] - x.start[at]) / (x.kick * h);
  }
  for (std::size_t i = 0; i < n; ++i) {
    flight.d[i] = contacts.place(i);
    flight.closed[i] = contacts.is_rigid(i) && contacts.now[i].closed;
  }
  double v[kMaxCoordinates], q[kMaxCoordinates], velocity_jump[kMaxCoordinates];
  const int most = kMostImpacts * static_cast<int>(n);
  for (int count = 0; count < most; ++count) {
    const std::size_t first_touch = next_touch(flight);
    if (first_touch == n) break;
    // All contacts that are closed there take part, with the velocities of that instant.
    for (int i = 0; i < nq; ++i) {
      v[i] = flight.v[i] + (flight.theta - 0.5) * h * flight.a[i];
      q[i] = x.q_k[static_cast<std::size_t>(i)] + flight.theta * h * flight.v[i];
    }
    SharedImpact impact(contacts);
    for (std::size_t i = 0; i < n; ++i) {
      if (!contacts.is_rigid(i) || !x.m.auxiliary[i].contact) continue;
      const double on_circle = (1.0 - kOnCircle) * contacts.law(i).clearance;
      if (!flight.closed[i] && i != first_touch && flight.d[i].norm() < on_circle) continue;
      impact.join(i, flight.closed[i], flight.d[i].normalized(), v, flight.a);
    }
    if (impact.approach() == 0.0) {  // a touch without an impact
      flight.closed[first_touch] = true;
      continue;
    }
    const bool ends = count + 1 == most;
    if (slow_impact_ && !ends && impact.rebounds(h)) return begin_slow_impact(k, flight);
    const Status found = impact.strike(x, t + flight.theta * h, t, q, ends, velocity_jump);
    if (found != Status::kOk) return x.fail(found);
    for (std::size_t i = 0; i < impact.count(); ++i) {
      const std::size_t index = impact.contact(i);
      if (flight.closed[index] && contacts.now[index].closed && !impact.rests(i)) {
        knock_open(index, flight);
      }
      flight.closed[index] = impact.rests(i);
    }
    apply_velocity_jump(flight, t, q, velocity_jump);
    for (int i = 0; i < nq; ++i) flight.v[i] += velocity_jump[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (contacts.is_rigid(i)) contacts.set_closed(i, flight.closed[i]);
  }
}

// A lasting contact that an impact opens transmits no force afterwards, but the kick counted its
// force until the middle of the step. The next step corrects this: theta - 1/2 of the impulse of a
// whole step.
void VerletStep::knock_open(std::size_t contact, Flight& flight) {
  double missed[kMaxCoordinates];
  const int nq = x.nq();
  std::fill_n(missed, nq, 0.0);
  StepContacts::Kept& kept = contacts.now[contact];
  contacts.push(contact, kept.normal, kept.friction, missed);
  for (int j = 0; j < nq; ++j) {
    deferred_[static_cast<std::size_t>(j)] += (flight.theta - 0.5) / x.kick * missed[j];
    flight.a[j] -= missed[j] / (x.kick * x.h);
  }
  kept.closed = false;
}

namespace {

// True if a continuous controller is on, whose command follows the state.
bool follows(const AuxiliaryBearing& at, double t) {
  return at.controller && at.sample_time == 0.0 && t >= at.control_on;
}
// The command at an impact with the coordinates q and the velocities v. t: s, for a law that
// depends on time, and to tell whether it is on.
Eigen::Vector2d command_at_impact(const Model& m, std::size_t bearing, double t, const double* q,
                                  const double* v, const Eigen::Vector2d& held_command) {
  return follows(m.auxiliary[bearing], t) ? control_command(m, t, q, v, bearing) : held_command;
}

}  // namespace

// velocity_jump: input, load of the impulses; output, the velocity jump w. x.after and deferred_
// get their shares of w. The kicks do not include how w changes velocity-dependent loads;
// deferred_ also gets what follows from that, -(theta - 1/2) h M^-1 (F(v + w) - F(v)), and
// work_correction_ the work that the mean of the step's velocities misses. t (s), q: where M and
// the loads are taken. A continuous controller measures w too.
void VerletStep::apply_velocity_jump(const Flight& flight, double t, const double* q,
                                     double* velocity_jump) {
  const Model& m = x.m;
  const int nq = m.nq();
  const std::size_t n = m.auxiliary.size();
  const double from_middle = (flight.theta - 0.5) * x.h;
  double v[kMaxCoordinates], before[kMaxCoordinates], missed[kMaxCoordinates];
  solve_mass(m, t, q, velocity_jump, velocity_jump);
  // All loads for the velocities v just before or just after the impact, and their power.
  const auto loads_at = [&](double* f) {
    std::array<Eigen::Vector2d, kMaxContacts> commands, rings;
    for (std::size_t i = 0; i < n; ++i) {
      commands[i] = command_at_impact(m, i, t, q, v, loads.command[i]);
      rings[i] = actuator_state(m, q, v, commands[i], i).force;
    }
    smooth_force(m, t, q, v, std::span(commands).first(n), f);
    return external_power(m, t, q, v, std::span(rings).first(n));
  };
  for (int i = 0; i < nq; ++i) v[i] = flight.v[i] + from_middle * flight.a[i];
  const double power = loads_at(before);
  for (int i = 0; i < nq; ++i) v[i] += velocity_jump[i];
  work_correction_ -= from_middle * (loads_at(missed) - power);
  for (int i = 0; i < nq; ++i) missed[i] = -from_middle * (missed[i] - before[i]);
  solve_mass(m, t, q, missed, missed);
  for (int i = 0; i < nq; ++i) {
    const auto at = static_cast<std::size_t>(i);
    x.after[at] += (1.0 - flight.theta) * velocity_jump[i];
    deferred_[at] += flight.theta * velocity_jump[i] + missed[i];
  }
  has_deferred_ = true;
}

// ------------------------------------------------------------------ impacts that take time
// Begins at a touch in step k, at the present end of the flight.
void VerletStep::begin_slow_impact(std::int64_t k, const Flight& flight) {
  const Model& m = x.m;
  const double h = x.h, to_touch = (flight.theta - 0.5) * h;
  const double t = x.origin + (static_cast<double>(k) + flight.theta) * h;
  double q[kMaxCoordinates], v[kMaxCoordinates];
  for (int i = 0; i < m.nq(); ++i) {
    q[i] = x.q_k[static_cast<std::size_t>(i)] + flight.theta * h * flight.v[i];
    v[i] = flight.v[i] + to_touch * flight.a[i];
  }
  FiniteImpact& impact = *slow_impact_;
  const Eigen::Vector2d command = command_at_impact(m, 0, t, q, v, loads.command[0]);
  const Status found = impact.begin(t, q, v, command, follows(m.first(), t));
  if (found != Status::kOk) return x.fail(found);
  // The kick went on to the middle of the step.
  work_correction_ += to_touch * impact.power_at_touch() + impact.external_work();
  impact_time_ = impact.end() - t;
  contacts.note_impact(impact.record());
  contacts.set_closed(0, false);
  follow_slow_impact(k);
}

// Advances to the end of step k, within the impact or in flight again.
void VerletStep::follow_slow_impact(std::int64_t k) {
  FiniteImpact& impact = *slow_impact_;
  const double h = x.h, end = x.time_of(k) + h;
  const int nq = x.nq();
  const double* q_k = x.q_k.data();
  double *after = x.after.data(), *deferred = deferred_.data();
  slow_impact_step_ = static_cast<double>(k) * h;
  if (end < impact.end()) {
    double to[kMaxCoordinates];
    impact.coordinates(end, to);
    for (int i = 0; i < nq; ++i) after[i] = (to[i] - q_k[i]) / h;
    return;
  }
  const double *q, *v, *a;
  const double left = end - impact.end(), from_middle = left - 0.5 * h;
  work_correction_ += from_middle * impact.power_at_end();
  const bool closes = impact.finish(q, v, a);
  for (int i = 0; i < nq; ++i) {
    const double flown = q[i] + left * (v[i] + 0.5 * left * a[i]);
    after[i] = (flown - q_k[i]) / h;
    deferred[i] = v[i] + from_middle * a[i] - after[i];
  }
  has_deferred_ = true;
  contacts.now[0].closed = closes;
}

}  // namespace rotorub
