// Sampled controllers of rings whose memory is a part of the state (with_control_states in
// model.h). From AuxiliaryBearing::control_state on, v contains the actuator's two commands, held
// until the next sample, and then the memory of AuxiliaryBearing::loop. They jump at the samples k
// T, as the states of sampled magnetic bearings do (sampled_feedback.h). A state then determines
// its motion.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "native_model/model/model.h"

namespace rotorub {

inline bool has_control_states(const AuxiliaryBearing& at) { return at.control_state != kAbsent; }
// Number of its states.
int control_states(const AuxiliaryBearing& at);

// Takes the sample of this auxiliary bearing at t (s): replaces its states in v by those after the
// sample. q, v: nq values. Throws ControllerError if the law fails; v is then unchanged.
void take_control_sample(const Model& model, std::size_t bearing, double t, const double* q,
                         double* v);

// The law's outputs at the last sample (ActuatorState::outputs).
std::array<double, kMostOutputs> outputs_in_state(const Model& model, std::size_t bearing,
                                                  const double* v);

// The indices in v of the states of this bearing that determine later commands and return in a
// periodic motion: without times, spin angles and what a law never changes after its start.
std::vector<int> returning_control_states(const Model& model, std::size_t bearing);

// Sets the times, and the spin angles of a held spin, in the memories to those of a run that has
// arrived at t (s), whose sample at t is not taken yet.
void set_control_clock(const Model& model, double t, double* v);

}  // namespace rotorub
