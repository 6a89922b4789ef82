// The instants at which the right-hand side is not smooth: switched loads, breaks and samples of
// controllers, and jumps of recorded commands. Steps end there.
#pragma once

#include <vector>

#include "native_model/model/model.h"

namespace rotorub {

class Schedule {
 public:
  // The model must outlive this object.
  explicit Schedule(const Model& model) : model_(&model) {}

  void begin(double start, double end);  // s
  // For a run that continues beyond its previous end: finds the breaks anew and keeps the samples.
  void find_breaks(double start, double end);
  // The first such instant after t.
  double next(double t) const;
  // Call it once at each instant t of next(): true if the controller of this auxiliary bearing must
  // be sampled now.
  bool sample_due(std::size_t bearing, double t);
  // The same for a control of magnetic bearings (Model::samplers).
  bool feedback_due(std::size_t sampler, double t);

 private:
  const Model* model_;
  std::vector<double> breaks_;         // s, ascending; the last one is the end
  std::vector<double> next_sample_;    // sample index, one per bearing
  std::vector<double> next_feedback_;  // sample index, one per control of magnetic bearings
};

}  // namespace rotorub
