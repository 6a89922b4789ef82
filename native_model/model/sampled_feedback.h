// Controllers of magnetic bearings that are asked once a sample (SampledFeedback): what they
// remember and command are states of the feedbacks, which jump at the samples k T and hold between
// them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "native_model/model/model.h"

namespace rotorub {

// The sample at t (s): v <- what holds after it, of the state (q, v) before it, nq values each. A
// controller none of whose bearings works asks for nothing and forgets. Throws ControllerError
// where a library's law fails: v is then as it was.
void take_sample(const Model& model, const SampledFeedback& sampled, double t, const double* q,
                 double* v);

// For each control that takes its first sample at t (s), or its first after it was off: sets v to
// the memory that the control has at that sample. A reader of the whole state at this instant,
// before the samples are taken, then sees the memory that the design of a law assumes.
void begin_samples(const Model& model, double t, const double* q, double* v);

// One sample of all samplers without limits, at once, some time after the first, as a matrix: what
// the feedbacks' states are after it, of q's bending (2 n) and those before it.
Eigen::MatrixXd linear_sample(const Model& model);

// The samples that are due at the instant t of steps of length h (s): at the first instant at or
// after each. True where there was one.
bool take_samples(const Model& model, double t, double h, const double* q, double* v);

// The samples of a step h long about t whose velocities are those of half a step before (MuJoCo's
// semi-implicit one): v <- what acts on average, f += what makes the feedbacks' states jump. A
// run's first step is a whole one, and all of it has what its sample gives.
void jump_in_step(const Model& model, double t, double h, const double* q, double* v, double* f);

// Why steps of this length (s) do not meet all samples; empty: they do.
std::string sample_refusal(const Model& model, double step);

}  // namespace rotorub
