// Resync: at every onset of contact of a MuJoCo run the native model restarts from MuJoCo's state a
// step before it, under the commands that MuJoCo's actuators were given, and predicts that contact
// by `event`. No error of an earlier contact is in a later one's.
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

// One contact, from its onset on.
struct ContactResult {
  double impulse = 0.0;         // N s, normal, of all of it, >= 0
  double window_impulse = 0.0;  // N s, largest within 20 steps (ImpulseWindow)
  double duration = 0.0;        // s, from the touch to the last force; 0 for a single rigid impact
  double rebound = 0.0;  // m/s, gap rate after the first impact; of a soft contact where its force
                         // first ends; 0 where it does not
};

struct Onset {
  State before;          // a step before the one that meets the ring; the native layout
  double touch = 0.0;    // s, the impact, or of a soft contact when the gap of `before` closes
  double closing = 0.0;  // m/s, of the gap there, > 0
  double end = 0.0;      // s, of the contact
  bool lasts = false;    // to the run's end
  ContactResult mujoco;
};

// The onsets of contact in a MuJoCo run, as its steps go by: the state just before each, and what
// the contact that follows comes to.
//
// An onset is the first impulse after a free phase of at least kShortestFlight steps: a start on
// the circle is none. Its contact lasts until half-way through the next such phase (or to the run's
// end): bounces with shorter flights belong to it, and half-way two sides whose flights differ a
// little count the same bounces.
class OnsetWatch {
 public:
  // `model`: the scene's, coils included; it must outlive this.
  explicit OnsetWatch(const Model& model) : model_(&model) {}

  void step(const WatchedStep& step);
  // Ends the last contact. `end`: s, of the run.
  std::vector<Onset> finish(double end);
  // First impulses after a flight that are no onsets: the rotor still lay in the ring a step
  // before, as a soft contact's can.
  int left_out() const { return left_out_; }

 private:
  void meet(const WatchedStep& step);
  void add(const WatchedStep& step);
  void part(const WatchedStep& step);
  bool flew() const { return flight_ >= kShortestFlight; }

  const Model* model_;
  std::vector<Onset> onsets_;
  State before_;             // of the step before
  ImpulseWindow window_;     // over the last onset's contact
  bool open_ = false;        // the last onset's contact is under way
  bool rebounded_ = false;   // its rebound is known
  double last_force_ = 0.0;  // s
  int flight_ = 0;           // steps without an impulse
  int left_out_ = 0;
};

struct PredictedOnset : Onset {
  ContactResult native;
  double largest_impact = 0.0;  // N s, of the native impacts in it
  Status status = Status::kOk;  // of the prediction
  std::string message;
};

// What is compared of each contact.
struct ResyncFigure : FigureText {
  const char* relative_to;  // half a sentence: what a difference is a share of
  double ContactResult::*value;
};
std::span<const ResyncFigure> resync_figures();

// The differences in one figure over all onsets, as shares of what it is relative to.
struct ResyncRow {
  const ResyncFigure* figure = nullptr;
  double native = 0.0, mujoco = 0.0;  // SI, means over the onsets
  double bias = 0.0;                  // (sum of MuJoCo's - sum of native) / sum of native
  double median = 0.0, ninetieth = 0.0, worst = 0.0;  // of the size
  double worst_signed = 0.0;                          // of the worst one
  double worst_time = 0.0;                            // s, touch of the worst one
  FigureVerdict verdict = FigureVerdict::kNotJudged;  // by the worst
};

struct Resync {
  std::vector<PredictedOnset> onsets;
  int left_out = 0;             // see OnsetWatch
  int failed = 0;               // predictions that did not end well: no part of the rows
  std::string failure;          // of the first of them
  bool touches = false;         // MuJoCo's run has a normal impulse at all
  std::vector<ResyncRow> rows;  // as resync_figures(); empty without an onset
  double largest_impact = 0.0;  // N s, of the native ones
  // kYes: the worst onset of every figure is within. kAveragesOnly: the means over the onsets are
  // (bias of impulse, of duration). kUndecidable: there was contact, but no onset. Nothing that
  // touches is kYes.
  Trust trust = Trust::kUndecidable;
};

// Predicts each of `onsets` in place of its MuJoCo run. `step`: s, of that run: 20 of them are the
// window of the largest impulse. `commands`: null without a controller.
std::vector<PredictedOnset> predict(const scene::Scene& scene, const std::vector<Onset>& onsets,
                                    std::shared_ptr<const CommandRecord> commands, double step,
                                    const std::function<void(double)>& progress = {},
                                    const std::atomic<bool>* interrupt = nullptr);

// The distributions and their verdict.
Resync judge_resync(std::vector<PredictedOnset> onsets, bool touches, double tolerance);

}  // namespace rotorub
