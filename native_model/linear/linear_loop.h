// Magnetic bearings with all that their controls remember as one linear loop: within the limits of
// currents and voltages, of magnets that pull against each other about the middle. In linear states
// x, of a sampled control from sample to sample,
//
//   x' = A x between samples,   x+ = S x at each.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "native_model/model/closed_loop.h"
#include "native_model/model/model.h"

namespace rotorub {

// Within its limits, with bearings that work for ever where they work at some time.
Model always_working(Model model);

// Why its law is not known, as a sentence; empty: it is.
std::string loop_refusal(const Model& model);

struct LinearLoop {
  FirstOrderForm form;     // A in units of its own
  double every = 0.0;      // s, T, between samples; 0: continuous
  Eigen::MatrixXd sample;  // S in the form's units; empty: continuous
};
// At a held spin speed (rad/s). model: always_working, without a refusal (the caller's word).
LinearLoop linear_loop(const Model& model, double speed);

// 1/s, by falling real part; nothing: the iteration does not converge. Of a sampled loop ln z / T
// of those of its step of one sample, without those at z = 0, whose motion ends within a few
// samples.
std::optional<std::vector<std::complex<double>>> loop_poles(const LinearLoop& loop);

// Q (m, 2 n) of the steady answer q = Re(Q e^{i w t}) to the force Re(f e^{i w t}) on the modes, w
// > 0 (rad/s), f: N, 2 n; of a stable loop. A sampled control answers at w + 2 pi k / T, too, k any
// whole number: Q is the part at w. Exact: from before one sample to before the next x goes once
// around, and between them X = x e^{-i w t} obeys X' = (A - i w) X + B f, so that with P = (i w -
// A)^-1 B f
//
//   (e^{i w T} - e^{A T} S) x = (e^{i w T} - e^{A T}) P,   mean of X = P - (i w - A)^-1 (1 - S) x /
//   T
//
// Not finite where the loop without its samples has an undamped resonance.
Eigen::VectorXcd loop_amplitude(const Model& model, const LinearLoop& loop, double w,
                                const Eigen::VectorXcd& f);

}  // namespace rotorub
