#include "native_model/run/stepwise_run.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "native_model/contact/impact.h"
#include "native_model/control/magnetic_library.h"
#include "native_model/model/equations.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/record.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {
namespace {

const scene::Scene& checked(const scene::Scene& scene) {
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const auto& contact = scene.auxiliary[k].contact;
    if (!contact) continue;
    for (const auto& [key, time] :
         {std::pair("contact.compression_time", contact->compression_time),
          std::pair("contact.expansion_time", contact->expansion_time)}) {
      if (time > 0.0)
        scene::refuse_at(scene, k, key,
                         "a run that is stepped from outside does not support impacts of finite "
                         "duration; set 0");
    }
  }
  return scene;
}

// True if the scene leaves the ring's command to the caller.
bool is_left_to_others(const std::optional<scene::Controller>& controller) {
  if (!controller || controller->kind == scene::ControllerKind::kLibrary) return true;
  return controller->kind == scene::ControllerKind::kPassive && controller->stiffness == 0.0 &&
         controller->damping == 0.0;
}

// Column name with the number of the magnetic bearing.
std::string of_bearing(const StationFeedback& bearing, const std::string& name) {
  return "bearing" + (bearing.number == 0 ? "" : std::to_string(bearing.number + 1)) + "_" + name;
}

}  // namespace

struct StepwiseRun::SavedState {
  std::shared_ptr<const EventIntegrator::Moving> moving;
  Recorder recorder;
  Now now;
};

StepwiseRun::StepwiseRun(const scene::Scene& scene)
    : model_(model_with_inputs(checked(scene))), recorder_(model_, {}), integrator_(model_) {
  find_outputs();
  now_.given.assign(inputs_.size(), 0.0);
  begin(scene.run.end);
}

void StepwiseRun::add_vector(const std::string& name, const char* unit,
                             const std::string& meaning) {
  for (const char* axis : {"x", "y"})
    inputs_.push_back({name + "_" + axis, unit, meaning + " along " + axis});
}

Model StepwiseRun::model_with_inputs(const scene::Scene& scene) {
  Model model = prepare(scene);
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    AuxiliaryBearing& at = model.auxiliary[k];
    if (!at.moves() || !is_left_to_others(scene.auxiliary[k].controller)) continue;
    at.controller.reset();
    at.loop.reset();
    auto record = std::make_shared<CommandRecord>();
    at.recorded = record;
    driven_.commands.push_back({k, std::move(record)});
    const std::string asked = column_of_contact(k, "command");
    if (!at.magnets) {
      add_vector(asked, "N", "commanded force of the actuator on the ring, in the fixed frame,");
      continue;
    }
    for (const char* axis : {"1", "2"})
      inputs_.push_back(
          {asked + "_" + axis, "A",
           std::string("commanded current of the actuator's axis ") + axis + ", without the bias"});
  }
  for (SampledFeedback& sampler : model.samplers) {
    if (!sampler.library) continue;
    auto currents = std::make_shared<std::vector<double>>(2 * sampler.bearings.size());
    sampler.library = std::make_shared<const MagneticLibrary>(currents);
    driven_.currents.push_back(std::move(currents));
    for (const std::size_t k : sampler.bearings)
      add_vector(of_bearing(model.feedbacks[k], "command"), "A",
                 "control current of the magnetic bearing, commanded for its next sample,");
  }
  driven_.first_load = model.forces.size();
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    model.forces.push_back({scene::ForceKind::kConstant,
                            0.0,
                            0.0,
                            0.0,
                            {0.0, 0.0},
                            0.0,
                            scene::kNever,
                            0.0,
                            model.auxiliary[k].shape});
    add_vector(column_of_contact(k, "load"), "N", "load on the rotor at the contact");
  }
  return model;
}

void StepwiseRun::find_outputs() {
  row_ = series_of(model_);
  for (const Column& column : row_) {
    if (column.name == "t") continue;
    const ColumnMeaning& means = series_column(column.name);
    const bool mode = means.name == "mode";
    outputs_.push_back(
        {column.name, column.unit,
         mode ? "state of the contact: 0 free, 1 slide, 2 stick" : std::string(means.meaning), mode,
         is_modal(means)});
  }
  for (const StationFeedback& bearing : model_.feedbacks) {
    for (const char* axis : {"x", "y"})
      outputs_.push_back(
          {of_bearing(bearing, std::string("sensor_") + axis), "m",
           std::string("deflection at the magnetic bearing's sensor along ") + axis});
  }
  for (std::size_t k = 0; k < model_.auxiliary.size(); ++k) {
    if (model_.auxiliary[k].contact)
      outputs_.push_back({column_of_contact(k, "normal_impulse"), "N s",
                          "normal impulse on the rotor so far, from lasting contact and impacts"});
  }
  outputs_.push_back({"impacts", "", "number of impacts so far, as the summary counts them", true});
}

void StepwiseRun::set_input(std::size_t input, double value) {
  if (now_.given[input] == value) return;
  now_.given[input] = value;
  now_.new_inputs = true;
}

void StepwiseRun::apply_inputs() {
  const double* from = now_.given.data();
  const auto next = [&from] {
    const Eigen::Vector2d pair(from[0], from[1]);
    from += 2;
    return pair;
  };
  for (const auto& [k, record] : driven_.commands) {
    const AuxiliaryBearing& at = model_.auxiliary[k];
    const Eigen::Vector2d asked = next();
    *record = {};
    record->add(0.0, at.magnets ? Eigen::Vector2d(asked.cwiseMin(at.magnets->current_limit)
                                                      .cwiseMax(-at.magnets->current_limit))
                     : std::isinf(at.force_limit) ? asked
                                                  : limited(asked, at.force_limit));
  }
  for (const auto& currents : driven_.currents) {
    std::copy_n(from, currents->size(), currents->begin());
    from += currents->size();
  }
  for (std::size_t k = driven_.first_load; k < model_.forces.size(); ++k)
    model_.forces[k].vector = next();
  now_.in_effect = now_.given;
  now_.new_inputs = false;
}

void StepwiseRun::begin(double end) {
  apply_inputs();
  now_.end = end;
  now_.t = now_.impacts = 0.0;
  now_.event_waits = now_.known = false;
  recorder_ = Recorder(model_, {});
  integrator_.begin(initial_state(model_), now_.end, recorder_);
  count_impacts();
}

// Counts the impacts since the last call, which emptied the recorder.
void StepwiseRun::count_impacts() {
  const std::vector<Impact> impacts = recorder_.finish({now_.t}).impacts;
  now_.impacts += static_cast<double>(std::ranges::count_if(impacts, counts));
}

// Applies new inputs at the present time and discards what was computed beyond it.
bool StepwiseRun::apply_new_inputs() {
  if (!now_.new_inputs) return good();
  now_.known = false;
  integrator_.cut(now_.t, [this] { apply_inputs(); });
  return good();
}

bool StepwiseRun::pass_event() {
  if (!now_.event_waits) return good();
  now_.event_waits = now_.known = false;
  integrator_.pass();
  count_impacts();
  return good();
}

bool StepwiseRun::advance(double to, bool events) {
  if (!pass_event() || !apply_new_inputs()) return false;
  now_.known = false;
  if (to > now_.end) {
    now_.end = std::max(to, 2.0 * now_.end);
    integrator_.extend_end(now_.end);
  }
  now_.t = to;
  while (integrator_.now() < to) {
    if (!integrator_.compute_stretch()) return false;
    if (integrator_.stretch_end() > to) return true;
    if (events && integrator_.ends_in_event()) {
      now_.t = integrator_.stretch_end();
      now_.event_waits = true;
      return true;
    }
    integrator_.pass();
    count_impacts();
    if (!good()) return false;
  }
  return true;
}

const std::vector<double>& StepwiseRun::now() {
  if (!now_.event_waits) apply_new_inputs();
  if (!now_.known)
    put(integrator_.now() < now_.t ? integrator_.within(now_.t) : integrator_.here());
  now_.known = true;
  return now_.values;
}

void StepwiseRun::put(const Snapshot& at) {
  for (Column& column : row_) column.values.clear();
  put_row(model_, now_.t, at, row_);
  now_.values.clear();
  for (const Column& column : row_) {
    if (column.name != "t") now_.values.push_back(column.values.front());
  }
  for (const StationFeedback& bearing : model_.feedbacks) {
    const auto deflection =
        equations::at_station(model_.layout.modes, bearing.sensor_shape(), at.q);
    now_.values.insert(now_.values.end(), {deflection.x, deflection.y});
  }
  for (std::size_t k = 0; k < model_.auxiliary.size(); ++k) {
    if (model_.auxiliary[k].contact) now_.values.push_back(integrator_.normal_impulse(at, k));
  }
  now_.values.push_back(now_.impacts);
}

std::shared_ptr<const StepwiseRun::SavedState> StepwiseRun::save() const {
  return std::make_shared<const SavedState>(SavedState{integrator_.save(), recorder_, now_});
}

// The integrator's observer keeps writing to the same recorder.
void StepwiseRun::restore(const SavedState& saved) {
  now_.given = saved.now.in_effect;
  apply_inputs();
  integrator_.restore(*saved.moving);
  recorder_ = saved.recorder;
  now_ = saved.now;
}

}  // namespace rotorub
