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

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "native_model/contact/most_contacts.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/dynamics/equations.h"
#include "native_model/stepping/lane_model.h"
#include "native_model/stepping/step_state.h"
#include "native_model/stepping/stepped_loads.h"
#include "native_model/stepping/velocity_matrix.h"

namespace rotorub {

// The commands of the actuators over a step (system/actuation.h): the force on each ring, or the
// currents of the two axes.
template <class T>
using StepCommands = std::array<equations::Pair<T>, kMaxContacts>;

// f += what the actuators do under `commands`, two numbers of each auxiliary bearing. One run.
void add_actuators_of_run(const Model& m, const double* q, const double* v, const double* commands,
                          double* f);
// What a magnetic bearing does leaves its linear law, of which the damper is in the matrix.
bool feedback_switches(const Model& m);

template <class M>
class LoadKick {
 public:
  using T = typename M::Scalar;
  using State = StepState<M>;
  using Coordinates = typename State::Coordinates;
  static constexpr int kLanes = State::kLanes;

  // `models`: those of the lanes, all of the same structure; they must outlive this.
  LoadKick(const M& m, const std::vector<const Model*>& models, double h)
      : matrix_(models, h), loads_(models, h), f_(State::make(m)), change_(f_), round_off_(f_) {
    const Model& first = *models.front();
    const Layout& layout = first.layout;
    coupled_ = first.coupled_mass();
    commanded_ = first.first().moves() && first.first().commanded();
    const bool turns = layout.spin && (!first.gyroscopic.absent() || !first.internal_xx.absent() ||
                                       !first.internal_yy.absent() || coupled_);
    const bool curve = first.drive && first.drive->kind() != scene::DriveKind::kLinear &&
                       first.drive->kind() != scene::DriveKind::kFree;
    bool switches = false;
    for (const Model* model : models) switches = switches || feedback_switches(*model);
    bool follows = false;  // bearings the spin, where that is free
    for (const auto& film : first.films) follows = follows || (layout.spin && film.law.follows());
    iterates_ = turns || curve || follows || switches || layout.integrals > 0 || layout.coils > 0 ||
                !first.supports.empty();
    magnetic_ = first.first().magnets.has_value();
    several_ = first.auxiliary.size() > 1;
    for (int i = 0; iterates_ && i < layout.nq(); ++i) {
      const auto c = static_cast<std::size_t>(i);
      const T sprung = lanes::all<T>(1e-15 * h) * m.stiffness[c];
      round_off_[c] = sprung * sprung / m.mass[c];
    }
    if (!coupled_) return;
    bx_.assign(static_cast<std::size_t>(layout.modes), T{});
    by_ = bx_;
  }

  StepCommands<T> command{};
  const T* applied = nullptr;  // nq further loads, or none

  // A force that comes without a controller acts from here on.
  void drive_first_ring() { commanded_ = true; }
  // M(phi) changes from step to step.
  bool coupled() const { return coupled_; }
  // What depends on velocities beyond the linear part: improve() is to be called.
  bool iterates() const { return iterates_; }

  // All that outlives a step, as plain numbers.
  template <class Action>
  void for_each_kept(Action action) {
    for (T& value : bx_) action(value);
    for (T& value : by_) action(value);
    loads_.for_each_kept(action);
  }
  // Step numbers begin anew.
  void forget() { loads_.forget(); }

  // x.start -> x.free: the velocities that the loads of step k give, about the instant t and at
  // x.seen; begin (s): of the loads, they end at t + h/2.
  ROTORUB_INLINE void free_velocity(State& x, std::int64_t k, double begin, double t) {
    instant_ = t;
    const double end = t + 0.5 * x.h;
    loads_.advance(k, t, begin, end);
    weighed_free_velocity(x, lanes::all<T>(begin), lanes::all<T>(end));
  }
  // The same as if what is switched on between begin and end had held for the whole step.
  void free_velocity_of_part(State& x, const T& begin, const T& end) {
    const double kick = std::exchange(x.kick, 1.0);
    loads_.weigh(begin, end);
    weighed_free_velocity(x, begin, end);
    x.kick = kick;
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
    T *f = f_.data(), *change = change_.data(), *free = x.free.data();
    for (int i = 0; i < nq; ++i) change[i] = half * (start[i] + end[i]);
    force(x, change, f);
    for (int i = 0; i < nq; ++i) {
      change[i] = end[i] - start[i];
      f[i] = h * f[i] - mass[i] * change[i];
    }
    if (coupled_) {
      const T *bx = bx_.data(), *by = by_.data();
      T sum{};
      for (int k = 0; k < n; ++k) {
        f[k] -= bx[k] * change[phi];
        f[n + k] -= by[k] * change[phi];
        sum += bx[k] * change[k] + by[k] * change[n + k];
      }
      f[phi] -= sum;
    }
    solve(x, f);
    T moved{}, size{}, whole{};
    for (int i = 0; i < nq; ++i) {
      const T better = start[i] + change[i] + f[i], by = better - free[i];
      moved += mass[i] * by * by;
      size += mass[i] * change[i] * change[i];
      whole += mass[i] * end[i] * end[i];
      free[i] = lanes::select(open_ > zero, better, free[i]);
    }
    // To 1e-10 of the change, as the next round would gain as much again; or to round-off, of the
    // velocities or, of a rotor that rests under its load, of the forces in balance.
    const T enough = lanes::all<T>(1e-20) * size + lanes::all<T>(1e-30) * whole + balanced_;
    open_ = lanes::select(moved > enough, open_, zero);
    if (++rounds_ < kMostRounds) return lanes::any(open_ > zero);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(open_, lane) > 0.0) x.fail(lane, Status::kStepTooLarge);
    }
    return false;
  }

  // f <- A^-1 f.
  ROTORUB_INLINE void solve(const State& x, T* f) {
    matrix_.solve(x.m.layout, coupled_ ? bx_.data() : nullptr, by_.data(), f);
  }

  // J: of the forces of F at the middle of the step from x.start to `end`, but those that energy
  // holds (springs, and with a free spin unbalance, which is inertial), over h. One run.
  double external_work(const State& x, const double* end) {
    const M& m = x.m;
    const int nq = m.layout.mechanical();
    const double* q = x.seen.data();
    double *f = f_.data(), *v = change_.data();
    for (int i = 0; i < x.nq(); ++i) v[i] = 0.5 * (x.start[static_cast<std::size_t>(i)] + end[i]);
    force(x, v, f);
    double work = 0.0;
    const double* stiffness = m.stiffness.data();
    for (int i = 0; i < nq; ++i) work += (f[i] + stiffness[i] * q[i]) * v[i];
    work -= coupling_power(m, q, v);
    if (m.springs.empty() && !coupled_) return x.h * work;
    for (int i = 0; i < x.nq(); ++i) f[i] = 0.0;
    equations::add_springs(m, q, f);
    if (coupled_) equations::add_unbalance(m, angles_, equations::spin_speed(m, v), f);
    for (int i = 0; i < nq; ++i) work -= f[i] * v[i];
    return x.h * work;
  }

 private:
  static constexpr int kMostRounds = 20;

  // With the loads as weighed last; begin..end: of all others that are switched.
  ROTORUB_INLINE void weighed_free_velocity(State& x, const T& begin, const T& end) {
    const M& m = x.m;
    const int nq = x.nq();
    const T h = lanes::all<T>(x.h);
    const T* q = x.seen.data();
    const double t = instant_;
    if (!m.feedbacks.empty()) find_working(m, begin, end);
    if (loads_.synchronous()) loads_.turn_with(equations::spin_angle(m, t, q));
    if (!m.unbalances.empty()) {
      angles_.fill(m, t, q, begin, end);
      if (coupled_) equations::spin_coupling(m, angles_, bx_.data(), by_.data());
    }
    const T* start = x.start.data();
    T* free = x.free.data();
    // A local of a known size stays in registers.
    typename CoordinateArray<M>::Scratch scratch = f_;
    T* f = scratch.data();
    force(x, start, f);
    if (const T* step = coupled_ ? nullptr : matrix_.diagonal_step()) {
      for (int i = 0; i < nq; ++i) free[i] = start[i] + step[i] * f[i];
    } else {
      for (int i = 0; i < nq; ++i) f[i] = h * f[i];
      solve(x, f);
      for (int i = 0; i < nq; ++i) free[i] = start[i] + f[i];
    }
    if (!iterates_) return;
    balanced_ = T{};
    for (int i = 0; i < nq; ++i) balanced_ += round_off_[static_cast<std::size_t>(i)] * q[i] * q[i];
    begin_iteration(lanes::all<T>(1.0));
    while (improve(x, free)) {
    }
  }

  // F(x.seen, v), all loads but the contacts'; those of [[force]] as advanced last.
  ROTORUB_INLINE void force(const State& x, const T* v, T* f) {
    const M& m = x.m;
    const T* q = x.seen.data();
    const T omega = equations::spin_speed(m, v);
    equations::diagonal_force(m, q, v, f);
    equations::add_rotating_damping(m, q, v, omega, f);
    equations::add_dampers(m, v, f);
    equations::add_films(m, omega, q, v, f);
    equations::add_springs(m, q, f);
    equations::add_feedbacks(m, working_.data(), q, v, f);
    add_supports(x, v, f);
    equations::add_gyroscopic(m, omega, v, f);
    loads_.add(m, f);
    if (!m.unbalances.empty()) equations::add_unbalance(m, angles_, omega, f);
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

  // What dry friction's bristles do within the step is known exactly: they may be quick.
  ROTORUB_INLINE void add_supports([[maybe_unused]] const State& x, [[maybe_unused]] const T* v,
                                   [[maybe_unused]] T* f) const {
    if constexpr (std::is_base_of_v<Model, M>) {
      if (x.m.supports.empty()) return;
      add_ring_supports(x.m, x.seen.data(), v, f);
      step_bristles(x.m, v, x.start.data(), x.kick * x.h, f);
    }
  }
  // Of magnets, which drive the coils too, and of several rings: run by run.
  ROTORUB_SLOW void add_actuators(const State& x, const T* v, T* f) const {
    double run_q[kMaxCoordinates], run_v[kMaxCoordinates], run_f[kMaxCoordinates];
    double asked[2 * kMaxContacts];
    const int nq = x.nq();
    for (int lane = 0; lane < kLanes; ++lane) {
      read_lane(x, x.seen, lane, run_q);
      for (int i = 0; i < nq; ++i) {
        run_v[i] = lanes::get(v[i], lane);
        run_f[i] = lanes::get(f[i], lane);
      }
      for (std::size_t b = 0; b < command.size(); ++b) {
        asked[2 * b] = lanes::get(command[b].x, lane);
        asked[2 * b + 1] = lanes::get(command[b].y, lane);
      }
      add_actuators_of_run(lane_model(x.m, lane), run_q, run_v, asked, run_f);
      for (int i = 0; i < nq; ++i) lanes::set(f[i], lane, run_f[i]);
    }
  }
  ROTORUB_SLOW void find_working(const M& m, const T& begin, const T& end) {
    for (std::size_t k = 0; k < m.feedbacks.size(); ++k) {
      for (int lane = 0; lane < kLanes; ++lane) {
        const double fails_at = lanes::get(m.feedbacks[k].law.fails_at, lane);
        lanes::set(working_[k], lane,
                   MagneticFeedback<double>::working(fails_at, lanes::get(begin, lane),
                                                     lanes::get(end, lane)));
      }
    }
  }

  bool coupled_ = false, iterates_ = false, magnetic_ = false, several_ = false, commanded_ = false;
  VelocityMatrix<T> matrix_;
  SteppedLoads<T> loads_;
  equations::DiscAngles<T> angles_;
  lanes::Array<T> bx_, by_;  // the coupling of bending and spin by unbalance, n each
  Coordinates f_, change_;
  // Of a deflection q_i the least energy that a step can tell, (1e-15 h k_i)^2/m_i q_i^2; their sum
  // at q_k.
  Coordinates round_off_;
  T balanced_{};
  // Share of the step for which each magnetic bearing has not failed.
  std::array<T, scene::kMaxMagneticBearings> working_{};
  // Of the iteration: 1 in the lanes that go on.
  T open_{};
  int rounds_ = 0;
  double instant_ = 0.0;  // s, of the loads
};

}  // namespace rotorub
