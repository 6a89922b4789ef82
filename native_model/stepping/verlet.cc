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

// Only with a single contact.
bool impacts_take_time(const Model& m) {
  const auto& contact = m.auxiliary[0].contact;
  return m.auxiliary.size() == 1 && contact && contact->impact_time() > 0.0;
}

}  // namespace

VerletStep::VerletStep(const Model& model, double h)
    : state(model, h),
      loads(model, h),
      contacts(state, loads),
      deferred_(state.q),
      mean_v_(state.q),
      last_v_(state.q),
      switches_(std::isfinite(next_switch(model, 0.0, std::numeric_limits<double>::infinity()))),
      mean_v_end_(state.q),
      part_sum_(state.q) {
  if (impacts_take_time(model)) finite_impact_.emplace(model);
}

// ------------------------------------------------------------------ the step
void VerletStep::step(std::int64_t k) {
  state.kick_length = first_ ? 0.5 : 1.0;
  work_correction_ = impact_time_ = 0.0;
  has_mean_ = false;
  contacts.clear_results();
  const bool defer_iteration = iterates_with_contact();
  state.begin(deferred_or_null());
  const bool kicked = precomputed_at_ == k && loads.exchange_commands(state, precomputed_commands_);
  precomputed_at_ = kNoStep;
  if (!kicked) kick(k, defer_iteration);
  if (has_deferred_) std::fill(deferred_.begin(), deferred_.end(), 0.0);
  has_deferred_ = false;
  in_finite_impact_ = finite_impact_ && finite_impact_->active();
  if (in_finite_impact_) {
    follow_finite_impact(k);
  } else if (contacts.any()) {
    const double end = state.time_of(k) + 0.5 * state.h,
                 begin = was_first() ? state.time_of(k) : end - state.h;
    const double share = share_before_jump(begin, end);
    if (share > 0.0) states_before_ = contacts.states;
    contacts.apply_lasting(state, defer_iteration);
    if (share > 0.0) take_in_two_parts(share, begin, end);
    if (contacts.any_flight_ends(state)) solve_impacts(k);
  }
  if (has_command_jumps_) forget_command_jumps();
  first_ = false;
  state.drift();
}

// True if the free velocity is iterated together with the contacts, and not before.
bool VerletStep::iterates_with_contact() const {
  return loads.needs_iteration() && !first_ && !finite_impact_ &&
         contacts.can_iterate_with_lasting();
}

// Computes v_free of step k, and v_end equal to it. defer_iteration: see LoadKick::free_velocity().
void VerletStep::kick(std::int64_t k, bool defer_iteration) {
  const double t = state.time_of(k);
  loads.free_velocity(state, k, first_ ? t : t - 0.5 * state.h, t, defer_iteration);
  if (first_) halve_kick();
}

// A first step has only half of the kick.
void VerletStep::halve_kick() {
  for (std::size_t i = 0; i < state.v_free.size(); ++i)
    state.v_free[i] = 0.5 * (state.v_start[i] + state.v_free[i]);
  state.v_end = state.v_free;
  loads.forget_forces();
}

void VerletStep::velocity_now(std::int64_t k, double* v) {
  if (first_) {
    std::copy(state.v.begin(), state.v.end(), v);
    return;
  }
  state.begin_precomputing(deferred_or_null());
  // The iteration may be omitted in lasting contact, because the contact force of the previous step
  // already causes an error of order h^2.
  kick(k, iterates_with_contact());
  precomputed_at_ = k;
  precomputed_commands_ = loads.command;
  if (finite_impact_ && finite_impact_->active())
    return finite_impact_->velocities(state.time_of(k), v);
  if (contacts.any()) contacts.add_last_forces(state);
  for (std::size_t i = 0; i < state.v_free.size(); ++i)
    v[i] = 0.5 * (state.v_start[i] + state.v_free[i]);
}

void VerletStep::restart() {
  first_ = true;
  has_deferred_ = false;
  discard_precomputed_kick();
  std::fill(deferred_.begin(), deferred_.end(), 0.0);
  loads.forget();
  if (finite_impact_) finite_impact_->cancel();
  contacts.restart(state);
}

const double* VerletStep::mean_velocity() {
  if (has_mean_) return mean_v_.data();
  has_mean_ = true;
  const double *start = state.v_start.data(), *end = contacts.end_without_impacts(state);
  double* mean = mean_v_.data();
  const int nq = state.nq();
  ROTORUB_APART for (int i = 0; i < nq; ++i) mean[i] = 0.5 * (start[i] + end[i]);
  return mean;
}

const double* VerletStep::last_velocity() {
  const int sampled = state.model.sampled_states(), after_sampled = state.model.layout.coil();
  const bool is_mean = !was_first() && !in_finite_impact_ && sampled == after_sampled;
  if (is_mean) return mean_velocity();
  last_v_ = state.v_start;
  if (!was_first()) {
    const double* mean = mean_velocity();
    std::copy(mean, mean + sampled, last_v_.begin());
    std::copy(mean + after_sampled, mean + state.nq(), last_v_.begin() + after_sampled);
  }
  if (in_finite_impact_)
    finite_impact_->velocities(state.origin + finite_impact_step_, last_v_.data());
  return last_v_.data();
}

double VerletStep::external_work() {
  if (in_finite_impact_) return work_correction_;  // begin_finite_impact() has counted the work
  return state.kick_length * loads.external_work(state, mean_velocity()) + work_correction_;
}

// ------------------------------------------------------------------ jumps of loads and commands
// In flight only the mean load over the step matters. In lasting contact the mean load is not
// enough, because contact may end, or friction reverse, at the instant of the jump. Therefore the
// step is solved twice, with the loads before the jump and with the loads after it, each held
// throughout. The velocities of the step are the weighted sum of both solutions,
//
//   v_{k+1/2} = s v_before + (1 - s) v_after,   (N, T) likewise,
//
// with the fraction s of the step before the jump. This keeps order 2. If contact goes on unchanged
// in both parts, the mean load gives the same result, and the step ends on the circle.
//
// announce_command_jump() stores the jump of a command. take_in_two_parts() computes the two parts
// after the step was taken with its mean loads.
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
// contact; 0: nothing jumps, or it jumps at an end of the kick. If commands jump at several
// instants, the first one counts; a switched load counts only if no command jumps.
double VerletStep::share_before_jump(double begin, double end) {
  if (!(switches_ || has_command_jumps_) || !contacts.any_rigid_lasts()) return 0.0;
  constexpr double kNone = 2.0;
  double share = kNone;
  for (const CommandJump& command : command_jumps_) {
    if (has_command_jumps_ && command.share > 0.0) share = std::min(share, command.share);
  }
  if (share == kNone) {
    if (!(begin >= switch_from_ && begin < switch_at_)) {
      switch_from_ = begin;
      switch_at_ = next_switch(state.model, begin, std::numeric_limits<double>::infinity());
    }
    if (switch_at_ >= end) return 0.0;
    share = (switch_at_ - begin) / (end - begin);
  }
  return share > kLeastPart && share < 1.0 - kLeastPart ? share : 0.0;
}

void VerletStep::take_in_two_parts(double share, double begin, double end) {
  const double rest = 1.0 - share, jump = begin + share * (end - begin);
  const LoadKick::Commands mean_commands = loads.command;
  const StepContacts::States mean = contacts.states;
  mean_v_end_ = state.v_end;
  set_command_of_part(true, share);
  take_part(states_before_, begin, jump);
  const StepContacts::States first = contacts.states;
  for (std::size_t i = 0; i < part_sum_.size(); ++i) part_sum_[i] = share * state.v_end[i];
  set_command_of_part(false, share);
  take_part(contacts.second_part_start(states_before_, first), jump, end);
  for (std::size_t i = 0; i < part_sum_.size(); ++i) part_sum_[i] += rest * state.v_end[i];

  // Restores the loads of the whole step, from which the works follow, and v_free.
  loads.command = mean_commands;
  loads.free_velocity_of_part(state, begin, end);
  if (was_first()) halve_kick();
  if (contacts.lasts_unchanged(states_before_, mean) &&
      contacts.lasts_unchanged(states_before_, first) &&
      contacts.lasts_unchanged(states_before_, contacts.states)) {
    contacts.restore_whole_step(mean);
    state.v_end = mean_v_end_;
  } else {
    contacts.join_parts(share, rest, first, state.kick_length);
    state.v_end = part_sum_;
  }
}

// Computes v_end and the contacts of the whole step as if the loads from `begin` to `end` held
// throughout. at_start: states of the contacts before this part.
void VerletStep::take_part(const StepContacts::States& at_start, double begin, double end) {
  loads.free_velocity_of_part(state, begin, end);
  if (was_first()) halve_kick();
  contacts.states = at_start;
  contacts.apply_lasting(state);
}

// Sets the commands of the part before or after the jump. A command that jumps at a later instant
// keeps its mean.
void VerletStep::set_command_of_part(bool before_jump, double share) {
  for (std::size_t i = 0; i < command_jumps_.size(); ++i) {
    if (command_jumps_[i].share == 0.0 || command_jumps_[i].share - share > kLeastPart) continue;
    loads.command[i] = before_jump ? command_jumps_[i].before : command_jumps_[i].after;
  }
}

// ------------------------------------------------------------------ impacts
// The motion through a step from one impact to the next. With constant accelerations a, the
// velocities at the fraction theta of the step are v + (theta - 1/2) h a, and the coordinates
// follow the straight path with v.
struct VerletStep::Flight {
  double theta = 0.0;                             // fraction of the step that is over
  std::array<Eigen::Vector2d, kMaxContacts> d{};  // m, separation of each contact at theta
  std::array<bool, kMaxContacts> closed{};
  double v[kMaxCoordinates];  // velocities at the middle of the step
  double a[kMaxCoordinates];  // accelerations by the loads and the lasting contacts
};

// Advances the flight to the instant at which the first path leaves its circle, and returns that
// contact; if no path leaves, the result is empty and the flight stays where it is. A contact whose
// path never comes inside has no flight and counts as closed.
std::optional<std::size_t> VerletStep::advance_to_touch(Flight& flight) const {
  const std::size_t n = contacts.count();
  double share = 2.0;  // of the rest of the step; more than any exit
  std::optional<std::size_t> first;
  std::array<Eigen::Vector2d, kMaxContacts> path;
  path.fill(Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < n; ++i) {
    if (!contacts.is_rigid(i) || !state.model.auxiliary[i].contact) continue;
    const double clearance = contacts.parameters(i).clearance;
    path[i] = (1.0 - flight.theta) * state.h * contacts.rates(i, flight.v).head<2>();
    if (flight.closed[i] || (flight.d[i] + path[i]).norm() <= clearance) continue;
    const std::optional<double> exit = circle_exit(flight.d[i], path[i], clearance);
    if (!exit) {
      flight.closed[i] = flight.d[i].norm() >= clearance;
    } else if (*exit < share) {
      share = *exit;
      first = i;
    }
  }
  if (!first) return first;
  for (std::size_t i = 0; i < n; ++i) flight.d[i] += share * path[i];
  flight.theta += share * (1.0 - flight.theta);
  return first;
}

// Solves the impacts of the step; each one includes all contacts that are closed at its instant.
void VerletStep::solve_impacts(std::int64_t k) {
  const std::size_t n = contacts.count();
  const int nq = state.nq();
  contacts.keep_end_without_impacts(state);
  const double t = state.time_of(k), h = state.h;
  Flight flight;
  for (int i = 0; i < nq; ++i) {
    const auto at = static_cast<std::size_t>(i);
    flight.v[i] = state.v_end[at];
    flight.a[i] = (state.v_end[at] - state.v_start[at]) / (state.kick_length * h);
  }
  for (std::size_t i = 0; i < n; ++i) {
    flight.d[i] = contacts.separation(i);
    flight.closed[i] = contacts.is_rigid(i) && contacts.states[i].closed;
  }
  double v[kMaxCoordinates], q[kMaxCoordinates], impulses[kMaxCoordinates];
  const int most = kMostImpacts * static_cast<int>(n);
  for (int count = 0; count < most; ++count) {
    const std::optional<std::size_t> touch = advance_to_touch(flight);
    if (!touch) break;
    // All contacts that are closed there take part, with the velocities of that instant.
    for (int i = 0; i < nq; ++i) {
      v[i] = flight.v[i] + (flight.theta - 0.5) * h * flight.a[i];
      q[i] = state.q_k[static_cast<std::size_t>(i)] + flight.theta * h * flight.v[i];
    }
    SharedImpact impact(contacts);
    for (std::size_t i = 0; i < n; ++i) {
      if (!contacts.is_rigid(i) || !state.model.auxiliary[i].contact) continue;
      const double on_circle = (1.0 - kOnCircle) * contacts.parameters(i).clearance;
      if (!flight.closed[i] && i != *touch && flight.d[i].norm() < on_circle) continue;
      impact.add(i, flight.closed[i], flight.d[i].normalized(), v, flight.a);
    }
    if (impact.approach() == 0.0) {  // a touch without an impact
      flight.closed[*touch] = true;
      continue;
    }
    const bool is_last = count + 1 == most;
    if (finite_impact_ && !is_last && impact.rebounds(h)) return begin_finite_impact(k, flight);
    const Status found = impact.solve(state, t + flight.theta * h, t, q, is_last, impulses);
    if (found != Status::kOk) return state.fail(found);
    for (const SharedImpact::Member& member : impact.members()) {
      const std::size_t i = member.contact;
      if (flight.closed[i] && contacts.states[i].closed && !member.stays_closed) {
        open_by_impact(i, flight);
      }
      flight.closed[i] = member.stays_closed;
    }
    apply_impulses(flight, t, q, impulses);
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (contacts.is_rigid(i)) contacts.set_closed(i, flight.closed[i]);
  }
}

// A lasting contact that an impact opens transmits no force afterwards, but the kick contains its
// force until the middle of the step. The next step corrects this by the share theta - 1/2 of the
// impulse of a whole step.
void VerletStep::open_by_impact(std::size_t contact, Flight& flight) {
  double missed[kMaxCoordinates];
  const int nq = state.nq();
  std::fill_n(missed, nq, 0.0);
  StepContacts::State& kept = contacts.states[contact];
  contacts.add_velocity_change(contact, kept.normal, kept.friction, missed);
  for (int j = 0; j < nq; ++j) {
    deferred_[static_cast<std::size_t>(j)] += (flight.theta - 0.5) / state.kick_length * missed[j];
    flight.a[j] -= missed[j] / (state.kick_length * state.h);
  }
  kept.closed = false;
}

namespace {

// True if a continuous controller is on; its command follows the state.
bool is_controlled_continuously(const AuxiliaryBearing& bearing, double t) {
  return bearing.controller && bearing.sample_time == 0.0 && t >= bearing.control_on;
}
// The command at an impact with the coordinates q and the velocities v. t: s, for a law that
// depends on time, and to tell whether it is on.
Eigen::Vector2d command_at_impact(const Model& m, std::size_t bearing, double t, const double* q,
                                  const double* v, const Eigen::Vector2d& held_command) {
  return is_controlled_continuously(m.auxiliary[bearing], t) ? control_command(m, t, q, v, bearing)
                                                             : held_command;
}

}  // namespace

// Applies the impulses of an impact (on the coordinates, N s): the flight gets the velocity jump
// w = M^-1 impulses, v_end and deferred_ their shares of it. The kicks do not include how w changes
// velocity-dependent loads, so deferred_ also gets -(theta - 1/2) h M^-1 (F(v + w) - F(v)), and
// work_correction_ the work that the mean of the step's velocities misses. M and the loads are
// taken at t (s) and q. A continuous controller measures w too.
void VerletStep::apply_impulses(Flight& flight, double t, const double* q, const double* impulses) {
  const Model& m = state.model;
  const int nq = m.nq();
  const std::size_t n = m.auxiliary.size();
  const double from_middle = (flight.theta - 0.5) * state.h;
  double v[kMaxCoordinates], before[kMaxCoordinates], missed[kMaxCoordinates];
  double velocity_jump[kMaxCoordinates];
  solve_mass(m, t, q, impulses, velocity_jump);
  // Writes all loads for the present v, just before or just after the impact, and returns their
  // power, W.
  const auto find_loads = [&](double* f) {
    std::array<Eigen::Vector2d, kMaxContacts> commands, rings;
    for (std::size_t i = 0; i < n; ++i) {
      commands[i] = command_at_impact(m, i, t, q, v, loads.command[i]);
      rings[i] = actuator_state(m, q, v, commands[i], i).force;
    }
    smooth_force(m, t, q, v, std::span(commands).first(n), f);
    return external_power(m, t, q, v, std::span(rings).first(n));
  };
  for (int i = 0; i < nq; ++i) v[i] = flight.v[i] + from_middle * flight.a[i];
  const double power = find_loads(before);
  for (int i = 0; i < nq; ++i) v[i] += velocity_jump[i];
  work_correction_ -= from_middle * (find_loads(missed) - power);
  for (int i = 0; i < nq; ++i) missed[i] = -from_middle * (missed[i] - before[i]);
  solve_mass(m, t, q, missed, missed);
  for (int i = 0; i < nq; ++i) {
    const auto at = static_cast<std::size_t>(i);
    state.v_end[at] += (1.0 - flight.theta) * velocity_jump[i];
    deferred_[at] += flight.theta * velocity_jump[i] + missed[i];
    flight.v[i] += velocity_jump[i];
  }
  has_deferred_ = true;
}

// ------------------------------------------------------------------ impacts that take time
// Begins at a touch in step k, at the present end of the flight.
void VerletStep::begin_finite_impact(std::int64_t k, const Flight& flight) {
  const Model& m = state.model;
  const double h = state.h, to_touch = (flight.theta - 0.5) * h;
  const double t = state.origin + (static_cast<double>(k) + flight.theta) * h;
  double q[kMaxCoordinates], v[kMaxCoordinates];
  for (int i = 0; i < m.nq(); ++i) {
    q[i] = state.q_k[static_cast<std::size_t>(i)] + flight.theta * h * flight.v[i];
    v[i] = flight.v[i] + to_touch * flight.a[i];
  }
  FiniteImpact& impact = *finite_impact_;
  const Eigen::Vector2d command = command_at_impact(m, 0, t, q, v, loads.command[0]);
  const Status found =
      impact.begin(t, q, v, command, is_controlled_continuously(m.auxiliary[0], t));
  if (found != Status::kOk) return state.fail(found);
  // The kick counts the work of the loads until the middle of the step, not until the touch.
  work_correction_ += to_touch * impact.power_at_touch() + impact.external_work();
  impact_time_ = impact.end() - t;
  contacts.add_impact(impact.record());
  contacts.set_closed(0, false);
  follow_finite_impact(k);
}

// Advances to the end of step k, within the impact or in flight again.
void VerletStep::follow_finite_impact(std::int64_t k) {
  FiniteImpact& impact = *finite_impact_;
  const double h = state.h, end = state.time_of(k) + h;
  const int nq = state.nq();
  const double* q_k = state.q_k.data();
  double *after = state.v_end.data(), *deferred = deferred_.data();
  finite_impact_step_ = static_cast<double>(k) * h;
  if (end < impact.end()) {
    double to[kMaxCoordinates];
    impact.coordinates(end, to);
    for (int i = 0; i < nq; ++i) after[i] = (to[i] - q_k[i]) / h;
    return;
  }
  const double left = end - impact.end(), from_middle = left - 0.5 * h;
  work_correction_ += from_middle * impact.power_at_end();
  const auto [q, v, a, lasts] = impact.finish();
  for (int i = 0; i < nq; ++i) {
    const double flown = q[i] + left * (v[i] + 0.5 * left * a[i]);
    after[i] = (flown - q_k[i]) / h;
    deferred[i] = v[i] + from_middle * a[i] - after[i];
  }
  has_deferred_ = true;
  contacts.states[0].closed = lasts;
}

}  // namespace rotorub
