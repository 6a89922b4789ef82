// One scene, run by the native model (with the scene's integrator) and by MuJoCo with each contact
// model, and everything that can be said about the difference.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "compare/align/divergence.h"
#include "compare/align/impacts.h"
#include "compare/engine/engine.h"
#include "compare/metrics/metrics.h"
#include "compare/study/figure.h"
#include "compare/study/split.h"

namespace rotorub {

struct CompareOptions {
  double tolerance = 0.01;   // share: on the judged figures
  int timing_repeats = 3;    // >= 1, of runs that record nothing, engines taken in turn
  std::size_t impacts = 8;   // first impacts listed
  std::size_t rows = 50000;  // recorded at most: every step, or every so many of them
  // (share done of this scene, what is running)
  std::function<void(double, const std::string&)> progress;
  const std::atomic<bool>* interrupt = nullptr;
};

// Cost over repeated runs without recording.
struct Timing {
  std::vector<double> us_per_step;  // one a run
  double median = 0.0, lowest = 0.0, highest = 0.0;
};

// One engine on the scene. Sides[0] is native, then MuJoCo's contact models.
struct Side {
  std::string label;      // "native", "coulomb", "cone"
  std::string engine;     // "native-paper", "mujoco-coulomb"
  Trajectory trajectory;  // rows dense enough for plots, with the scene's output times
  Metrics metrics;
  std::vector<Extrapolation> limits;  // as figures(); figures that are not split: values alone
  Timing timing;
};

// One figure of one MuJoCo side against the native one.
struct FigureDifference {
  const Figure* figure = nullptr;
  double native = 0.0, other = 0.0;
  double deviation = 0.0;  // see deviation()
  double floor = 0.0;      // |deviation| of the native one-ulp twins among themselves, largest
  bool within = true;      // |deviation| <= tolerance; true where the figure is not judged
  Split split;
};

struct SideDifference {
  std::vector<FigureDifference> figures;  // as figures()
  Divergence divergence;
  std::vector<ImpactPair> impacts;   // a: native
  bool within = false;               // all judged figures are, and both runs ended well
  bool trusted_as_default = false;   // the contact model that decides the exit code
  std::vector<std::string> reasons;  // why they differ, or that they agree; sentences
};

struct SceneComparison {
  scene::Scene scene;
  double tolerance = 0.0;
  std::vector<Side> sides;                  // native first
  std::vector<SideDifference> differences;  // of sides[1], sides[2], ...
  Divergence twin;                          // native against its one-ulp twin
  bool interrupted = false;                 // nothing beyond the runs that ended is filled
  // Worst of the runs that decide: native and the default contact model.
  Status status() const;
  bool within() const;
};

// The contact model that MuJoCo takes by default, which decides the verdict.
inline constexpr scene::ContactModel kDefaultContact = scene::ContactModel::kRigid;

// Throws what the engines throw. An interrupt ends it early with what there is.
SceneComparison compare_scene(const scene::Scene& scene, const CompareOptions& options);

// Times of rows: every step, or every so many so that there are at most `rows`, and the scene's
// requested times.
std::vector<double> dense_times(const scene::Run& run, std::size_t rows);

// The rows of a trajectory at the given times (those that it has), everything else as it is.
Trajectory rows_at(const Trajectory& trajectory, const std::vector<double>& times);

}  // namespace rotorub
