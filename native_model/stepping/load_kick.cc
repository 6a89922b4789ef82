#include "native_model/stepping/load_kick.h"

#include <algorithm>
#include <cmath>

#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/feedback_equations.h"
#include "native_model/model/loads.h"

namespace rotorub {
namespace {

namespace eq = equations;

// True if a magnetic bearing can leave its linear law, whose damper is in the matrix.
bool feedback_switches(const StationFeedback& bearing) {
  const MagneticFeedback& law = bearing.law;
  const bool constant = std::ranges::all_of(
      bearing.works.all(), [](double t) { return t <= 0.0 || t >= scene::kNever; });
  if (law.damping() == 0.0 || (constant && !bearing.works.at(0.0))) return false;
  return std::isfinite(law.current_limit) || law.opposed || !constant;
}

// True if a load depends on velocities beyond the linear part in the matrix.
bool beyond_matrix(const Model& m) {
  const Layout& l = m.layout;
  const bool turns = l.spin && (!m.gyroscopic.absent() || !m.internal_xx.absent() ||
                                !m.internal_yy.absent() || m.coupled_mass());
  const bool curve = m.drive && m.drive->kind() != scene::DriveKind::kLinear &&
                     m.drive->kind() != scene::DriveKind::kFree;
  // Some bearings depend on the spin speed, which is free here.
  const bool follows = l.spin && std::ranges::any_of(m.films, [](const StationFilm& film) {
                         return film.law.follows();
                       });
  return turns || curve || follows || std::ranges::any_of(m.feedbacks, feedback_switches) ||
         l.feedback_states > 0 || l.coils > 0 || !m.supports.empty();
}

bool has_magnets(const Model& m) {
  return std::ranges::any_of(m.auxiliary,
                             [](const AuxiliaryBearing& at) { return at.magnets.has_value(); });
}

// The value of a mode shape for bending coordinate i.
double mode_value(const ModeShape& shape, int n, int i) {
  return i < n ? shape.x[i] : shape.y[i - n];
}

// N/m, stiffness of coordinate i by a spring at a station, which the law of a magnetic bearing
// subtracts again.
double stiffness_of(const StationSpring& spring, int n, int i) {
  if (i >= 2 * n) return 0.0;
  const double u = mode_value(spring.shape, n, i);
  return std::max(0.0, i < n ? spring.stiffness.x() : spring.stiffness.y()) * u * u;
}

// At a limit of its amplifier, the mean of a coil's rates under the commands before and after a
// jump differs from its rate under the mean command. This adds the difference.
void add_command_jump(const AuxiliaryBearing& at, const CommandJump& jump,
                      const Eigen::Vector2d& asked, const double* v, double* f) {
  constexpr double kRoundOff = 1e-9;
  if (jump.share == 0.0 || at.coil == kAbsent) return;
  const double share_before = jump.share, share_after = 1.0 - share_before;
  const Eigen::Vector2d mean = share_before * jump.before + share_after * jump.after;
  // Parts of the kick have only one of the two commands.
  if ((asked - mean).norm() > kRoundOff * (jump.after - jump.before).norm()) return;
  for (int i = 0; i < 2; ++i) {
    const auto load = [&](double command) {
      return at.magnets->coil.load(command, v[at.coil + i]);
    };
    f[at.coil + i] +=
        share_before * load(jump.before[i]) + share_after * load(jump.after[i]) - load(asked[i]);
  }
}

// J, twice the kinetic energy of the velocities v(i).
template <class Velocity>
double energy_of(int nq, const double* mass, Velocity v) {
  return sum(nq, [=](int i) {
    const double rate = v(i);
    return mass[i] * rate * rate;
  });
}

}  // namespace

LoadKick::LoadKick(const Model& m, double h)
    : m_(m),
      matrix_(m, h),
      loads_(m, h),
      needs_iteration_(beyond_matrix(m)),
      commanded_(m.auxiliary[0].moves() && m.auxiliary[0].commanded()),
      parts_(eq::has_linear_loads(m) || !m.gyroscopic.absent() || !m.supports.empty()),
      rings_by_actuators_(has_magnets(m) || m.auxiliary.size() > 1),
      commands_move_rings_alone_(m.supports.empty() && !has_magnets(m)),
      samples_(!m.samplers.empty()),
      sampled_(samples_ ? static_cast<std::size_t>(m.layout.feedback_states) : 0),
      f_(static_cast<std::size_t>(m.nq())),
      change_(f_),
      forces_(f_),
      last_end_(f_),
      round_off_(f_) {
  command.fill(Eigen::Vector2d(0.0, 0.0));
  if (needs_iteration_) find_round_off(h);
}

void LoadKick::find_round_off(double h) {
  const int n = m_.layout.modes;
  for (int i = 0; i < m_.nq(); ++i) {
    double stiffness = m_.stiffness[i];
    for (const StationSpring& spring : m_.springs) stiffness += stiffness_of(spring, n, i);
    const double sprung = 1e-15 * h * stiffness;
    round_off_[static_cast<std::size_t>(i)] = sprung * sprung / m_.mass[i];
    for (const StationFeedback& bearing : m_.feedbacks) {
      if (!bearing.law.opposed || i >= 2 * n) continue;
      // Two magnets pull against each other, each with its force at the bias current.
      const double pull =
          2e-15 * h * bearing.law.magnets.force_at_bias() * mode_value(bearing.shape, n, i);
      magnets_round_off_ += pull * pull / m_.mass[i];
    }
  }
}

// ------------------------------------------------------------------ the loads
// F(q_k, v): all loads except the contacts', with those of [[force]] as last advanced. kWorking
// omits forces that the stored energy contains and forces that do no work (springs, gyroscopics,
// unbalance of a free spin).
ROTORUB_INLINE void LoadKick::force(const StepState& state, const double* v, double* f,
                                    Forces which) {
  const double* q = state.q_k.data();
  const double omega = eq::spin_speed(m_, v);
  const bool all = which == Forces::kAll;
  if (all) {
    eq::diagonal_force(m_, q, v, f);
  } else {
    eq::damping_force(m_, v, f);
  }
  if (parts_) add_parts(state, v, omega, all, f);
  loads_.add(f);
  if (sampled_now_) add_samples(f);
  if (!m_.unbalances.empty() && (all || !coupled())) eq::add_unbalance(m_, angles_, omega, f);
  eq::add_drive(m_, instant_, q, v, f);
  if (applied) {
    for (int i = 0; i < state.nq(); ++i) f[i] += applied[i];
  }
  if (rings_by_actuators_) {
    add_ring_forces(state, v, f);
  } else if (commanded_ && m_.layout.stator) {
    f[m_.layout.ring()] += command[0].x();
    f[m_.layout.ring() + 1] += command[0].y();
  }
}

// The loads between the diagonal terms and [[force]], which only few models have.
void LoadKick::add_parts(const StepState& state, const double* v, double omega, bool all,
                         double* f) const {
  const double* q = state.q_k.data();
  eq::add_linear_loads(m_, omega, working_.data(), q, v, f, /*springs=*/all);
  if (!m_.supports.empty()) {
    add_ring_supports(m_, q, v, f);
    step_bristles(m_, v, state.v_start.data(), kick_ * state.h, f);
  }
  if (all) eq::add_gyroscopic(m_, omega, v, f);
}

void LoadKick::add_ring_forces(const StepState& state, const double* v, double* f) const {
  add_actuators(m_, state.q_k.data(), v, command, f);
  const std::size_t count = std::min(command_jumps.size(), m_.auxiliary.size());
  for (std::size_t i = 0; i < count; ++i)
    add_command_jump(m_.auxiliary[i], command_jumps[i], command[i], v, f);
}

// ------------------------------------------------------------------ the kick
void LoadKick::free_velocity(StepState& state, std::int64_t k, double begin, double t,
                             bool defer_iteration) {
  instant_ = t;
  const double end = t + 0.5 * state.h;
  loads_.advance(k, t, begin, end);
  if (samples_) find_samples(state, t, begin);
  weighed_free_velocity(state, begin, end, defer_iteration);
}

void LoadKick::free_velocity_of_part(StepState& state, double begin, double end) {
  loads_.weigh(begin, end);
  weighed_free_velocity(state, begin, end, false);
  forget_forces();
}

// Uses the loads as last weighed; begin..end: interval of all other switched loads.
void LoadKick::weighed_free_velocity(StepState& state, double begin, double end,
                                     bool defer_iteration) {
  const int nq = state.nq();
  const double h = state.h;
  const double *q = state.q_k.data(), *start = state.v_start.data();
  forget_forces();
  begin_iteration(1.0);
  double *free = state.v_free.data(), *after = state.v_end.data(), *f = f_.data();
  if (!m_.feedbacks.empty()) find_working(state, begin, end);
  if (loads_.synchronous()) loads_.turn_with(eq::spin_angle(m_, instant_, q));
  if (!m_.unbalances.empty()) {
    angles_.fill(m_, instant_, q, begin, end);
    if (coupled()) matrix_.couple_at(angles_);
  }
  force(state, start, f);
  if (const double* step = matrix_.diagonal_step()) {
    ROTORUB_APART for (int i = 0; i < nq; ++i) free[i] = after[i] = start[i] + step[i] * f[i];
  } else {
    ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = h * f[i];
    matrix_.solve(f);
    ROTORUB_APART for (int i = 0; i < nq; ++i) free[i] = after[i] = start[i] + f[i];
  }
  if (!needs_iteration_) return;
  std::copy_n(start, nq, last_end_.begin());
  if (!defer_iteration) iterate(state);
}

bool LoadKick::exchange_commands(StepState& state, const Commands& before) {
  if (!commands_move_rings_alone_) return false;
  forget_forces();
  std::copy(state.v_end.begin(), state.v_end.end(), state.v_free.begin());
  for (std::size_t i = 0; i < m_.auxiliary.size(); ++i) {
    if (!m_.auxiliary[i].moves()) continue;
    const int ring = m_.auxiliary[i].ring;
    const Eigen::Vector2d change = command[i] - before[i];
    for (int axis = 0; axis < 2; ++axis) {
      const auto at = static_cast<std::size_t>(ring + axis);
      state.v_free[at] += matrix_.step_of(ring + axis) * change[axis];
      state.v_end[at] = state.v_free[at];
    }
  }
  return true;
}

double LoadKick::external_work(const StepState& state, const double* mean) {
  const double *q = state.q_k.data(), *stiffness = m_.stiffness.data();
  const int mechanical = m_.layout.mechanical();
  if (forces_known_) {
    const double* all = forces_.data();
    const double power =
        sum(mechanical, [=](int i) { return (all[i] + stiffness[i] * q[i]) * mean[i]; });
    return state.h * (power + extra_power(m_, angles_, q, mean));
  }
  double* f = f_.data();
  force(state, mean, f, Forces::kWorking);
  const double power = sum(mechanical, [=](int i) { return f[i] * mean[i]; });
  return state.h * (power - coupling_power(m_, q, mean));
}

// ------------------------------------------------------------------ the iteration
void LoadKick::iterate(StepState& state) {
  while (iterate_once(state, state.v_free.data())) {
  }
  std::copy(state.v_free.begin(), state.v_free.end(), state.v_end.begin());
}

bool LoadKick::iterate_once(StepState& state, const double* end) {
  constexpr int kMostRounds = 20;
  const int nq = state.nq(), n = m_.layout.modes, phi = m_.layout.phi();
  const double h = kick_ * state.h;
  const double *start = state.v_start.data(), *mass = m_.mass.data();
  double *f = f_.data(), *change = change_.data(), *free = state.v_free.data(),
         *last = last_end_.data();
  ROTORUB_APART for (int i = 0; i < nq; ++i) change[i] = 0.5 * (start[i] + end[i]);
  force(state, change, f);
  std::copy_n(f, nq, forces_.begin());
  forces_known_ = true;
  const double before = energy_of(nq, mass, [=](int i) { return end[i] - last[i]; });
  ROTORUB_APART for (int i = 0; i < nq; ++i) {
    last[i] = end[i];
    change[i] = end[i] - start[i];
    f[i] = h * f[i] - mass[i] * change[i];
  }
  if (coupled()) {
    const double* b = matrix_.coupling();
    ROTORUB_APART for (int k = 0; k < 2 * n; ++k) f[k] -= b[k] * change[phi];
    f[phi] -= sum(2 * n, [=](int k) { return b[k] * change[k]; });
  }
  matrix_.solve(f);
  ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = start[i] + change[i] + f[i];
  const double moved = energy_of(nq, mass, [=](int i) { return f[i] - free[i]; });
  const double size = energy_of(nq, mass, [=](int i) { return change[i]; });
  ROTORUB_APART for (int i = 0; i < nq; ++i) free[i] = f[i];
  // Iterates to 1e-10 of the change. The remaining error is the last change times the rate of
  // convergence, moved / before.
  const bool goes_on = moved * moved > 1e-20 * size * before && moved > noise(state, end);
  if (!goes_on || ++rounds_ < kMostRounds) return goes_on;
  state.fail(Status::kStepTooLarge);
  return false;
}

// J, twice the energy that round-off can move in a round: round-off of the velocities or, for a
// rotor at rest under its load, of the balanced forces.
double LoadKick::noise(const StepState& state, const double* end) const {
  const double *mass = m_.mass.data(), *q = state.q_k.data();
  double least = magnets_round_off_;
  for (int i = 0; i < state.nq(); ++i) {
    const double whole = mass[i] * end[i] * end[i];
    least += 1e-30 * whole + round_off_[static_cast<std::size_t>(i)] * q[i] * q[i];
  }
  return least;
}

}  // namespace rotorub
