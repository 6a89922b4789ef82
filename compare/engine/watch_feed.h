// What a watch is given (step_watch.h), of what the engine has.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/engine/chunked_run.h"
#include "compare/engine/step_watch.h"
#include "native_model/system/model.h"

namespace rotorub {

class WatchFeed {
 public:
  // No watch: nothing is done. The model must outlive it.
  WatchFeed(const Model& model, double step, StepWatch watch);

  void begin(const double* q, const double* v);  // the state of t = 0
  // As MujocoRecord: the state at the step's end; of native steps that of its begin.
  void step(std::int64_t k, const double* q, const double* v, const StepResult& result);
  void native_step(std::int64_t k, const double* q, const double* v, const StepResult& result);

 private:
  void tell(std::int64_t k, const double* q, const double* v, double kick,
            const StepResult& result);

  const Model& model_;
  double h_;  // s
  StepWatch watch_;
  bool lags_;
  std::vector<double> q_, v_, mean_;
  Eigen::Vector2d current_{0.0, 0.0};
};

}  // namespace rotorub
