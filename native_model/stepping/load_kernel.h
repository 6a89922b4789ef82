// What all loads do in a fixed step: the velocity change that they give about one instant,
//
//   M(q) (v+ - v-) = h F(q, (v- + v+)/2, t) + J^T p,
//
// p the contact's impulse (contact_kernel.h), for one run (M = Model) or for many (M = LaneModel),
// of any size or of a known one (sized_model.h). With A = M + h/2 D (velocity_matrix.h) the linear
// part is solved at once, v+ = v- + A^-1 (h F(q, v-) + J^T p); what depends on velocities beyond
// that (free spin with gyroscopics or unbalance, a motor's curve, coils, integrators, a magnetic
// bearing at its limit) is iterated. What a model lacks costs nothing. All inline: whoever calls it
// chooses the instruction set.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "native_model/bearing/actuator.h"
#include "native_model/dynamics/equations.h"
#include "native_model/stepping/lane_model.h"
#include "native_model/stepping/sized_model.h"
#include "native_model/stepping/stepped_loads.h"
#include "native_model/stepping/velocity_matrix.h"
#include "native_model/system/actuation.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

template <class M>
class LoadKernel {
 public:
  using T = typename M::Scalar;
  using Mask = lanes::Mask<T>;
  static constexpr int kLanes = lanes::kWidth<T>;
  using Centre = equations::Pair<T>;

  // `models`: those of the lanes, all of the same structure; they and `m` must outlive this.
  LoadKernel(const M& m, const std::vector<const Model*>& models, double h)
      : m_(&m), h_(h), matrix_(models, h), loads_(models, h) {
    const Model& first = *models.front();
    coupled_ = first.coupled_mass();
    commanded = layout().stator && first.first().commanded();
    const bool turns =
        layout().spin && (!first.gyroscopic.absent() || !first.internal_xx.absent() ||
                          !first.internal_yy.absent() || coupled_);
    const bool curve = first.drive && first.drive->kind() != scene::DriveKind::kLinear &&
                       first.drive->kind() != scene::DriveKind::kFree;
    for (const Model* model : models) switches_ = switches_ || feedback_switches(*model);
    bool follows = false;  // bearings the spin, where that is free
    for (const auto& film : first.films) follows = follows || (layout().spin && film.law.follows());
    iterates_ =
        turns || curve || follows || switches_ || layout().integrals > 0 || layout().coils > 0;
    magnetic_ = first.first().magnets.has_value();
    for (int i = 0; iterates_ && i < layout().nq(); ++i) {
      const auto c = static_cast<std::size_t>(i);
      const T sprung = lanes::all<T>(1e-15 * h) * m.stiffness[c];
      round_off_[c] = sprung * sprung / m.mass[c];
    }
    if (!coupled_) return;
    bx_.assign(static_cast<std::size_t>(layout().modes), T{});
    by_ = bx_;
  }

  const T* q() const { return q_.data(); }
  const T* v() const { return v_.data(); }

  // The command of the actuator over the next step (system/actuation.h): the force on the ring, or
  // the currents of the two axes; `commanded`: there is a command.
  T command_x{}, command_y{};
  bool commanded = false;
  const T* applied = nullptr;  // nq further loads, or none
  double origin = 0.0;         // s, t at k = 0
  Status status[kLanes] = {};  // a lane with one stays where it was

  // All that outlives a step, as plain numbers, in one order: action(double or T&).
  template <class Action>
  void for_each_kept(Action action) {
    action(origin);
    for (T& x : q_) action(x);
    for (T& x : v_) action(x);
    for (T& x : bx_) action(x);
    for (T& x : by_) action(x);
    loads_.for_each_kept(action);
  }
  // A state at t (s), nq values each: the memory of everything before it is gone.
  void begin(double t, const double* q, const double* v) requires(kLanes == 1) {
    for_each_kept([](double& x) { x = 0.0; });
    std::copy_n(q, layout().nq(), q_.begin());
    std::copy_n(v, layout().nq(), v_.begin());
    origin = t;
    revive();
  }
  // Another state at the same instant; everything else is kept.
  void adopt(const double* q, const double* v) requires(kLanes == 1) {
    std::copy_n(q, layout().nq(), q_.begin());
    std::copy_n(v, layout().nq(), v_.begin());
  }
  // The lane stays where it is.
  ROTORUB_SLOW void fail(int lane, Status why) {
    if (status[lane] == Status::kOk) status[lane] = why;
    failed_ = true;
  }
  // Ends every status.
  void revive() {
    for (Status& s : status) s = Status::kOk;
    failed_ = false;
    loads_.forget();
  }
  // The lanes' initial states.
  void load_initial_states() {
    for (int lane = 0; lane < kLanes; ++lane) {
      put_lane(q_, lane_model(*m_, lane).q0, lane);
      put_lane(v_, lane_model(*m_, lane).v0, lane);
    }
  }

 protected:
  using Coordinates = typename CoordinateArray<M>::Type;
  static constexpr auto make = &CoordinateArray<M>::make;

  // Room that a step needs: a local of a known size stays in registers.
  using Scratch = typename CoordinateArray<M>::Scratch;

  const LayoutOf<M>& layout() const { return m_->layout; }

  // F(q, v), all loads but the contact's; the loads of [[force]] as advanced last.
  ROTORUB_INLINE void force(const T* q, const T* v, T* f) {
    const M& m = *m_;
    const T omega = equations::spin_speed(m, v);
    equations::diagonal_force(m, q, v, f);
    equations::add_rotating_damping(m, q, v, omega, f);
    equations::add_dampers(m, v, f);
    equations::add_films(m, omega, q, v, f);
    equations::add_springs(m, q, f);
    if (m.feedback) equations::add_feedback(m, working_, q, v, f);
    equations::add_gyroscopic(m, omega, v, f);
    loads_.add(layout().modes, f);
    if (!m.unbalances.empty()) equations::add_unbalance(m, angles_, omega, f);
    equations::add_drive(m, instant_, q, v, f);
    if (applied) {
      for (int i = 0; i < layout().nq(); ++i) f[i] += applied[i];
    }
    if (magnetic_) {
      magnet_force(q, v, f);
    } else if (commanded && layout().stator) {
      f[layout().ring()] += command_x;
      f[layout().ring() + 1] += command_y;
    }
  }

  // start_ -> free_: the velocities that the loads of step k give, about the instant t and at q;
  // begin (s): of the loads, they end at t + h/2.
  ROTORUB_INLINE void free_velocity(std::int64_t k, double begin, double t, const T* q) {
    instant_ = t;
    const double end = t + 0.5 * h_;
    loads_.advance(k, t, begin, end);
    weighed_free_velocity(lanes::all<T>(begin), lanes::all<T>(end), q);
  }
  // The same with the loads as weighed last; begin..end: of all others that are switched.
  ROTORUB_INLINE void weighed_free_velocity(const T& begin, const T& end, const T* q) {
    const int nq = layout().nq();
    const T h = lanes::all<T>(h_);
    const double t = instant_;
    if (m_->feedback) find_working(begin, end);
    if (loads_.synchronous()) loads_.turn_with(equations::spin_angle(*m_, t, q));
    if (!m_->unbalances.empty()) {
      angles_.fill(*m_, t, q, begin, end);
      if (coupled_) equations::spin_coupling(*m_, angles_, bx_.data(), by_.data());
    }
    const T* start = start_.data();
    T* free = free_.data();
    Scratch scratch = f_;
    T* f = scratch.data();
    force(q, start, f);
    if (const T* step = coupled_ ? nullptr : matrix_.diagonal_step()) {
      for (int i = 0; i < nq; ++i) free[i] = start[i] + step[i] * f[i];
    } else {
      for (int i = 0; i < nq; ++i) f[i] = h * f[i];
      solve(f);
      for (int i = 0; i < nq; ++i) free[i] = start[i] + f[i];
    }
    if (!iterates_) return;
    balanced_ = T{};
    for (int i = 0; i < nq; ++i) balanced_ += round_off_[static_cast<std::size_t>(i)] * q[i] * q[i];
    begin_iteration(lanes::all<T>(1.0));
    while (improve(q, free)) {
    }
  }

  // In the lanes where `open` is 1.
  ROTORUB_INLINE void begin_iteration(const T& open) {
    rounds_ = 0;
    open_ = open;
  }
  // One round of the iteration: free_ from the forces at the middle of start_ and `end`, the step's
  // end with its contact. False once every lane has come to rest; one that has keeps its bits.
  ROTORUB_INLINE bool improve(const T* q, const T* end) {
    const int nq = layout().nq(), n = layout().modes, phi = layout().phi();
    const T h = lanes::all<T>(kick_ * h_), half = lanes::all<T>(0.5), zero{};
    const T *start = start_.data(), *mass = m_->mass.data();
    T *f = f_.data(), *change = change_.data(), *free = free_.data();
    for (int i = 0; i < nq; ++i) change[i] = half * (start[i] + end[i]);
    force(q, change, f);
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
    solve(f);
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
      if (lanes::get(open_, lane) > 0.0) fail(lane, Status::kStepTooLarge);
    }
    return false;
  }

  ROTORUB_INLINE void solve(T* f) {
    matrix_.solve(layout(), coupled_ ? bx_.data() : nullptr, by_.data(), f);
  }

  // J: of the forces of F at the middle of the step, but those that energy holds (springs, and with
  // a free spin unbalance, which is inertial), over h.
  double external_work(const double* q, const double* start,
                       const double* end) requires(kLanes == 1) {
    const int nq = layout().mechanical();
    double *f = f_.data(), *v = change_.data();
    for (int i = 0; i < layout().nq(); ++i) v[i] = 0.5 * (start[i] + end[i]);
    force(q, v, f);
    double work = 0.0;
    const double* stiffness = m_->stiffness.data();
    for (int i = 0; i < nq; ++i) work += (f[i] + stiffness[i] * q[i]) * v[i];
    if (m_->springs.empty() && !coupled_) return h_ * work;
    for (int i = 0; i < layout().nq(); ++i) f[i] = 0.0;
    equations::add_springs(*m_, q, f);
    if (coupled_) equations::add_unbalance(*m_, angles_, equations::spin_speed(*m_, v), f);
    for (int i = 0; i < nq; ++i) work -= f[i] * v[i];
    return h_ * work;
  }

  // x's component sum is finite in every lane, or the lane gets a status.
  ROTORUB_INLINE void check_finite(const T* x) {
    T sum{};
    const int nq = layout().nq();
    for (int i = 0; i < nq; ++i) sum += x[i];
    const T rest = sum - sum, zero{};  // 0 where finite
    if (!lanes::any(rest != zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(rest, lane) != 0.0) fail(lane, Status::kDiverged);
    }
  }
  // 1 in the lanes that go on.
  ROTORUB_INLINE T running() const {
    T ok{};
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes::set(ok, lane, status[lane] == Status::kOk ? 1.0 : 0.0);
    }
    return ok;
  }

  // A lane's numbers as the scalar model's.
  void read_lane(const T* from, int lane, double* to) const {
    for (int i = 0; i < layout().nq(); ++i) to[i] = lanes::get(from[i], lane);
  }
  Eigen::Vector3d lane_rates(const T* v, int lane) const {
    const Centre w = equations::relative(*m_, v);
    return {lanes::get(w.x, lane), lanes::get(w.y, lane),
            lanes::get(equations::contact_spin(*m_, v), lane)};
  }

  const M* m_;
  double h_;
  double kick_ = 1.0;  // of a step: what the loads and the contact act for where they are iterated
  bool coupled_ = false, iterates_ = false, failed_ = false, magnetic_ = false;
  VelocityMatrix<T> matrix_;
  SteppedLoads<T> loads_;
  equations::DiscAngles<T> angles_;
  lanes::Array<T> bx_, by_;  // the coupling of bending and spin by unbalance, n each
  // Coordinates; velocities before the step, at its start, without contact.
  Coordinates q_ = make(*m_), v_ = make(*m_), start_ = make(*m_), free_ = make(*m_);
  Coordinates f_ = make(*m_), change_ = make(*m_);
  // Of a deflection q_i the least energy that a step can tell, (1e-15 h k_i)^2/m_i q_i^2; their sum
  // at q_k.
  Coordinates round_off_ = make(*m_);
  T balanced_{};

 private:
  static constexpr int kMostRounds = 20;

  // What the magnetic bearing does leaves its linear law, of which the damper is in the matrix.
  static bool feedback_switches(const Model& m) {
    if (!m.feedback) return false;
    const MagneticFeedback<double>& law = m.feedback->law;
    if (law.damping() == 0.0 || law.fails_at <= 0.0) return false;
    return std::isfinite(law.current_limit) || law.fails_at < scene::kNever;
  }
  ROTORUB_SLOW void find_working(const T& begin, const T& end) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const double fails_at = lanes::get(m_->feedback->law.fails_at, lane);
      lanes::set(working_, lane,
                 MagneticFeedback<double>::working(fails_at, lanes::get(begin, lane),
                                                   lanes::get(end, lane)));
    }
  }

  // F(s, i) on the ring, lane by lane, and what drives the coils.
  ROTORUB_SLOW void magnet_force(const T* q, const T* v, T* f) const {
    const int ring = layout().ring(), coil = layout().coil();
    for (int lane = 0; lane < kLanes; ++lane) {
      const MagneticActuator& magnets = *lane_model(*m_, lane).first().magnets;
      const auto of = [lane](const T& x) { return lanes::get(x, lane); };
      const Eigen::Vector2d asked{of(command_x), of(command_y)};
      Eigen::Vector2d current = asked;
      for (int k = 0; k < layout().coils; ++k) {
        current[k] = of(v[coil + k]);
        lanes::set(f[coil + k], lane, of(f[coil + k]) + coil_load(magnets, asked[k], current[k]));
      }
      const Eigen::Vector2d s = to_axes({of(q[ring]), of(q[ring + 1])});
      const Eigen::Vector2d force = from_axes(
          {magnets.law->force(s.x(), current.x()), magnets.law->force(s.y(), current.y())});
      lanes::set(f[ring], lane, of(f[ring]) + force.x());
      lanes::set(f[ring + 1], lane, of(f[ring + 1]) + force.y());
    }
  }

  T open_{};
  T working_{};  // share of the step for which the magnetic bearing has not failed
  bool switches_ = false;
  int rounds_ = 0;
  double instant_ = 0.0;  // s, of the loads
};

}  // namespace rotorub
