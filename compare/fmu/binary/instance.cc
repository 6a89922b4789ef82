#include "compare/fmu/binary/instance.h"

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "compare/fmu/names.h"
#include "native_model/control/library.h"
#include "native_model/scene/reader.h"

namespace rotorub::fmi {
namespace {

scene::Scene scene_in(const std::filesystem::path& resources, const std::string& token) {
  set_scene_libraries(SceneLibraries::kLeftOut);
  scene::Scene scene = scene::read_scene(resources / kSceneFile);
  if (token_of(scene) != token)
    throw std::runtime_error("the token " + token + " is of another scene than " +
                             (resources / kSceneFile).string() + ", whose is " + token_of(scene));
  return scene;
}

using Kept = std::shared_ptr<const StepwiseRun::Saved>;

}  // namespace

Instance::Instance(const std::filesystem::path& resources, const std::string& token, Log log)
    : log_(std::move(log)),
      scene_(scene_in(resources, token)),
      run_(scene_),
      stop_(scene_.run.end) {}

template <class Number>
Status Instance::get(const ValueReference* of, std::size_t count, Number* values) {
  if (initializing_ && changed_ && !begin_anew()) return refuse(run_.message());
  const std::size_t inputs = run_.inputs().size(), outputs = run_.outputs().size();
  constexpr bool whole = std::is_integral_v<Number>;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = of[i];
    if (at <= inputs && !whole) {
      values[i] = static_cast<Number>(at == 0 ? run_.time() : run_.input(at - 1));
    } else if (at > inputs && at <= inputs + outputs &&
               run_.outputs()[at - 1 - inputs].whole == whole) {
      values[i] = static_cast<Number>(run_.now()[at - 1 - inputs]);
    } else {
      return refuse("value reference " + std::to_string(at) + " is of no variable of this type");
    }
  }
  return run_.status() == rotorub::Status::kOk ? kOK : refuse(run_.message());
}
template Status Instance::get(const ValueReference*, std::size_t, double*);
template Status Instance::get(const ValueReference*, std::size_t, std::int32_t*);

Status Instance::set(const ValueReference* of, std::size_t count, const double* values) {
  for (std::size_t i = 0; i < count; ++i) {
    if (of[i] < 1 || of[i] > run_.inputs().size())
      return refuse("value reference " + std::to_string(of[i]) + " is of no input");
    if (!std::isfinite(values[i]))
      return refuse("input " + run_.inputs()[of[i] - 1].name + " is not finite");
    run_.set_input(of[i] - 1, values[i]);
    changed_ = true;
  }
  return kOK;
}

bool Instance::begin_anew() {
  run_.begin(stop_);
  changed_ = false;
  return run_.status() == rotorub::Status::kOk;
}

Status Instance::enter_initialization(double start, bool has_stop, double stop) {
  if (start != 0.0) return refuse("a scene begins at t = 0; set the start time to 0");
  if (has_stop && !(stop > 0.0)) return refuse("the stop time must be above 0");
  if (has_stop) stop_ = stop;
  initializing_ = true;
  return begin_anew() ? kOK : refuse(run_.message());
}

Status Instance::exit_initialization() {
  if (!initializing_) return refuse("initialization has not been entered");
  const bool good = !changed_ || begin_anew();
  initializing_ = false;
  return good ? kOK : refuse(run_.message());
}

Status Instance::reset() {
  for (std::size_t i = 0; i < run_.inputs().size(); ++i) run_.set_input(i, 0.0);
  stop_ = scene_.run.end;
  initializing_ = false;
  return begin_anew() ? kOK : refuse(run_.message());
}

Status Instance::do_step(double from, double length, bool events) {
  if (initializing_) return refuse("initialization has not been left");
  constexpr double kSame = 1e-9;  // relative to the step
  if (!(length > 0.0)) return refuse("the communication step must be above 0");
  if (std::abs(from - run_.time()) > kSame * length)
    return refuse("a step from t = " + std::to_string(from) +
                  " s is asked for, and the plant is at t = " + std::to_string(run_.time()) + " s");
  return run_.advance(from + length, events) ? kOK : refuse(run_.message());
}

Status Instance::pass_event() { return run_.pass_event() ? kOK : refuse(run_.message()); }

Status Instance::save(void** state) const {
  if (*state == nullptr) *state = new Kept;
  *static_cast<Kept*>(*state) = run_.save();
  return kOK;
}

Status Instance::restore(const void* state) {
  if (state == nullptr) return refuse("no state is given");
  run_.restore(**static_cast<const Kept*>(state));
  return kOK;
}

void Instance::forget(void** state) {
  if (state == nullptr) return;
  delete static_cast<Kept*>(*state);
  *state = nullptr;
}

}  // namespace rotorub::fmi
