// What a fixed step moves: coordinates and velocities, and the velocities that lead from one to the
// next.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/numerics/loops.h"
#include "native_model/numerics/status.h"

namespace rotorub {

struct StepState {
  using Coordinates = std::vector<double>;  // nq

  // The model must outlive this. step: s.
  StepState(const Model& model, double step)
      : m(model), h(step), q(static_cast<std::size_t>(model.nq())), nq_(model.nq()) {
    v = seen = start = free = after = q;
  }

  const Model& m;
  double h;             // s
  double origin = 0.0;  // s, t at k = 0
  // Coordinates and velocities before the step, and once it is taken after it.
  Coordinates q, v;
  // The coordinates at which loads and contact act.
  Coordinates seen;
  // Velocities with which the step begins; at its end without contact; at its end.
  Coordinates start, free, after;
  // The part of the step for which loads and contact act where they are iterated.
  double kick = 1.0;
  Status status = Status::kOk;  // with any other the state stays where it was

  int nq() const { return nq_; }
  double time_of(std::int64_t k) const { return origin + static_cast<double>(k) * h; }

  void fail(Status why) {
    if (status == Status::kOk) status = why;
  }
  // Another state at the same instant, nq values each.
  void adopt(const double* new_q, const double* new_v) {
    std::copy_n(new_q, nq(), q.begin());
    std::copy_n(new_v, nq(), v.begin());
  }

  // The step's beginning: seen = q, start = v, and `late` (nq values, or null) on top. q and v are
  // free to be written from here on: their vectors change places with those of the last step.
  void begin(const double* late) {
    q.swap(seen);
    keeps_v_ = late != nullptr;
    if (keeps_v_) return add_to_start(late);
    v.swap(start);
  }
  // The same without a step to come: q and v stay.
  void look(const double* late) {
    seen = q;
    start = v;
    if (late) add_to_start(late);
  }
  // The step's end: v = after, q = seen + h after, unless it is no longer finite.
  void move() {
    const int n = nq();
    const double *end = after.data(), *from = seen.data();
    const double total = sum(n, [end](int i) { return end[i]; });
    if (total - total != 0.0) fail(Status::kDiverged);
    if (status != Status::kOk) {
      q = seen;
      if (!keeps_v_) v = start;
      return;
    }
    double *to_q = q.data(), *to_v = v.data();
    ROTORUB_APART for (int i = 0; i < n; ++i) {
      to_v[i] = end[i];
      to_q[i] = from[i] + h * end[i];
    }
  }

 private:
  void add_to_start(const double* late) {
    const double* from = v.data();
    double* to = start.data();
    const int n = nq();
    ROTORUB_APART for (int i = 0; i < n; ++i) to[i] = from[i] + late[i];
  }

  int nq_;
  bool keeps_v_ = false;  // since begin()
};

// A flag among the numbers that outlive a step.
template <class Action>
void keep_flag(bool& flag, Action& action) {
  double number = flag ? 1.0 : 0.0;
  action(number);
  flag = number != 0.0;
}

}  // namespace rotorub
