#include "native_model/model/magnetic_bearings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "native_model/control/magnetic_library.h"
#include "native_model/rotor/rotor_modes.h"

namespace rotorub {
namespace {

using scene::ControlForm;

// A sampled control keeps the states of its law in the sampler.
bool integrates(const scene::BearingControl& c) { return !c.sampled() && c.integral > 0.0; }
bool filters(const scene::BearingControl& c) { return !c.sampled() && c.derivative_lag > 0.0; }

LinearController law_of(const scene::BearingControl& c) {
  if (c.form == ControlForm::kTransferFunction)
    return transfer_function(c.numerator, c.denominator);
  if (c.form == ControlForm::kStateSpace) {
    const scene::ControlMatrices& m = c.matrices;
    return state_space(m.state, m.input, m.output, m.feedthrough, 1);
  }
  return sampled_pid({c.proportional, c.integral, c.derivative, c.derivative_lag}, c.sample_time);
}

// The law of [magnetic_control].
void fill_law(const scene::Scene& scene, SampledFeedback& shared) {
  const auto ports = static_cast<Eigen::Index>(2 * shared.bearings.size());
  if (scene.magnetic_control->by_library()) {
    shared.library = std::make_shared<const MagneticLibrary>(scene, shared.bearings);
    shared.law = no_law(static_cast<Eigen::Index>(shared.library->state_size()), ports);
    return;
  }
  const scene::ControlMatrices& m = scene.magnetic_control->matrices;
  shared.law = state_space(m.state, m.input, m.output, m.feedthrough, ports);
}

// Number of coordinates; MuJoCo stores them in pairs.
int memory_of(const SampledFeedback& s) {
  const auto states = static_cast<int>(s.law.states()), ports = static_cast<int>(s.law.ports());
  return ports * (1 + s.delay) + states + states % 2;
}

// next: first free coordinate.
void add_magnetic_bearing(const scene::Scene& scene, std::size_t number, const MagnetShapes& shapes,
                          int& next, Model& model) {
  const scene::MagneticBearing& bearing = scene.magnetic_bearings[number];
  const double k = bearing.pull();
  if (bearing.is_spring()) return model.springs.push_back({shapes.station, {-k, -k}});
  const scene::BearingControl c = bearing.control.value_or(scene::BearingControl{});
  StationFeedback feedback{
      .shape = shapes.station,
      .law = {.negative_stiffness = k,
              .force_per_current = bearing.force_per_current(),
              .proportional = c.proportional,
              .derivative = c.derivative,
              .current_limit = bearing.current_limit(),
              .integral = c.integral,
              .derivative_lag = c.derivative_lag},
      .works = {c.works_from > 0.0 ? c.works_from : -scene::kNever, c.fails_at, c.returns_at},
      .sensor = shapes.sensor,
      .number = number,
      .controlled = bearing.control.has_value()};
  if (bearing.kind == scene::MagnetKind::kElectromagnet) {
    feedback.law.opposed = true;
    feedback.law.magnets = {bearing.force_constant, bearing.bias_current, bearing.air_gap};
  }
  const auto state = [&](double lag) {
    if (lag > 0.0) model.damping.segment<2>(next) = model.mass.segment<2>(next) / lag;
    return std::exchange(next, next + 2);
  };
  if (integrates(c)) feedback.states.stored = state(0.0);
  if (filters(c)) feedback.states.filtered = state(c.derivative_lag);
  if (bearing.amplifier) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    const scene::Amplifier& a = *bearing.amplifier;
    feedback.law.amplifier = {1.0 / a.bandwidth, kNone, a.voltage_limit,
                              a.inductance > 0.0 ? a.inductance : 1.0, a.resistance};
    feedback.states.current = state(1.0 / a.bandwidth);
  }
  // The linear spring always acts, as part of the modes or as a separate spring, and the law
  // subtracts it (`linear_spring`).
  feedback.law.linear_spring = feedback.law.stiffness();
  const double rest = feedback.law.linear_spring - magnetic_support(scene, bearing).modal_spring;
  if (rest != 0.0) model.springs.push_back({shapes.station, {rest, rest}});
  model.feedbacks.push_back(std::move(feedback));
}

}  // namespace

std::vector<SampledFeedback> magnetic_samplers(const scene::Scene& scene) {
  const auto delayed = [](const auto& control) {
    return static_cast<int>(std::lround(control.delay / control.sample_time));
  };
  std::vector<SampledFeedback> all;
  SampledFeedback shared;
  for (std::size_t k = 0; k < scene.magnetic_bearings.size(); ++k) {
    const auto& control = scene.magnetic_bearings[k].control;
    if (!control || !control->sampled()) continue;
    if (control->form == ControlForm::kShared) {
      shared.bearings.push_back(k);
    } else {
      all.push_back({on_both_axes(law_of(*control)), control->sample_time, delayed(*control), {k}});
    }
  }
  if (shared.bearings.empty()) return all;
  fill_law(scene, shared);
  shared.sample_time = scene.magnetic_control->sample_time;
  shared.delay = delayed(*scene.magnetic_control);
  all.push_back(std::move(shared));
  return all;
}

int feedback_states(const scene::Scene& scene, const std::vector<SampledFeedback>& samplers) {
  int count = 0;
  for (const scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    if (!bearing.control) continue;
    count += integrates(*bearing.control) ? 2 : 0;
    count += filters(*bearing.control) ? 2 : 0;
    count += bearing.amplifier ? 2 : 0;
  }
  for (const SampledFeedback& s : samplers) count += memory_of(s);
  return count;
}

void add_magnetic_bearings(const scene::Scene& scene, const std::vector<MagnetShapes>& shapes,
                           Model& model) {
  int next = model.layout.feedback_state();
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    add_magnetic_bearing(scene, k, shapes[k], next, model);
  }
  for (SampledFeedback& s : model.samplers) {
    s.command = next;
    s.state = next + static_cast<int>(s.law.ports()) * (1 + s.delay);
    next += memory_of(s);
    int port = s.command;
    for (std::size_t& bearing : s.bearings) {
      const auto at = std::find_if(model.feedbacks.begin(), model.feedbacks.end(),
                                   [&](const StationFeedback& f) { return f.number == bearing; });
      at->states.command = std::exchange(port, port + 2);
      bearing = static_cast<std::size_t>(at - model.feedbacks.begin());
    }
  }
}

}  // namespace rotorub
