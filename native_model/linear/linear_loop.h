// Magnetic bearings and all states of their controls as one linear loop: without limits of current
// and voltage, and for pairs of opposing magnets linearised at their centre. In linear states x
// (for a sampled control, from sample to sample)
//
//   x' = A x between samples,   x+ = S x at each sample.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "native_model/model/closed_loop.h"
#include "native_model/model/model.h"

namespace rotorub {

// The model with linear feedback, without limits and bearing offsets. Each magnetic bearing that
// works at some time works always.
Model always_working(Model model);

// Indices of the feedbacks with a control that works at t = 0.
std::vector<std::size_t> working_feedbacks(const Model& model);

// Writes the mode values at a place to two columns of a matrix of 2 n rows: those of x to the rows
// of x, and those of y, in the next column, to the rows of y.
void put_planes(Eigen::MatrixXd& matrix, Eigen::Index column, const ModeShape& shape);

// Reason why the loop's law is not known, as a sentence; empty if it is known.
std::string loop_refusal(const Model& model);

struct LinearLoop {
  FirstOrderForm form;     // A in its own units
  double every = 0.0;      // s, sample time T; 0: continuous
  Eigen::MatrixXd sample;  // S in the form's units; empty if continuous
};
// Loop at a prescribed spin speed (rad/s). The caller must pass a model from always_working for
// which loop_refusal is empty.
LinearLoop linear_loop(const Model& model, double speed);

// Poles in 1/s by falling real part; empty if the iteration does not converge. For a sampled loop
// they are ln z / T, z the eigenvalues over one sample, without those at z = 0, whose motion ends
// within a few samples.
std::optional<std::vector<std::complex<double>>> loop_poles(const LinearLoop& loop);

// Complex amplitude Q (m, 2 n) of the steady response q = Re(Q e^{i w t}) of a stable loop to the
// force Re(f e^{i w t}) on the modes; f in N, 2 n; w > 0 in rad/s. A sampled control also responds
// at w + 2 pi k / T for every integer k; Q is the component at w. The result is exact: x, taken
// just before a sample, turns by e^{i w T} until just before the next. Between samples,
// X = x e^{-i w t} obeys X' = (A - i w) X + B f. With P = (i w - A)^-1 B f,
//
//   (e^{i w T} - e^{A T} S) x = (e^{i w T} - e^{A T}) P,
//   mean of X = P - (i w - A)^-1 (1 - S) x / T.
//
// The result is not finite if the loop without its samples has an undamped resonance.
Eigen::VectorXcd loop_amplitude(const Model& model, const LinearLoop& loop, double w,
                                const Eigen::VectorXcd& f);

}  // namespace rotorub
