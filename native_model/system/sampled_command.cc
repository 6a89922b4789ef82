#include "native_model/system/sampled_command.h"

#include <algorithm>

#include "native_model/system/actuation.h"

namespace rotorub {

SampledCommand::SampledCommand(const Model& model, std::size_t bearing)
    : model_(&model), bearing_(bearing), memory_(memory_size(model, bearing)) {}

void SampledCommand::clear() {
  std::fill(memory_.begin(), memory_.end(), 0.0);
  failure_.clear();
}

Eigen::Vector2d SampledCommand::take(double t, const double* q, const double* v,
                                     const Eigen::Vector2d& held, const Eigen::Vector2d* shown) {
  const Model& m = *model_;
  Eigen::Vector2d current{0.0, 0.0};
  if (m.auxiliary[bearing_].magnets) {
    current = shown ? *shown : actuator_state(m, q, v, held, bearing_).current;
  }
  try {
    return control_sample(m, t, q, v, current, memory_.data(), bearing_);
  } catch (const ControllerError& error) {
    if (failure_.empty()) failure_ = error.what();
    return held;
  }
}

std::array<double, kMostOutputs> SampledCommand::outputs() const {
  std::array<double, kMostOutputs> values{};
  if (!memory_.empty()) {
    std::copy_n(ControlLoop::outputs(memory_.data()), values.size(), values.begin());
  }
  return values;
}

std::size_t SampledCommand::memory_size(const Model& model, std::size_t bearing) {
  const auto& loop = model.auxiliary[bearing].loop;
  return loop ? loop->memory_size() : 0;
}

void SampledCommand::save(double* to) const { std::copy(memory_.begin(), memory_.end(), to); }

void SampledCommand::restore(const double* from) {
  std::copy_n(from, memory_.size(), memory_.begin());
  failure_.clear();
}

}  // namespace rotorub
