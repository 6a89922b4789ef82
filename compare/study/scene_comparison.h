// One scene, run by the native model (with the scene's integrator) and by MuJoCo with each contact
// model, and everything derived from the differences.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/figures/contact_kind.h"
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

// The coupling between the two sides of a comparison.
enum class CompareMode {
  kLockstep,  // each side closes its own loop
  // The commands of MuJoCo's actuators drive the native side, so the difference comes from the
  // contact and not from the closed loop.
  kReplay,
  // At every onset of contact the native side restarts from MuJoCo's state and predicts that
  // contact. This is conclusive even for chaotic trajectories.
  kResync
};

const char* to_string(CompareMode mode);  // "lockstep", "replay", "resync"
// The mode of that name; asserts that it exists.
CompareMode compare_mode_of(const std::string& name);

class OwnMachine;  // compare/own/own_machine.h

// The contact model that decides unless another is requested.
inline constexpr scene::ContactModel kDefaultContact = scene::ContactModel::kRigid;
inline constexpr int kDefaultTwins = 20;

struct CompareOptions {
  CompareMode mode = CompareMode::kLockstep;
  double tolerance = 0.01;                        // share, for the judged figures
  scene::ContactModel contact = kDefaultContact;  // its verdict is the verdict of the comparison
  int twins = kDefaultTwins;  // >= 0, upper limit for the native run; the verdict may need fewer
  int jobs = 0;               // threads; 0: one per processor. The result does not depend on it
  // Determines the error from the modes left out if the rotor is in geometry form.
  bool modes_ladder = true;
  int timing_repeats = 3;   // >= 1, runs without recording; the engines take turns
  std::size_t impacts = 8;  // number of first impacts listed
  // If set, the scene is the twin of this user's machine, and MuJoCo runs the machine.
  std::shared_ptr<const OwnMachine> own;
  std::size_t rows = kRows;  // recorded at most: every step or every n-th step
  // A measured record to show beside the runs; null: none.
  std::shared_ptr<const MeasuredRecord> measured;
  AlignmentOptions alignment{};  // of the record
  // Called with the fraction of this scene done and what is running.
  std::function<void(double, const std::string&)> progress;
  const std::atomic<bool>* interrupt = nullptr;
};

// Cost over repeated runs without recording.
struct Timing {
  std::vector<double> us_per_step;  // one per run
  double median = 0.0, lowest = 0.0, highest = 0.0;
};

// One engine on the scene.
struct Side {
  std::string label;   // "native", "shadow", or of a ContactKind; empty: it was not run
  std::string engine;  // "native-verlet", "mujoco-coulomb"
  // solref of MuJoCo's contact at the comparison's step, as "0.02 1". Empty if it has no effect.
  std::string solref;
  Trajectory trajectory;  // rows dense enough for plots, at the scene's output times among others
  Metrics metrics;
  // In the order of figures(); only values for figures that are not split.
  std::vector<Extrapolation> limits;
  Timing timing;

  // Half a sentence on a run that ended early; empty if it ended well. A failing law has the same
  // long text in every run, which `cause` = false leaves out.
  std::string early_end(bool cause = true) const;
};

// One figure of a contact model compared with the native one.
struct FigureDifference : JudgedFigure {
  double floor = 0.0;         // largest |deviation| of a native twin
  double replay_floor = 0.0;  // see replay_floor(); a lower limit of the interval
  Split split;
};

// The native stepper at MuJoCo's step (comparison_runs.h).
struct ShadowColumn {
  std::optional<Side> side;           // label "shadow"
  std::string absent;                 // why there is none
  bool driven = false;                // by the commands of the MuJoCo run that decides
  std::vector<JudgedFigure> figures;  // in the order of figures(), compared with native
};

// MuJoCo with one contact model, compared with the native run.
struct ComparedModel {
  Side run;
  // In replay with commands: the native run under the commands of this run. Empty for the model
  // that decides, because its commands drive SceneComparison::native, and in every other mode.
  std::optional<Side> native;
  std::vector<FigureDifference> figures;  // in the order of figures()
  std::optional<Resync> resync;           // only in resync, where it determines the trust
  Divergence divergence;
  std::vector<ImpactPair> impacts;   // a: native
  Trust trust = Trust::kNo;          // kNo also if a run did not end well
  std::vector<std::string> reasons;  // sentences: why they differ, or that they agree

  const ContactKind& kind() const { return *contact_kind(run.label); }
  bool within() const { return trust == Trust::kYes; }
  std::vector<JudgedFigure> judged() const { return {figures.begin(), figures.end()}; }
};

struct SceneComparison {
  scene::Scene scene;
  bool own = false;                      // whether it is the twin of a user's own machine
  std::vector<std::string> twin_limits;  // sentences: what the twin leaves out
  // The largest of the twin's omissions if it exceeds the tolerance. Then no difference is certain
  // to come from the contact, and every verdict is undecidable. Otherwise empty.
  std::string omission;
  CompareMode mode = CompareMode::kLockstep;
  // True if a controller commands the actuator; otherwise replay equals lockstep.
  bool commands = false;
  double tolerance = 0.0;
  int twins = 0;          // of the native run, as many as were needed
  int decider_twins = 0;  // of the MuJoCo run that decides; 0 if the motion repeats itself
  Side native;
  std::vector<ComparedModel> models;  // the one that determines the exit code first
  ShadowColumn shadow;
  // If the scene's controller commands: the native run of the passive bearing, unless that run
  // fails.
  std::optional<Trajectory> uncontrolled;
  Divergence twin;                        // native compared with the twin that parts first
  std::optional<ModelError> model_error;  // empty if not requested
  std::optional<MeasuredRun> measured;    // empty if not requested
  bool interrupted = false;               // only the results of the runs that ended are set

  // The native run that a model is compared with.
  const Side& reference(const ComparedModel& model) const {
    return model.native ? *model.native : native;
  }
  bool decides(const ComparedModel& model) const { return &model == &models.front(); }
  // Native, then the runs of the models, as far as they were run.
  std::vector<const Side*> sides() const;
  // The worst status of the runs that decide: native and the first model's.
  Status status() const;
  bool within() const { return !models.empty() && models.front().within(); }
  // Whether all runs reached their end and none of them had a contact.
  bool is_untouched() const;
};

// True if none of the runs has this figure.
bool is_absent(const SceneComparison& comparison, const Figure& figure);
// Whether tables for people have a row for this figure: some run has it, and if nothing touches, it
// is not 0 in all runs.
bool is_shown(const SceneComparison& comparison, const Figure& figure);

// Throws what the engines throw, and MeasuredError if the record does not fit the runs. An
// interrupt ends it early with the results so far.
SceneComparison compare_scene(const scene::Scene& scene, const CompareOptions& options);

}  // namespace rotorub
