#include "compare/fmu/binary/instance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "compare/fmu/names.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/reader.h"

namespace rotorub::fmi {
namespace {

scene::Scene scene_in(const std::filesystem::path& file, const std::string& token) {
  set_scene_libraries(SceneLibraries::kLeftOut);
  scene::Scene scene = scene::read_scene(file);
  if (token_of(scene) != token)
    throw std::runtime_error("the token " + token + " is of another scene than " + file.string() +
                             ", whose is " + token_of(scene));
  return scene;
}

std::vector<double> start_values(const std::vector<scene::Adjustable>& parameters) {
  std::vector<double> values;
  for (const scene::Adjustable& parameter : parameters) values.push_back(parameter.value);
  return values;
}

// "parameter contact.friction: must be >= 0"
std::string in_words(const scene::SceneError& error) {
  std::string words;
  for (const scene::Diagnostic& wrong : error.diagnostics())
    words += (words.empty() ? "parameter " : "; parameter ") + wrong.key + ": " + wrong.reason;
  return words;
}

bool same_names(const std::vector<StepwiseRun::Port>& a, const std::vector<StepwiseRun::Port>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return one.name == other.name; });
}

}  // namespace

struct Instance::Kept {
  std::shared_ptr<Plant> plant;
  std::shared_ptr<const StepwiseRun::SavedState> state;
};

Instance::Instance(const std::filesystem::path& resources, const std::string& token, Log log)
    : log_(std::move(log)), file_(resources / kSceneFile) {
  const scene::Scene scene = scene_in(file_, token);
  parameters_ = parameters_of(scene);
  values_ = start_values(parameters_);
  plant_ = std::make_shared<Plant>(scene, values_);
  stop_ = end_of_scene_ = scene.run.end;
}

std::shared_ptr<Instance::Plant> Instance::plant_with(const std::vector<double>& values) const {
  const std::vector<std::string> overrides = scene::overrides_to(parameters_, values);
  std::shared_ptr<Plant> plant;
  try {
    plant = std::make_shared<Plant>(scene::read_scene(file_, overrides), values);
  } catch (const scene::SceneError& error) {
    throw std::runtime_error(in_words(error));
  }
  if (!same_names(plant->run.inputs(), run().inputs()) ||
      !same_names(plant->run.outputs(), run().outputs()))
    throw std::runtime_error(
        "with these parameters the plant has other inputs or outputs; export another FMU with "
        "--set");
  for (std::size_t i = 0; i < run().inputs().size(); ++i) plant->run.set_input(i, run().input(i));
  return plant;
}

template <class Number>
Status Instance::get(const ValueReference* of, std::size_t count, Number* values) {
  if (initializing_ && changed_ && !begin_anew()) return refuse(run().message());
  const std::size_t inputs = run().inputs().size();
  const std::size_t parameters = 1 + inputs + run().outputs().size();
  constexpr bool whole = std::is_integral_v<Number>;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = of[i];
    if (at <= inputs && !whole) {
      values[i] = static_cast<Number>(at == 0 ? run().time() : run().input(at - 1));
    } else if (at > inputs && at < parameters && run().outputs()[at - 1 - inputs].whole == whole) {
      values[i] = static_cast<Number>(run().now()[at - 1 - inputs]);
    } else if (at >= parameters && at - parameters < values_.size() && !whole) {
      values[i] = static_cast<Number>(values_[at - parameters]);
    } else {
      return refuse("value reference " + std::to_string(at) + " is of no variable of this type");
    }
  }
  return run().status() == rotorub::Status::kOk ? kOK : refuse(run().message());
}
template Status Instance::get(const ValueReference*, std::size_t, double*);
template Status Instance::get(const ValueReference*, std::size_t, std::int32_t*);

Status Instance::set(const ValueReference* of, std::size_t count, const double* values) {
  const std::size_t inputs = run().inputs().size();
  const std::size_t parameters = 1 + inputs + run().outputs().size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = of[i];
    if (at >= parameters && at - parameters < values_.size()) {
      if (set_parameter(at - parameters, values[i]) != kOK) return kError;
      continue;
    }
    if (at < 1 || at > inputs)
      return refuse("value reference " + std::to_string(at) + " is of no input or parameter");
    if (!std::isfinite(values[i]))
      return refuse("input " + run().inputs()[at - 1].name + " is not finite");
    run().set_input(at - 1, values[i]);
    changed_ = true;
  }
  return kOK;
}

Status Instance::set_parameter(std::size_t parameter, double value) {
  const std::string name = "parameter " + parameters_[parameter].name();
  if (!std::isfinite(value)) return refuse(name + " is not finite");
  if (initialized_)
    return refuse(name + " is fixed while the simulation runs; set it during the initialization");
  values_[parameter] = value;
  changed_ = true;
  return kOK;
}

bool Instance::begin_anew() {
  if (plant_->parameters != values_) plant_ = plant_with(values_);
  run().begin(stop_);
  changed_ = false;
  return run().status() == rotorub::Status::kOk;
}

Status Instance::enter_initialization(double start, bool has_stop, double stop) {
  if (start != 0.0) return refuse("a scene begins at t = 0; set the start time to 0");
  if (has_stop && !(stop > 0.0)) return refuse("the stop time must be above 0");
  if (has_stop) stop_ = stop;
  initializing_ = true;
  return begin_anew() ? kOK : refuse(run().message());
}

Status Instance::exit_initialization() {
  if (!initializing_) return refuse("initialization has not been entered");
  const bool good = !changed_ || begin_anew();
  initializing_ = false;
  initialized_ = true;
  return good ? kOK : refuse(run().message());
}

Status Instance::reset() {
  for (std::size_t i = 0; i < run().inputs().size(); ++i) run().set_input(i, 0.0);
  values_ = start_values(parameters_);
  stop_ = end_of_scene_;
  initializing_ = initialized_ = false;
  return begin_anew() ? kOK : refuse(run().message());
}

Status Instance::do_step(double from, double length, bool events) {
  if (initializing_) return refuse("initialization has not been left");
  constexpr double kSame = 1e-9;  // relative to the step
  if (!(length > 0.0)) return refuse("the communication step must be above 0");
  if (std::abs(from - run().time()) > kSame * length)
    return refuse("a step from t = " + std::to_string(from) +
                  " s is asked for, and the plant is at t = " + std::to_string(run().time()) +
                  " s");
  return run().advance(from + length, events) ? kOK : refuse(run().message());
}

Status Instance::pass_event() { return run().pass_event() ? kOK : refuse(run().message()); }

Status Instance::save(void** state) const {
  if (*state == nullptr) *state = new Kept;
  *static_cast<Kept*>(*state) = {plant_, run().save()};
  return kOK;
}

Status Instance::restore(const void* state) {
  if (state == nullptr) return refuse("no state is given");
  const Kept& kept = *static_cast<const Kept*>(state);
  plant_ = kept.plant;
  values_ = plant_->parameters;
  run().restore(*kept.state);
  return kOK;
}

void Instance::forget(void** state) {
  if (state == nullptr) return;
  delete static_cast<Kept*>(*state);
  *state = nullptr;
}

}  // namespace rotorub::fmi
