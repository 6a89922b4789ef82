// Sampled controls of magnetic bearings (SampledFeedback). Their memory and commands are states of
// the feedbacks, which jump at the samples k T and hold in between.
#pragma once

#include <Eigen/Core>
#include <string>

#include "native_model/model/model.h"

namespace rotorub {

// Takes the sample at t (s): replaces the states in v by those after the sample, computed from q
// and v before it, nq values each. A control commands 0 and loses its memory while none of its
// bearings works. Throws ControllerError if a library's law fails; v is then unchanged.
void take_sample(const Model& model, const SampledFeedback& sampled, double t, const double* q,
                 double* v);

// For each control that takes its first sample at t (s), or its first after it was off: sets v to
// the memory that the control has at that sample. Code that reads the whole state at this instant,
// before the samples are taken, then sees the memory that the design of a law assumes.
void begin_samples(const Model& model, double t, const double* q, double* v);

// One simultaneous sample of all samplers, not the first one, as a matrix s x (2 n + s): the
// feedbacks' states after it from the bending coordinates (2 n) and the states before it. The model
// must have linear feedbacks (with_linear_feedback).
Eigen::MatrixXd linear_sample(const Model& model);

// Takes the samples that are due at time t with time steps of length h (s); a sample is due at the
// first time step at or after it. Returns true if there was one.
bool take_samples(const Model& model, double t, double h, const double* q, double* v);

// Takes the samples of a step of length h (s) about t whose velocities belong to half a step
// earlier (MuJoCo's semi-implicit integrator). Adds to f the loads that make the states jump, and
// sets the states in v to their mean over the step: it adds half of each jump, but all of it in the
// first step of a run.
void take_samples_in_step(const Model& model, double t, double h, const double* q, double* v,
                          double* f);

// True if a control with this sample time (s) takes a sample at t (s), up to round-off.
bool falls_on_sample(double sample_time, double t);

// The reason why time steps of this length (s) miss samples; empty if they do not.
std::string sample_refusal(const Model& model, double step);

}  // namespace rotorub
