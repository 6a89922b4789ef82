// Identifies values of a scene from a measured run by least squares:
//
//   min over p, shift, angle  sum_c 1/s_c^2 sum_k |m_ck e^{i angle} - run_c(t_k + shift; p)|^2
//
// c: channels of the record (measured/fitting.h) without their means, because a sensor's zero is
// unknown; s_c: the difference in a channel after a first fit. The angle follows in closed form.
// The whole range is searched by DIRECT (J. Gablonsky, C. Kelley, J. Global Optim. 21, 2001), and
// its best point is improved by BOBYQA (M. Powell, 2009), both from NLopt, and finally by
// Gauss-Newton steps.
//
// Accuracy: with J the derivatives of the final difference r by all fitted unknowns, the estimate
// changes by (J^T J)^-1 J^T r. Its standard deviation assumes white noise, or the scatter of
// blocks of the record if that is larger (Fitting::error).
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/measured/alignment.h"
#include "compare/measured/record.h"
#include "native_model/scene/scene.h"

namespace rotorub::identify {

// A key to identify, and its range.
struct Wanted {
  std::string key;              // "contact.friction"
  std::string unit;             // SI; empty if dimensionless
  double from = 0.0, to = 0.0;  // SI, from < to
};

struct Found {
  Wanted wanted;
  double value = 0.0;  // SI
  // SI, standard deviation; empty if nothing in the record depends on the value.
  std::optional<double> error;
  bool at_edge = false;  // at an end of its range, so the optimum may lie beyond

  // The 95 % confidence interval, within the range.
  static constexpr double kSure = 1.96;
  double low() const;
  double high() const;
};

struct Parameters {
  std::vector<Wanted> wanted;  // at least one
  AlignmentOptions alignment;  // given values are kept
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double share)> progress;
};

struct Result {
  std::vector<Found> found;
  Eigen::MatrixXd correlation;  // of the values, n x n; 0 beside a value without error
  Alignment alignment;          // of the scene with the identified values
  // The remaining difference of the original scene in the measure of alignment.residual: over the
  // fitted samples, with the weights of the channels, relative to the rms of the run found. Empty
  // if the record does not fit the original scene's run at all.
  std::optional<double> left_before;
  bool is_exact() const;    // both differences are only round-off
  bool no_better() const;   // the original scene has a smaller difference, beyond round-off
  std::size_t samples = 0;  // number of fitted samples
  int runs = 0;
  bool interrupted = false;
  std::vector<std::string> overrides;  // "contact.friction=0.18", ...
};

// Reads the scene with further overrides. Its run uses the native engine of [run] integrator.
using ReadScene = std::function<scene::Scene(const std::vector<std::string>& overrides)>;

// Throws MeasuredError if the record does not fit the original scene's run, too few samples lie on
// it, or no run within the ranges reaches its end; scene::SceneError as the reader does.
Result identify(const ReadScene& read, MeasuredRecord record, const Parameters& parameters);

}  // namespace rotorub::identify
