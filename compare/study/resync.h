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

#include "compare/study/onsets.h"
#include "compare/study/trust.h"
#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct PredictedOnset : Onset {
  ContactResult native;
  double largest_impact = 0.0;  // N s, of the native impacts in it
  Status status = Status::kOk;  // of the prediction
  std::string message;
};

// What is compared of each contact.
struct ResyncFigure {
  const char* key;          // in JSON
  const char* label;        // in tables
  const char* unit;         // of the value as written
  double per_unit;          // written value = value in SI * per_unit
  const char* meaning;      // one sentence
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

// Half a sentence, as why() of trust.h.
std::string why(const Resync& resync, double tolerance);

}  // namespace rotorub
