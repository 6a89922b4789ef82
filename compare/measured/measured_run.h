// A measured run compared with simulated runs: it is aligned in time and frame with the first one
// and compared with each sample by sample. The runs are evaluated at the record's samples, and
// averaged over the sample if the sensor averages.
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

// How clipped samples bound a figure.
enum class Bound { kNone, kAtLeast, kAtMost };
const char* to_string(Bound bound);  // "", "at least", "at most"

// A figure of the record and of each run, from the same samples.
struct MeasuredFigure : FigureText {
  double measured = 0.0;  // SI
  Bound bound = Bound::kNone;
  std::vector<double> runs{};  // SI, in the order of MeasuredRun::labels
};

// The difference between a column and a run over the column's good samples. SI, in the sensors'
// frame.
struct ColumnResidual {
  double rms = 0.0;     // of record - run, about its mean
  double offset = 0.0;  // mean of record - run: the sensor's zero or a bias of the model
  // rms relative to the run's deviation from its mean; empty if the run does not move.
  std::optional<double> share;
};
struct ColumnFit {
  const Measurable* what = nullptr;
  std::size_t good = 0, missing = 0, clipped = 0;  // numbers of samples on the run
  std::vector<ColumnResidual> runs{};              // in the order of MeasuredRun::labels
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
  // For plots and the player: the samples on the run in the scene's time, with x and y of a pair
  // turned into its frame. A single x or y column is included only if the frames are equal.
  MeasuredRecord laid;
  // N, of each run, averaged over each sample of laid.t; empty if not measured.
  std::vector<std::vector<double>> forces;
};

// All possible figures, for documents.
std::vector<FigureText> measured_figures();

struct RunToHold {
  std::string label;
  const Trajectory* trajectory = nullptr;
};

// runs: native first; runs with fewer than two rows are ignored. record: as it was read. Throws
// MeasuredError like align().
MeasuredRun align_record(MeasuredRecord record, const AlignmentOptions& options,
                         const scene::Scene& scene, const std::vector<RunToHold>& runs);

}  // namespace rotorub
