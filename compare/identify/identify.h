// Values of a scene found from a measured run: the least squares of what is left of the record.
//
//   min over p, shift, angle  sum_c 1/s_c^2 sum_k |m_ck e^{i angle} - run_c(t_k + shift; p)|^2
//
// c: channels of the record (measured/fitting.h), means taken off, as no sensor's zero is known;
// s_c: what is left of a channel, from a first fit. The angle follows in closed form. First a
// search of the whole range (DIRECT: J. Gablonsky, C. Kelley, J. Global Optim. 21, 2001), then
// BOBYQA from its best (M. Powell, 2009), both of NLopt; steps of Gauss and Newton end it.
//
// How well a value is known: with J the derivatives of what is left at the end by all that is
// fitted, the estimate moves by (J^T J)^-1 J^T r, whose deviation is that of noise, or of stretches
// of the record that scatter by more (Fitting::error).
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

// A key that is looked for, and where.
struct Wanted {
  std::string key;              // "contact.friction"
  std::string unit;             // SI; empty: a number
  double from = 0.0, to = 0.0;  // SI, from < to
};

struct Found {
  Wanted wanted;
  double value = 0.0;  // SI
  // SI, standard deviation; none: the record does not tell, as nothing that it shows depends on it.
  std::optional<double> error;
  bool at_edge = false;  // of its range: what is best may lie beyond

  // Of 95 %, within the range.
  static constexpr double kSure = 1.96;
  double low() const;
  double high() const;
};

struct Parameters {
  std::vector<Wanted> wanted;  // one or more
  AlignmentOptions alignment;  // what is given of it is held
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(double share)> progress;
};

struct Result {
  std::vector<Found> found;
  Eigen::MatrixXd correlation;  // of what was found, n x n; 0 beside one that has no error
  Alignment alignment;          // of the scene with these values
  // What the scene as it stood leaves, by the measure of alignment.residual: the samples that were
  // fitted, each channel by its weight, over the rms of the run found. None: the record lay nowhere
  // on it.
  std::optional<double> left_before;
  bool no_better() const;   // the scene as it stood leaves less
  std::size_t samples = 0;  // of the record, fitted
  int runs = 0;
  bool interrupted = false;
  std::vector<std::string> overrides;  // "contact.friction=0.18", ...
};

// The scene with further overrides; its native engine is that of [run] integrator.
using ReadScene = std::function<scene::Scene(const std::vector<std::string>& overrides)>;

// Throws MeasuredError where the record lies nowhere on the run of the scene as it stands, too few
// samples are on it, or no run within the ranges comes to its end; scene::SceneError as the reader.
Result identify(const ReadScene& read, MeasuredRecord record, const Parameters& parameters);

}  // namespace rotorub::identify
