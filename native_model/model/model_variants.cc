// Variants of a model for other questions: without a part, or driven by the recorded commands of
// another run.

#include <cassert>
#include <limits>
#include <utility>

#include "native_model/model/model.h"

namespace rotorub {

Model without_coils(Model model) {
  assert(model.layout.control_states == 0);
  const int kept = model.layout.coil();
  model.layout.coils = 0;
  for (AuxiliaryBearing& bearing : model.auxiliary) bearing.coil = kAbsent;
  for (auto* vector :
       {&model.mass, &model.stiffness, &model.damping, &model.gravity_mass, &model.q0, &model.v0}) {
    vector->conservativeResize(kept);
  }
  if (model.weight.size() > 0) model.weight.conservativeResize(kept);
  if (model.pull.size() > 0) model.pull.conservativeResize(kept);
  return model;
}

Model with_ideal_actuator(Model model) {
  model = without_coils(std::move(model));
  for (AuxiliaryBearing& bearing : model.auxiliary) {
    bearing.magnets.reset();
    bearing.force_limit = std::numeric_limits<double>::infinity();
  }
  return model;
}

Model with_linear_feedback(Model model) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  for (StationFeedback& feedback : model.feedbacks) {
    feedback.law.current_limit = feedback.law.amplifier.voltage_limit = kNone;
    feedback.law.opposed = false;
  }
  return model;
}

Model without_offsets(Model model) {
  for (StationFilm& film : model.films) film.law.offset_x = film.law.offset_y = 0.0;
  if (model.pull.size() > 0) {
    model.weight -= model.pull;
    model.pull.resize(0);
  }
  return model;
}

Model without_controller(Model model) {
  assert(model.layout.control_states == 0);
  for (AuxiliaryBearing& bearing : model.auxiliary) {
    bearing.controller.reset();
    bearing.loop.reset();
  }
  return model;
}

Model replayed(Model model, std::shared_ptr<const CommandRecord> commands) {
  if (!commands) return model;
  model = without_controller(std::move(model));
  model.first().recorded = std::move(commands);
  return model;
}

}  // namespace rotorub
