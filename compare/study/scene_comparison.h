// One scene, run by the native model (with the scene's integrator) and by MuJoCo with each contact
// model, and everything that can be said about the difference.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/figures/figure.h"
#include "compare/measured/measured_run.h"
#include "compare/metrics/divergence.h"
#include "compare/metrics/extrapolation.h"
#include "compare/metrics/metrics.h"
#include "compare/metrics/rows.h"
#include "compare/model_error/model_error.h"
#include "compare/study/resync.h"
#include "compare/study/trust.h"

namespace rotorub {

// How the two sides of a comparison are coupled.
enum class CompareMode {
  kLockstep,  // each side closes its own loop
  kReplay,    // the native side is driven by the commands that MuJoCo's actuators were given: what
              // differs is the contact, and not the closed loop
  kResync     // at every onset of contact the native side restarts from MuJoCo's state and predicts
              // that contact: says something even of trajectories that are chaotic
};

const char* to_string(CompareMode mode);  // "lockstep", "replay", "resync"
// Of one of these names; asserts that it is one.
CompareMode compare_mode_of(const std::string& name);

class OwnMachine;  // compare/own/own_machine.h

// The contact model whose verdict counts, unless another is asked for.
inline constexpr scene::ContactModel kDefaultContact = scene::ContactModel::kRigid;
inline constexpr int kDefaultTwins = 20;

struct CompareOptions {
  CompareMode mode = CompareMode::kLockstep;
  double tolerance = 0.01;                        // share: on the judged figures
  scene::ContactModel contact = kDefaultContact;  // whose verdict is that of the comparison
  int twins = kDefaultTwins;  // >= 0, of the native run: at most, as many as the verdict needs
  int jobs = 0;               // threads; 0: one a processor. The result does not depend on it
  bool modes_ladder = true;   // the error of the modes kept, where the rotor is in geometry form
  int timing_repeats = 3;     // >= 1, of runs that record nothing, engines taken in turn
  std::size_t impacts = 8;    // first impacts listed
  // The scene is the twin of a machine of the user's own: MuJoCo runs that one.
  std::shared_ptr<const OwnMachine> own;
  std::size_t rows = kRows;  // recorded at most: every step, or every so many of them
  // A record to lay beside the runs; null: none.
  std::shared_ptr<const MeasuredRecord> measured;
  AlignmentOptions alignment{};  // of it
  // (share done of this scene, what is running)
  std::function<void(double, const std::string&)> progress;
  const std::atomic<bool>* interrupt = nullptr;
};

// Cost over repeated runs without recording.
struct Timing {
  std::vector<double> us_per_step;  // one a run
  double median = 0.0, lowest = 0.0, highest = 0.0;
};

// One engine on the scene. Sides[0] is native, sides[1] MuJoCo with the contact model that decides,
// then the other contact models.
struct Side {
  std::string label;      // "native", "coulomb", "cone"
  std::string engine;     // "native-verlet", "mujoco-coulomb"
  std::string solref;     // of MuJoCo's contact at the comparison's step, "0.02 1"; empty: no part
  Trajectory trajectory;  // rows dense enough for plots, with the scene's output times
  Metrics metrics;
  std::vector<Extrapolation> limits;  // as figures(); figures that are not split: values alone
  Timing timing;

  std::string early_end() const;  // half a sentence; empty: it ended well
};

// One figure of one MuJoCo side against the native one.
struct FigureDifference : JudgedFigure {
  double floor = 0.0;         // |deviation| of the native twins, largest
  double replay_floor = 0.0;  // see replay_floor(); the interval is no less
  Split split;
};

// The native stepper at MuJoCo's step (comparison_runs.h).
struct ShadowColumn {
  std::optional<Side> side;           // label "shadow"
  std::string absent;                 // why there is none
  bool driven = false;                // by the commands of the run that decides
  std::vector<JudgedFigure> figures;  // as figures(), against sides[0]
};

struct SideDifference {
  std::vector<FigureDifference> figures;  // as figures()
  std::optional<Resync> resync;           // in resync: what the trust is by
  Divergence divergence;
  std::vector<ImpactPair> impacts;  // a: native
  Trust trust = Trust::kNo;         // kNo as well where a run did not end well
  bool decides = false;             // the exit code
  bool within() const { return trust == Trust::kYes; }
  std::vector<JudgedFigure> judged() const { return {figures.begin(), figures.end()}; }
  std::vector<std::string> reasons;  // why they differ, or that they agree; sentences
};

struct SceneComparison {
  scene::Scene scene;
  bool own = false;                      // the twin of a machine of the user's own
  std::vector<std::string> twin_limits;  // what it leaves out, sentences
  // The largest of them where it is above the tolerance: then no difference is due to the contact
  // for certain, and every verdict is undecidable. Else empty.
  std::string omission;
  CompareMode mode = CompareMode::kLockstep;
  bool commands = false;  // a controller commands the actuator: else replay equals lockstep
  double tolerance = 0.0;
  int twins = 0;            // of the native run, as many as were needed
  int decider_twins = 0;    // of the MuJoCo run that decides: none where the motion repeats itself
  std::vector<Side> sides;  // native first
  // Replay with commands: sides[0] is driven by those of sides[1], and these by those of sides[2],
  // sides[3], ...: what each of them is compared with. Else empty.
  std::vector<Side> natives;
  const Side& reference(std::size_t side) const {
    return side < 2 || natives.empty() ? sides.front() : natives[side - 2];
  }
  ShadowColumn shadow;
  // The native run of a passive bearing, where the scene's controller commands: none where that one
  // fails.
  std::optional<Trajectory> uncontrolled;
  std::vector<SideDifference> differences;  // of sides[1], sides[2], ...
  Divergence twin;                          // native against the twin that parts first
  std::optional<ModelError> model_error;    // none: not asked for
  std::optional<MeasuredRun> measured;      // none: not asked for
  bool interrupted = false;                 // nothing beyond the runs that ended is filled
  // Worst of the runs that decide: native and sides[1].
  Status status() const;
  bool within() const;
};

// None of the runs has this figure.
bool is_absent(const SceneComparison& comparison, const Figure& figure);

// Throws what the engines throw, and MeasuredError where the record cannot be laid beside them. An
// interrupt ends it early with what there is.
SceneComparison compare_scene(const scene::Scene& scene, const CompareOptions& options);

}  // namespace rotorub
