// The periodic motion to which a run settles. The run is checked at a few instants, after a
// duration and each time after twice the time: if it nearly comes back to its state after 1, 2, ...
// n periods, Newton's method (periodic_motion.h) begins there. Its result counts if it is stable,
// is near the state of the run, and comes back to itself in a run over three of its periods. So a
// motion that the run only passes on its way does not count.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "native_model/periodic/periodic_motion.h"

namespace rotorub::periodic {

struct SettlingParameters {
  double duration = 1.0;  // s, > 0, of the run until the first check, after the last switched load
  int most_checks = 7;    // the last one is 2^(n - 1) durations after the last switched load
  int most_periods = 6;   // n of the loads, or turns of a free spin, in one period of the motion
  // Limit of the effort for the run and its checks together; counted in stretches of the run, so
  // that the result does not depend on the processor. They take 2 s for a small system and 10 s for
  // a shaft with many modes.
  std::int64_t most_stretches = 500'000;
  SearchParameters search{};
  const std::atomic<bool>* interrupt = nullptr;  // ends the search early when it becomes true
  bool is_interrupted() const { return interrupt && interrupt->load(std::memory_order_relaxed); }
};

struct SettledMotion {
  std::string refusal;  // the reason why there is none, or empty
  PeriodicMotion motion;
  // Periods of the loads, or turns of a free spin, in one period; 0 in an autonomous system.
  int order = 0;
  double run_time = 0.0;      // s, time at which the run was near enough to the motion
  double return_error = 0.0;  // of a run over three periods, relative to the sizes of the state
  std::optional<State> last;  // last state, if the run keeps moving and no period was found
  bool found() const { return refusal.empty(); }
};

// start: at its time; see initial_state(). It may lack the states of with_control_states(): the
// sampled controllers then begin there.
SettledMotion settled_motion(const Model& model, const State& start,
                             const SettlingParameters& parameters = {});

}  // namespace rotorub::periodic
