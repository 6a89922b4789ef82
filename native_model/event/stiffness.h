// An explicit step cannot be longer than the fastest decay of the system allows, however little is
// left of it. Such a system is stiff, and a run of it may take days: this tells in time, and by
// what.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "native_model/event/smooth_step.h"

namespace rotorub {

class StiffnessWatch {
 public:
  StiffnessWatch(const Model& model, const EventParameters& parameters)
      : model_(&model), parameters_(&parameters) {}

  void begin() { steps_ = 0, stiff_ = 0, smooth_ = 0; }
  // After every accepted step, which has come to t (s) on its way to `end`: why the run is given
  // up. Empty where it is not: its steps are as long as its motion allows, or there are no more
  // than parameters.most_stiff_steps to go.
  std::optional<std::string> look(double t, double end, const SmoothStep& step);

 private:
  const Model* model_;
  const EventParameters* parameters_;
  std::int64_t steps_ = 0;
  std::int64_t begun_ = 0;  // steps_ and
  double since_ = 0.0;      // time, s, at the first of the stiff ones
  int stiff_ = 0, smooth_ = 0;
};

}  // namespace rotorub
