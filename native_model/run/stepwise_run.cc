#include "native_model/run/stepwise_run.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

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

struct StepwiseRun::Saved {
  std::shared_ptr<const EventIntegrator::Moving> moving;
  Recorder recorder;
  std::vector<double> given, taken, values;
  double t, end, impacts;
  bool new_inputs, event_waits, known;
};

StepwiseRun::StepwiseRun(const scene::Scene& scene)
    : model_(with_inputs(checked(scene))), recorder_(model_, {}), integrator_(model_) {
  find_outputs();
  given_.assign(inputs_.size(), 0.0);
  begin(scene.run.end);
}

void StepwiseRun::add_vector(const std::string& name, const char* unit,
                             const std::string& meaning) {
  for (const char* axis : {"x", "y"})
    inputs_.push_back({name + "_" + axis, unit, meaning + " along " + axis});
}

Model StepwiseRun::with_inputs(const scene::Scene& scene) {
  Model model = prepare(scene);
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    AuxiliaryBearing& at = model.auxiliary[k];
    if (!at.moves() || !is_left_to_others(scene.auxiliary[k].controller)) continue;
    at.controller.reset();
    at.loop.reset();
    auto record = std::make_shared<CommandRecord>();
    at.recorded = record;
    commands_.emplace_back(k, std::move(record));
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
    auto told = std::make_shared<std::vector<double>>(2 * sampler.bearings.size());
    sampler.library = std::make_shared<const MagneticLibrary>(told);
    currents_.push_back(std::move(told));
    for (const std::size_t k : sampler.bearings)
      add_vector(of_bearing(model.feedbacks[k], "command"), "A",
                 "control current of the magnetic bearing, commanded for its next sample,");
  }
  first_load_ = model.forces.size();
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
  if (given_[input] == value) return;
  given_[input] = value;
  new_inputs_ = true;
}

void StepwiseRun::give_inputs() {
  const double* from = given_.data();
  const auto next = [&from] {
    const Eigen::Vector2d pair(from[0], from[1]);
    from += 2;
    return pair;
  };
  for (auto& [k, record] : commands_) {
    const AuxiliaryBearing& at = model_.auxiliary[k];
    const Eigen::Vector2d asked = next();
    *record = {};
    record->add(0.0, at.magnets ? Eigen::Vector2d(asked.cwiseMin(at.magnets->current_limit)
                                                      .cwiseMax(-at.magnets->current_limit))
                     : std::isinf(at.force_limit) ? asked
                                                  : limited(asked, at.force_limit));
  }
  for (const auto& told : currents_) {
    std::copy_n(from, told->size(), told->begin());
    from += told->size();
  }
  for (std::size_t k = first_load_; k < model_.forces.size(); ++k) model_.forces[k].vector = next();
  taken_ = given_;
  new_inputs_ = false;
}

void StepwiseRun::begin(double end) {
  give_inputs();
  end_ = end;
  t_ = impacts_ = 0.0;
  event_waits_ = known_ = false;
  recorder_ = Recorder(model_, {});
  integrator_.begin(initial_state(model_), end_, recorder_);
  count_impacts();
}

// Counts the impacts since the last call, which emptied the recorder.
void StepwiseRun::count_impacts() {
  for (const Impact& impact : recorder_.finish(t_).impacts)
    impacts_ += impact.gap_rate_before < kCountedGapRate ? 1.0 : 0.0;
}

// Applies new inputs at the present time and discards what was computed beyond it.
bool StepwiseRun::take_inputs() {
  if (!new_inputs_) return good();
  known_ = false;
  integrator_.cut(t_, [this] { give_inputs(); });
  return good();
}

bool StepwiseRun::pass_event() {
  if (!event_waits_) return good();
  event_waits_ = known_ = false;
  integrator_.pass();
  count_impacts();
  return good();
}

bool StepwiseRun::advance(double to, bool events) {
  if (!pass_event() || !take_inputs()) return false;
  known_ = false;
  if (to > end_) {
    end_ = std::max(to, 2.0 * end_);
    integrator_.put_off_end(end_);
  }
  t_ = to;
  while (integrator_.now() < to) {
    if (!integrator_.look_ahead()) return false;
    if (integrator_.stretch_end() > to) return true;
    if (events && integrator_.ends_in_event()) {
      t_ = integrator_.stretch_end();
      event_waits_ = true;
      return true;
    }
    integrator_.pass();
    count_impacts();
    if (!good()) return false;
  }
  return true;
}

const std::vector<double>& StepwiseRun::now() {
  if (!event_waits_) take_inputs();
  if (!known_) put(integrator_.now() < t_ ? integrator_.within(t_) : integrator_.here());
  known_ = true;
  return values_;
}

void StepwiseRun::put(const Snapshot& at) {
  for (Column& column : row_) column.values.clear();
  put_row(model_, t_, at, row_);
  values_.clear();
  for (const Column& column : row_) {
    if (column.name != "t") values_.push_back(column.values.front());
  }
  for (const StationFeedback& bearing : model_.feedbacks) {
    const auto deflection =
        equations::at_station(model_.layout.modes, bearing.sensor_shape(), at.q);
    values_.insert(values_.end(), {deflection.x, deflection.y});
  }
  for (std::size_t k = 0; k < model_.auxiliary.size(); ++k) {
    if (model_.auxiliary[k].contact) values_.push_back(integrator_.normal_impulse(at, k));
  }
  values_.push_back(impacts_);
}

std::shared_ptr<const StepwiseRun::Saved> StepwiseRun::save() const {
  return std::make_shared<const Saved>(Saved{integrator_.save(), recorder_, given_, taken_, values_,
                                             t_, end_, impacts_, new_inputs_, event_waits_,
                                             known_});
}

// The integrator's observer keeps writing to the same recorder.
void StepwiseRun::restore(const Saved& saved) {
  given_ = saved.taken;
  give_inputs();
  given_ = saved.given;
  new_inputs_ = saved.new_inputs;
  integrator_.restore(*saved.moving);
  recorder_ = saved.recorder;
  values_ = saved.values;
  t_ = saved.t;
  end_ = saved.end;
  impacts_ = saved.impacts;
  event_waits_ = saved.event_waits;
  known_ = saved.known;
}

}  // namespace rotorub
