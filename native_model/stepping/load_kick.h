// What all loads do in a fixed step: the velocity change that they give about one instant,
//
//   M(q) (v+ - v-) = h F(q, (v- + v+)/2, t) + J^T p,
//
// p the contact's impulse (one_contact.h, several_contacts.h), for one run (M = Model) or for many
// (M = LaneModel), of any size or of a known one (lane_model.h). With A = M + h/2 D
// (velocity_matrix.h) the linear part is solved at once, v+ = v- + A^-1 (h F(q, v-) + J^T p); what
// depends on velocities beyond that (free spin with gyroscopics or unbalance, a motor's curve,
// coils, integrators, a magnetic bearing at its limit) is iterated. What a model lacks costs
// nothing. All inline: whoever calls it chooses the instruction set.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "native_model/contact/most_contacts.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/dynamics/feedback_equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/lane_model.h"
#include "native_model/stepping/step_state.h"
#include "native_model/stepping/stepped_loads.h"
#include "native_model/stepping/velocity_matrix.h"
#include "native_model/system/sampled_feedback.h"

namespace rotorub {

// The commands of the actuators over a step (system/actuation.h): the force on each ring, or the
// currents of the two axes.
template <class T>
using StepCommands = std::array<equations::Pair<T>, kMaxContacts>;

// A load of one of the models depends on velocities beyond what the matrix has of it.
bool beyond_matrix(const std::vector<const Model*>& models);

template <class M>
class LoadKick {
 public:
  using T = typename M::Scalar;
  using State = StepState<M>;
  using Coordinates = typename State::Coordinates;
  static constexpr int kLanes = State::kLanes;

  // `models`: those of the lanes, all of the same structure; they must outlive this.
  LoadKick(const M& m, const std::vector<const Model*>& models, double h)
      : matrix_(models, h),
        loads_(models, h),
        f_(State::make(m)),
        change_(f_),
        seen_end_(f_),
        round_off_(f_) {
    const Model& first = *models.front();
    const Layout& layout = first.layout;
    commanded_ = first.first().moves() && first.first().commanded();
    iterates_ = beyond_matrix(models);
    magnetic_ = first.first().magnets.has_value();
    several_ = first.auxiliary.size() > 1;
    if (coupled()) eccentric_ = first.unbalances.size();
    for (int i = 0; iterates_ && i < layout.nq(); ++i) {
      const auto c = static_cast<std::size_t>(i);
      T held = m.stiffness[c];
      for (const auto& spring : m.springs) held += held_by(spring, layout.modes, i);
      const T sprung = lanes::all<T>(1e-15 * h) * held;
      round_off_[c] = sprung * sprung / m.mass[c];
      for (const auto& bearing : m.feedbacks) {
        if (!bearing.law.opposed || i >= 2 * layout.modes) continue;
        // Two magnets pull against each other, each with its force at the bias.
        const T pull = lanes::all<T>(2e-15 * h) * bearing.law.magnets.force_at_bias() *
                       mode_value(bearing.shape, layout.modes, i);
        magnets_round_off_ += pull * pull / m.mass[c];
      }
    }
  }

  StepCommands<T> command{};
  const T* applied = nullptr;            // nq further loads, or none
  std::span<const CommandJump> jumps{};  // of which `command` has the means: VerletStep::jumps

  // A force that comes without a controller acts from here on.
  void drive_first_ring() { commanded_ = true; }
  // M(phi) changes from step to step.
  bool coupled() const { return matrix_.coupled(); }
  // Controls of magnetic bearings are sampled at the instants of the loads.
  void sample(const std::vector<const Model*>& models) {
    samples_ = !models.front()->samplers.empty();
    if (samples_) {
      sampled_.assign(static_cast<std::size_t>(models.front()->layout.integrals), T{});
    }
  }
  // What depends on velocities beyond the linear part: improve() is to be called.
  bool iterates() const { return iterates_; }

  // All that outlives a step, as plain numbers.
  template <class Action>
  void for_each_kept(Action action) {
    for (std::size_t i = 0; i < eccentric_; ++i) {
      action(angles_.cosine[i]);
      action(angles_.sine[i]);
    }
    loads_.for_each_kept(action);
  }
  // Step numbers begin anew, or what is kept has been written.
  void forget(const M& m) {
    loads_.forget();
    if (coupled()) matrix_.couple_at(m, angles_);
  }

  // x.start -> x.free: the velocities that the loads of step k give, about the instant t and at
  // x.seen; begin (s): of the loads, they end at t + h/2. In the lanes where `later` is 1 without
  // what is to be iterated: settle() or an iteration with the contact is to come.
  ROTORUB_INLINE void free_velocity(State& x, std::int64_t k, double begin, double t,
                                    const T& later = T{}) {
    instant_ = t;
    const double end = t + 0.5 * x.h;
    loads_.advance(k, t, begin, end);
    if (samples_) find_samples(x, t, begin);
    weighed_free_velocity(x, lanes::all<T>(begin), lanes::all<T>(end), later);
  }
  // The same as if what is switched on between begin and end had held for the whole step.
  void free_velocity_of_part(State& x, const T& begin, const T& end) {
    const double kick = std::exchange(x.kick, 1.0);
    loads_.weigh(begin, end);
    weighed_free_velocity(x, begin, end, T{});
    x.kick = kick;
  }

  // x.free iterated in the lanes where `open` is 1.
  ROTORUB_INLINE void settle(State& x, const T& open) {
    begin_iteration(open);
    for (bool goes_on = lanes::any(open > T{}); goes_on;) goes_on = improve(x, x.free.data());
  }
  // In the lanes where `open` is 1.
  ROTORUB_INLINE void begin_iteration(const T& open) {
    rounds_ = 0;
    open_ = open;
  }
  // One round of the iteration: x.free from the forces at the middle of x.start and `end`, the
  // step's end with its contact. False once every lane has come to rest; one that has keeps its
  // bits.
  ROTORUB_INLINE bool improve(State& x, const T* end) {
    const auto& layout = x.m.layout;
    const int nq = layout.nq(), n = layout.modes, phi = layout.phi();
    const T h = lanes::all<T>(x.kick * x.h), half = lanes::all<T>(0.5), zero{};
    const T *start = x.start.data(), *mass = x.m.mass.data();
    T *f = f_.data(), *change = change_.data(), *free = x.free.data(), *seen = seen_end_.data();
    ROTORUB_APART for (int i = 0; i < nq; ++i) change[i] = half * (start[i] + end[i]);
    force(x, change, f);
    const T before = energy_of(nq, mass, [&](int i) { return end[i] - seen[i]; });
    ROTORUB_APART for (int i = 0; i < nq; ++i) {
      seen[i] = lanes::select(open_ > zero, end[i], seen[i]);
      change[i] = end[i] - start[i];
      f[i] = h * f[i] - mass[i] * change[i];
    }
    if (coupled()) {
      const T* b = matrix_.coupling();
      ROTORUB_APART for (int k = 0; k < 2 * n; ++k) f[k] -= b[k] * change[phi];
      f[phi] -= lanes::sum<T>(2 * n, [&](int k) { return b[k] * change[k]; });
    }
    solve(x, f);
    ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = start[i] + change[i] + f[i];
    const T moved = energy_of(nq, mass, [&](int i) { return f[i] - free[i]; });
    const T size = energy_of(nq, mass, [&](int i) { return change[i]; });
    ROTORUB_APART for (int i = 0; i < nq; ++i) {
      free[i] = lanes::select(open_ > zero, f[i], free[i]);
    }
    // To 1e-10 of the change: what is left is what the round moved times the rate of convergence,
    // moved / before.
    open_ = lanes::select(moved * moved > lanes::all<T>(1e-20) * size * before, open_, zero);
    if (!lanes::any(open_ > zero)) return false;
    open_ = lanes::select(moved > noise(x, end), open_, zero);
    if (++rounds_ < kMostRounds) return lanes::any(open_ > zero);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(open_, lane) > 0.0) x.fail(lane, Status::kStepTooLarge);
    }
    return false;
  }

  // f <- A^-1 f.
  ROTORUB_INLINE void solve(const State& x, T* f) { matrix_.solve(x.m.layout, f); }
  // f <- A^-1 f in the two parts of which the first does not change from step to step.
  ROTORUB_INLINE void solve_uncoupled(const State& x, T* f) {
    matrix_.solve_uncoupled(x.m.layout, f);
  }
  ROTORUB_INLINE void couple(const State& x, T* f) const { matrix_.couple(x.m.layout, f); }
  const VelocityMatrix<T>& matrix() const { return matrix_; }

  // J: of the forces of F at the middle of the step from x.start to `end`, but those that energy
  // holds (springs, and with a free spin unbalance, which is inertial), over h. One run.
  double external_work(const State& x, const double* end) {
    const M& m = x.m;
    const int nq = m.layout.mechanical();
    const double* q = x.seen.data();
    double *f = f_.data(), *v = change_.data();
    for (int i = 0; i < x.nq(); ++i) v[i] = 0.5 * (x.start[static_cast<std::size_t>(i)] + end[i]);
    force<Of::kWorking>(x, v, f);
    double work = -coupling_power(m, q, v);
    for (int i = 0; i < nq; ++i) work += f[i] * v[i];
    return x.h * work;
  }

 private:
  static constexpr int kMostRounds = 20;

  // J, twice the energy of velocities.
  template <class Velocity>
  static ROTORUB_INLINE T energy_of(int nq, const T* mass, Velocity v) {
    return lanes::sum<T>(nq, [&](int i) {
      const T rate = v(i);
      return mass[i] * rate * rate;
    });
  }
  // J, what a round moves by round-off: of the velocities or, of a rotor that rests under its load,
  // of the forces in balance.
  ROTORUB_INLINE T noise(const State& x, const T* end) const {
    const T *mass = x.m.mass.data(), *q = x.seen.data();
    T least = magnets_round_off_;
    for (int i = 0; i < x.nq(); ++i) {
      const T whole = mass[i] * end[i] * end[i];
      least += lanes::all<T>(1e-30) * whole + round_off_[static_cast<std::size_t>(i)] * q[i] * q[i];
    }
    return least;
  }

  // Of bending coordinate i.
  template <class Shape>
  static T mode_value(const Shape& shape, int n, int i) {
    return i < n ? shape.x.data()[i] : shape.y.data()[i - n];
  }
  // N/m, of coordinate i on a spring at a station: what a magnetic bearing's law takes back.
  template <class Spring>
  static T held_by(const Spring& spring, int n, int i) {
    if (i >= 2 * n) return T{};
    const T u = mode_value(spring.shape, n, i);
    return lanes::larger(T{}, i < n ? spring.stiffness.x() : spring.stiffness.y()) * u * u;
  }

  // With the loads as weighed last; begin..end: of all others that are switched.
  ROTORUB_INLINE void weighed_free_velocity(State& x, const T& begin, const T& end,
                                            const T& later) {
    const M& m = x.m;
    const int nq = x.nq();
    const T h = lanes::all<T>(x.h);
    const T* q = x.seen.data();
    const double t = instant_;
    if (!m.feedbacks.empty()) find_working(x, begin, end);
    if (loads_.synchronous()) loads_.turn_with(equations::spin_angle(m, t, q));
    if (!m.unbalances.empty()) {
      angles_.fill(m, t, q, begin, end);
      if (coupled()) matrix_.couple_at(m, angles_);
    }
    const T* start = x.start.data();
    T* free = x.free.data();
    // A local of a known size stays in registers.
    typename CoordinateArray<M>::Scratch scratch = f_;
    T* f = scratch.data();
    force(x, start, f);
    if (const T* step = matrix_.diagonal_step()) {
      ROTORUB_APART for (int i = 0; i < nq; ++i) free[i] = start[i] + step[i] * f[i];
    } else {
      ROTORUB_APART for (int i = 0; i < nq; ++i) f[i] = h * f[i];
      solve(x, f);
      ROTORUB_APART for (int i = 0; i < nq; ++i) free[i] = start[i] + f[i];
    }
    if (!iterates_) return;
    T* seen = seen_end_.data();
    ROTORUB_APART for (int i = 0; i < nq; ++i) seen[i] = start[i];
    settle(x, lanes::all<T>(1.0) - later);
  }

  // F(x.seen, v), all loads but the contacts'; those of [[force]] as advanced last. kWorking:
  // without what energy holds and what does no work (springs, gyroscopics, unbalance of a free
  // spin).
  enum class Of { kAll, kWorking };
  template <Of kOf = Of::kAll>
  ROTORUB_INLINE void force(const State& x, const T* v, T* f) {
    constexpr bool kAll = kOf == Of::kAll;
    const M& m = x.m;
    const T* q = x.seen.data();
    const T omega = equations::spin_speed(m, v);
    if constexpr (kAll) {
      equations::diagonal_force(m, q, v, f);
    } else {
      equations::damping_force(m, v, f);
    }
    equations::add_rotating_damping(m, q, v, omega, f);
    equations::add_dampers(m, v, f);
    equations::add_films(m, omega, q, v, f);
    if constexpr (kAll) equations::add_springs(m, q, f);
    equations::add_feedbacks(m, working_.data(), q, v, f);
    equations::add_supports(m, q, v, x.start.data(), x.kick * x.h, f);
    if constexpr (kAll) equations::add_gyroscopic(m, omega, v, f);
    loads_.add(m, f);
    if (sampled_now_) add_samples(m, f);
    if (!m.unbalances.empty() && (kAll || !coupled())) {
      equations::add_unbalance(m, angles_, omega, f);
    }
    equations::add_drive(m, instant_, q, v, f);
    if (applied) {
      for (int i = 0; i < x.nq(); ++i) f[i] += applied[i];
    }
    if (magnetic_ || several_) {
      add_actuators(x, v, f);
    } else if (commanded_ && m.layout.stator) {
      f[m.layout.ring()] += command[0].x;
      f[m.layout.ring() + 1] += command[0].y;
    }
  }

  // Of magnets, which drive the coils too, and of several rings: run by run.
  ROTORUB_SLOW void add_actuators(const State& x, const T* v, T* f) const;
  // What samplers remember jumps at t, in the middle of the kick, or where a first one begins: the
  // mean of the kick's velocities then has half of the jump, or all.
  ROTORUB_SLOW void find_samples(const State& x, double t, double begin);
  ROTORUB_SLOW void add_samples(const M& m, T* f) const;
  ROTORUB_SLOW void find_working(const State& x, const T& begin, const T& end);
  ROTORUB_SLOW void find_switched(const State& x, const T& begin, const T& end);

  bool iterates_ = false, magnetic_ = false, several_ = false, commanded_ = false;
  VelocityMatrix<T> matrix_;
  SteppedLoads<T> loads_;
  equations::DiscAngles<T> angles_{};
  std::size_t eccentric_ = 0;
  bool samples_ = false, sampled_now_ = false;
  lanes::Array<T> sampled_;  // N, what makes the jumps of the feedbacks' states
  struct KickCommand {       // on each axis
    equations::Pair<T> before{}, mean{}, after{};  // A, as the equations see them: the mean
    // What the commands before and after the sample do, each over its share of the working time,
    // less what the mean command does over all of it: N, and A/s of an amplifier.
    equations::Pair<T> force{}, rate{};
  };
  std::array<KickCommand, scene::kMaxMagneticBearings> commands_{};
  Coordinates f_, change_;
  Coordinates seen_end_;  // the step's end of which the last round had the forces
  // Of a deflection q_i the least energy that a step can tell is (1e-15 h k_i)^2/m_i q_i^2.
  Coordinates round_off_;
  T magnets_round_off_{};
  // Share of the step for which each magnetic bearing has not failed.
  std::array<T, scene::kMaxMagneticBearings> working_{};
  // Of the iteration: 1 in the lanes that go on.
  T open_{};
  int rounds_ = 0;
  double instant_ = 0.0;  // s, of the loads
};

}  // namespace rotorub
