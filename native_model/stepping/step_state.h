// The state that a fixed step advances: coordinates, velocities, and the intermediate velocities.
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

  // The model must outlive this object. step: s.
  StepState(const Model& m, double step)
      : model(m), h(step), q(static_cast<std::size_t>(m.nq())), nq_(m.nq()) {
    v = q_k = v_start = v_free = v_end = q;
  }

  const Model& model;
  double h;             // s, time step
  double origin = 0.0;  // s, t at k = 0
  // Coordinates and velocities before the step and, when it is done, after it.
  Coordinates q, v;
  // The coordinates at t_k, where loads and contact are evaluated.
  Coordinates q_k;
  // The velocities of the kick: at its start, t_{k-1/2} (t_0 in a first step); at its end,
  // t_{k+1/2}, with all loads but without contact; at its end with everything.
  Coordinates v_start, v_free, v_end;
  // Duration of the step's kick, in steps: 1, or 1/2 in a first step.
  double kick_length = 1.0;
  Status status = Status::kOk;  // with any other status q and v stay unchanged

  int nq() const { return nq_; }
  double time_of(std::int64_t k) const { return origin + static_cast<double>(k) * h; }

  void fail(Status why) {
    if (status == Status::kOk) status = why;
  }
  // Takes over another state at the same instant, nq values each.
  void adopt(const double* new_q, const double* new_v) {
    std::copy_n(new_q, nq(), q.begin());
    std::copy_n(new_v, nq(), v.begin());
  }

  // Begins a step: q_k = q, v_start = v plus `deferred` (nq values, or null). q and v may be
  // overwritten from here on, because their vectors are swapped with those of the last step.
  void begin(const double* deferred) {
    q.swap(q_k);
    keeps_v_ = deferred != nullptr;
    if (keeps_v_) return set_start(deferred);
    v.swap(v_start);
  }
  // Sets q_k and v_start like begin() for a look at the next kick; q and v stay unchanged.
  void begin_precomputing(const double* deferred) {
    q_k = q;
    v_start = v;
    if (deferred) set_start(deferred);
  }
  // Ends the step with the drift: v = v_end, q = q_k + h v_end. If a value is no longer finite, it
  // sets kDiverged and restores the state.
  void drift() {
    const int n = nq();
    const double *end = v_end.data(), *from = q_k.data();
    const double total = sum(n, [end](int i) { return end[i]; });
    if (total - total != 0.0) fail(Status::kDiverged);
    if (status != Status::kOk) {
      q = q_k;
      if (!keeps_v_) v = v_start;
      return;
    }
    double *to_q = q.data(), *to_v = v.data();
    ROTORUB_APART for (int i = 0; i < n; ++i) {
      to_v[i] = end[i];
      to_q[i] = from[i] + h * end[i];
    }
  }

 private:
  // v_start = v + deferred.
  void set_start(const double* deferred) {
    const double* from = v.data();
    double* to = v_start.data();
    const int n = nq();
    ROTORUB_APART for (int i = 0; i < n; ++i) to[i] = from[i] + deferred[i];
  }

  int nq_;
  bool keeps_v_ = false;  // begin() has not swapped v
};

// Passes a flag to `action` as one of the numbers that are kept between steps.
template <class Action>
void visit_flag(bool& flag, Action& action) {
  double number = flag ? 1.0 : 0.0;
  action(number);
  flag = number != 0.0;
}

}  // namespace rotorub
