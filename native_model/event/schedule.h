// Instants at which the right-hand side is not smooth: switched loads, the controller's own, its
// samples, and the jumps of recorded commands. Steps end there.
#pragma once

#include <vector>

#include "native_model/model/model.h"

namespace rotorub {

class Schedule {
 public:
  // The model must outlive it.
  explicit Schedule(const Model& model) : model_(&model) {}

  void begin(double start, double end);  // s
  // Of a run that goes on beyond its end: samples are taken as they were to be.
  void find_breaks(double start, double end);
  // The first instant after t.
  double next(double t) const;
  // Once at each t reached: is the controller of this auxiliary bearing to be sampled now?
  bool sample_due(std::size_t bearing, double t);
  // The same of a control of magnetic bearings (Model::samplers).
  bool feedback_due(std::size_t sampler, double t);

 private:
  const Model* model_;
  std::vector<double> breaks_;         // s, ascending; the last is the end
  std::vector<double> next_sample_;    // index, of each bearing
  std::vector<double> next_feedback_;  // index, of each sampler of magnetic bearings
};

}  // namespace rotorub
