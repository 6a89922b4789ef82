// The feedbacks of magnetic bearings (bearing/magnetic_feedback.h) as terms of the equations of
// motion; see equations.h.
#pragma once

#include "native_model/model/equations.h"

namespace rotorub::equations {

// The two values of a feedback state that begins at coordinate `at`; `otherwise` if there is no
// such state.
inline Pair feedback_state(const Model& m, int at, const double* v, const Pair& otherwise) {
  if (m.layout.feedback_states == 0 || at == kAbsent) return otherwise;
  return {v[at], v[at + 1]};
}

// A, currents of a magnetic bearing on each axis: requested, after the limit, and in the coil.
struct BearingCurrent {
  Pair asked, limited, current;
};
inline BearingCurrent bearing_current(const Model& m, const StationFeedback& bearing,
                                      const Pair& deflection, const Pair& rate, const double* v) {
  const auto& law = bearing.law;
  const Pair stored = feedback_state(m, bearing.states.stored, v, Pair{0.0, 0.0});
  const Pair d = feedback_state(m, bearing.states.filtered, v, rate);
  const Pair own{law.asked(deflection.x, d.x, stored.x), law.asked(deflection.y, d.y, stored.y)};
  const Pair asked = feedback_state(m, bearing.states.command, v, own);
  const Pair limited{law.limited(asked.x), law.limited(asked.y)};
  return {asked, limited, feedback_state(m, bearing.states.current, v, limited)};
}

// f += M times the rates of the feedback's states. The decay by their own lags is in the damping.
inline void add_feedback_rates(const Model& m, const StationFeedback& bearing, double share,
                               const Pair& deflection, const Pair& rate, const BearingCurrent& now,
                               double* f) {
  const auto& law = bearing.law;
  const auto add = [&](int at, double x, double y) {
    f[at] += m.mass[at] * x;
    f[at + 1] += m.mass[at + 1] * y;
  };
  const FeedbackStates& states = bearing.states;
  if (states.stored != kAbsent) {
    add(states.stored, law.stored_rate(share, deflection.x, now.asked.x),
        law.stored_rate(share, deflection.y, now.asked.y));
  }
  if (states.filtered != kAbsent) {
    add(states.filtered, rate.x / law.derivative_lag, rate.y / law.derivative_lag);
  }
  if (states.current != kAbsent) {
    // At the voltage limit, the mean of the two rates is not the rate of the mean.
    const auto& coil = law.amplifier;
    const auto rate_of = [&](const double asked, const double current) {
      const double rest = 1.0 - share;
      return (share * coil.load(asked, current) + rest * coil.load(0.0, current)) / coil.lag;
    };
    add(states.current, rate_of(now.limited.x, now.current.x),
        rate_of(now.limited.y, now.current.y));
  }
}

// f += the forces and state rates of the magnetic bearings with a feedback, beyond their linear
// springs. shares: for each one, the share of the time in which it works, in [0, 1].
inline void add_feedbacks(const Model& m, const double* shares, const double* q, const double* v,
                          double* f) {
  const int n = m.layout.modes;
  for (const auto& bearing : m.feedbacks) {
    const double share = *shares++;
    const auto& law = bearing.law;
    const auto& sensor = bearing.sensor ? *bearing.sensor : bearing.shape;
    const Pair r = at_station(n, bearing.shape, q), rate = at_station(n, sensor, v);
    const Pair deflection = bearing.sensor ? at_station(n, sensor, q) : r;
    const BearingCurrent now = bearing_current(m, bearing, deflection, rate, v);
    add_station_force(n, bearing.shape, law.force(share, r.x, now.current.x),
                      law.force(share, r.y, now.current.y), f);
    if (m.layout.feedback_states > 0)
      add_feedback_rates(m, bearing, share, deflection, rate, now, f);
  }
}

}  // namespace rotorub::equations
