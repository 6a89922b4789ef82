#include "native_model/integrate/command.h"

#include "native_model/control/sampling.h"
#include "native_model/system/actuation.h"

namespace rotorub {

const Eigen::Vector2d& Command::at(double t, const double* q, const double* v) {
  if (!model_->controller || t < model_->control_on) return held_;
  if (model_->sample_time > 0.0) {
    const double sample = sample_index(t, model_->sample_time);
    if (sample == last_sample_) return held_;
    last_sample_ = sample;
  }
  held_ = control_command(*model_, t, q, v);
  return held_;
}

void Command::save(double* to) const {
  to[0] = held_.x();
  to[1] = held_.y();
  to[2] = last_sample_;
}

void Command::restore(const double* from) {
  held_ = {from[0], from[1]};
  last_sample_ = from[2];
}

}  // namespace rotorub
