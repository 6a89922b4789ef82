// A measured run laid beside simulated ones: aligned in time and frame with the first, and held
// against each of them sample by sample. Like is compared with like: the runs are taken at the
// record's samples, and averaged over one where the sensor is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/figures/figure.h"
#include "compare/measured/alignment.h"
#include "compare/measured/record.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// What a clipped sample makes of an extreme.
enum class Bound { kNone, kAtLeast, kAtMost };
const char* to_string(Bound bound);  // "", "at least", "at most"

// One figure of the record and, from the same samples, of each run.
struct MeasuredFigure : FigureText {
  double measured = 0.0;  // SI
  Bound bound = Bound::kNone;
  std::vector<double> runs{};  // SI, as MeasuredRun::labels
};

// What is left of a column against one run, over its good samples. SI, in the frame of the sensors.
struct ColumnResidual {
  double rms = 0.0;     // of record - run about its mean
  double offset = 0.0;  // mean of record - run: a sensor's zero, or a bias of the model
  // rms over the run's deviation from its mean; none where the run does not move.
  std::optional<double> share;
};
struct ColumnFit {
  const Measurable* what = nullptr;
  std::size_t good = 0, missing = 0, clipped = 0;  // samples on the run
  std::vector<ColumnResidual> runs{};              // as MeasuredRun::labels
};

struct MeasuredRun {
  std::string file;
  Alignment alignment;
  double interval = 0.0;            // s, between samples
  std::size_t samples = 0;          // in the record
  std::vector<std::string> labels;  // of the runs, native first
  std::vector<ColumnFit> columns;
  std::vector<MeasuredFigure> figures;
  std::vector<std::string> remarks;  // sentences: what was left out, and why
  // For plots and player: the samples on the run, by the scene's clock, x and y of a pair turned
  // into its frame; a column along x or y alone only where the frames are the same.
  MeasuredRecord laid;
  // N, of each run averaged over each of laid.t; empty: not measured.
  std::vector<std::vector<double>> forces;
};

// Which figures there can be, for documents.
std::vector<FigureText> measured_figures();

struct RunToHold {
  std::string label;
  const Trajectory* trajectory = nullptr;
};

// runs: native first; only those with two rows or more are held against it. The record is as it was
// read. Throws MeasuredError, as align().
MeasuredRun lay_in(MeasuredRecord record, const AlignmentOptions& options,
                   const scene::Scene& scene, const std::vector<RunToHold>& runs);

}  // namespace rotorub
