// What a fixed step moves: coordinates and velocities of one run (M = Model), or of many in lanes
// (M = LaneModel), and the velocities that lead from one to the next.
#pragma once

#include <cstdint>

#include "native_model/numerics/status.h"
#include "native_model/stepping/lane_model.h"

namespace rotorub {

template <class M>
struct StepState {
  using T = typename M::Scalar;
  static constexpr int kLanes = lanes::kWidth<T>;
  using Coordinates = typename CoordinateArray<M>::Type;
  static constexpr auto make = &CoordinateArray<M>::make;

  // The model must outlive this. step: s.
  StepState(const M& model, double step) : m(model), h(step) {}

  const M& m;
  double h;             // s
  double origin = 0.0;  // s, t at k = 0
  // Coordinates and velocities before the step, and once it is taken after it.
  Coordinates q = make(m), v = make(m);
  // The coordinates at which loads and contact act.
  Coordinates seen = make(m);
  // Velocities with which the step begins; at its end without contact; at its end.
  Coordinates start = make(m), free = make(m), after = make(m);
  // Of the step: what loads and contact act for where they are iterated.
  double kick = 1.0;
  Status status[kLanes] = {};  // a lane with one stays where it was
  bool failed = false;

  int nq() const { return m.layout.nq(); }
  double time_of(std::int64_t k) const { return origin + static_cast<double>(k) * h; }

  ROTORUB_SLOW void fail(int lane, Status why) {
    if (status[lane] == Status::kOk) status[lane] = why;
    failed = true;
  }
  // Ends every status.
  void revive() {
    for (Status& s : status) s = Status::kOk;
    failed = false;
  }
  // Another state at the same instant, nq values each; of one run.
  void adopt(const double* new_q, const double* new_v) {
    std::copy_n(new_q, nq(), q.begin());
    std::copy_n(new_v, nq(), v.begin());
  }
  void load_initial_states() {
    for (int lane = 0; lane < kLanes; ++lane) {
      put_lane(q, lane_model(m, lane).q0, lane);
      put_lane(v, lane_model(m, lane).v0, lane);
    }
  }

  // The step's end: v = after, q = seen + dt after. A lane that is no longer finite gets a status.
  ROTORUB_INLINE void move(const T& dt) {
    check_finite();
    if (failed) return move_running(dt);
    const T *end = after.data(), *from = seen.data();
    T *to_q = q.data(), *to_v = v.data();
    for (int i = 0; i < nq(); ++i) {
      to_v[i] = end[i];
      to_q[i] = from[i] + dt * end[i];
    }
  }

 private:
  ROTORUB_INLINE void check_finite() {
    const T* end = after.data();
    const T sum = lanes::sum<T>(nq(), [&](int i) { return end[i]; });
    const T rest = sum - sum, zero{};  // 0 where finite
    if (!lanes::any(rest != zero)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      if (lanes::get(rest, lane) != 0.0) fail(lane, Status::kDiverged);
    }
  }
  ROTORUB_INLINE void move_running(const T& dt) {
    T runs{};
    for (int lane = 0; lane < kLanes; ++lane) {
      lanes::set(runs, lane, status[lane] == Status::kOk ? 1.0 : 0.0);
    }
    const auto moves = runs > T{};
    for (int i = 0; i < nq(); ++i) {
      const auto c = static_cast<std::size_t>(i);
      q[c] = lanes::select(moves, seen[c] + dt * after[c], q[c]);
      v[c] = lanes::select(moves, after[c], v[c]);
    }
  }
};

// A lane's numbers as the scalar model's.
template <class M>
void read_lane(const StepState<M>& x, const typename StepState<M>::Coordinates& from, int lane,
               double* to) {
  for (int i = 0; i < x.nq(); ++i) to[i] = lanes::get(from[static_cast<std::size_t>(i)], lane);
}
template <class T>
void add_to_lane(T& to, int lane, double value) {
  lanes::set(to, lane, lanes::get(to, lane) + value);
}

}  // namespace rotorub
