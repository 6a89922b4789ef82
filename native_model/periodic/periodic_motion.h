// Periodic motions by Newton's method on the return map (return_map.h):
//
//   P(x) - x = 0                                          under loads of a known period
//   P(x, T) - x = 0,  x'(start) . (x - x_k) = 0           autonomous: the period T is unknown too,
//                                                         and x_k, the last iterate, fixes the
//                                                         phase
//
// A step is shortened while it does not make the residual smaller. The stability follows from the
// Floquet multipliers, the eigenvalues of P' on the tangent space of the contacts held at the
// start. An autonomous motion has one multiplier 1, of a shift in time, which is left out.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "native_model/periodic/return_map.h"

namespace rotorub::periodic {

struct SearchParameters {
  double tolerance = 1e-10;  // of the residual, relative to the sizes of the state
  int most_iterations = 40;
  int most_halvings = 8;  // of one step
  EventParameters event{};
};

enum class SearchStatus {
  kFound,
  kNoConvergence,  // from this start; another may lead to a motion
  kRunFailed,      // the motion from the start ends before one period (Painleve, range, ...)
  kGrazes,         // a contact grazes, where the return map has no derivative
  kRefused,        // such a scene has no periodic motion, or it is not supported
};
const char* to_string(SearchStatus status);

// The start of a search.
struct Guess {
  State start;          // its time decides the phase of the loads; at least Forcing::settled
  double period = 0.0;  // s
  int turns = 0;        // of the spin angle in a period, if it acts (Forcing::turns)
  HeldContacts held{};  // rigid contacts that last at the start
  // The motion repeats in the frame that turns with the loads (turning_frame.h).
  bool turning = false;
};

struct PeriodicMotion {
  SearchStatus status = SearchStatus::kNoConvergence;
  std::string message;  // for a status other than kFound
  State start;          // at `start.t`
  double period = 0.0;  // s
  int turns = 0;
  HeldContacts held{};
  double frame = 0.0;  // rad/s, speed of the frame in which it repeats; 0: at rest
  double residual = 0.0;
  int iterations = 0;
  // In order of decreasing magnitude. Sliding and sticking in the period make some of them 0 up to
  // round-off.
  std::vector<std::complex<double>> multipliers;
  bool stable = false;  // see is_stable
  bool found() const { return status == SearchStatus::kFound; }
};

PeriodicMotion find_periodic_motion(const Model& model, const Guess& guess,
                                    const SearchParameters& parameters = {});

// The Floquet multipliers of a derivative at a periodic motion, in order of decreasing magnitude.
// If the motion is autonomous, the multiplier nearest to 1 is left out.
std::vector<std::complex<double>> floquet_multipliers(const ReturnDerivative& derivative,
                                                      bool autonomous);

// True if none of them is larger than 1 beyond round-off, 1e-8. False without multipliers.
bool is_stable(const std::vector<std::complex<double>>& multipliers);

}  // namespace rotorub::periodic
