// Resync: at every onset of contact in a MuJoCo run, the native model restarts from MuJoCo's state
// one step earlier and predicts that contact with `event`, under the commands of MuJoCo's
// actuators. Errors of earlier contacts therefore do not affect later ones.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/study/trust.h"
#include "native_model/control/command_record.h"
#include "native_model/model/model.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {

inline constexpr int kShortestFlight = 10;  // steps without an impulse

// The result of one contact from its onset.
struct ContactResult {
  double impulse = 0.0;         // N s, total normal impulse, >= 0
  double window_impulse = 0.0;  // N s, largest within 20 steps (ImpulseWindow)
  double duration = 0.0;  // s, from first touch to the last force; 0 for a single rigid impact
  // m/s, gap rate after the first impact, or when the force of a soft contact first ends; else 0
  double rebound = 0.0;
};

struct Onset {
  State before;  // one step before the step of first contact; native layout
  // s, time of the impact, or when the gap of `before` closes for a soft contact
  double touch = 0.0;
  double closing = 0.0;  // m/s, approach speed there, > 0
  double end = 0.0;      // s, end of the contact
  bool lasts = false;    // until the end of the run
  ContactResult mujoco;
};

// Finds the onsets of contact while a MuJoCo run proceeds: the state just before each, and the
// result of the contact that follows. Several auxiliary bearings count as one contact, whose
// impulse is the sum of theirs.
//
// An onset is the first impulse after a free phase of at least kShortestFlight steps; a start in
// contact is not an onset. The contact lasts until half-way through the next such phase (or to the
// end of the run), so that bounces with shorter flights belong to it. Ending half-way makes two
// sides whose flights differ slightly count the same bounces.
class OnsetWatch {
 public:
  // model: the scene's, including coils; it must outlive this.
  explicit OnsetWatch(const Model& model)
      : model_(&model), had_force_(model.auxiliary.size(), false) {}

  void step(const WatchedStep& step);
  // Ends the last contact. end: of the run, s.
  std::vector<Onset> finish(double end);
  // First impulses after a flight that are not onsets because the rotor still touched the ring one
  // step earlier or did not approach any ring. This can happen with soft contacts.
  int left_out() const { return left_out_; }

 private:
  void begin_contact(const WatchedStep& step);
  void add(const WatchedStep& step);
  void find_rebound(const WatchedStep& step);
  bool flew() const { return flight_ >= kShortestFlight; }

  const Model* model_;
  std::vector<Onset> onsets_;
  State before_;                 // of the previous step
  ImpulseWindow window_;         // over the last onset's contact
  std::vector<bool> had_force_;  // in the previous step, of each auxiliary bearing
  bool open_ = false;            // the last onset's contact is in progress
  bool rebounded_ = false;       // its rebound is known
  double last_force_ = 0.0;      // s
  int flight_ = 0;               // steps without an impulse
  int left_out_ = 0;
};

struct PredictedOnset : Onset {
  ContactResult native;
  double largest_impact = 0.0;  // N s, largest native impact
  Status status = Status::kOk;  // of the prediction
  std::string message;
};

struct Resync;

// A figure that is compared for each contact.
struct ResyncFigure : FigureText {
  const char* relative_to;  // half a sentence: the value that a difference is relative to
  double ContactResult::*value;
  double (*scale)(const PredictedOnset&, const Resync& all);  // that value, SI; > 0 after a contact
};
std::span<const ResyncFigure> resync_figures();

// The differences in one figure over all onsets, relative to the figure's scale.
struct ResyncRow {
  const ResyncFigure* figure = nullptr;
  double native = 0.0, mujoco = 0.0;  // SI, means over the onsets
  double bias = 0.0;  // (sum of MuJoCo's values - sum of native values) / sum of native values
  double median = 0.0, ninetieth = 0.0, worst = 0.0;  // of the absolute differences
  double worst_signed = 0.0;                          // the worst one with its sign
  double worst_time = 0.0;                            // s, touch of the worst one
  FigureVerdict verdict = FigureVerdict::kNotJudged;  // judges the worst difference
};

struct Resync {
  std::vector<PredictedOnset> onsets;
  int left_out = 0;             // see OnsetWatch
  int failed = 0;               // number of failed predictions; they are left out of the rows
  std::string failure;          // message of the first failure
  bool touches = false;         // whether MuJoCo's run has any normal impulse
  std::vector<ResyncRow> rows;  // in the order of resync_figures(); empty without an onset
  double largest_impact = 0.0;  // N s, largest native impact
  // kYes: the worst onset of every figure is within the tolerance, or there is no contact at all.
  // kAveragesOnly: the means over the onsets are within (the bias of the impulse and the mean error
  // of the duration). kNo: they are not, or a prediction failed. kUndecidable: there is contact but
  // no onset.
  Trust trust = Trust::kUndecidable;
};

// Predicts the contact of each onset. step: of the MuJoCo run, s; the window of the largest impulse
// is 20 steps. commands: null without a controller.
std::vector<PredictedOnset> predict(const scene::Scene& scene, const std::vector<Onset>& onsets,
                                    std::shared_ptr<const CommandRecord> commands, double step,
                                    const std::function<void(double)>& progress = {},
                                    const std::atomic<bool>* interrupt = nullptr);

// The distributions over the onsets and the verdict.
Resync judge_resync(std::vector<PredictedOnset> onsets, bool touches, double tolerance);

}  // namespace rotorub
