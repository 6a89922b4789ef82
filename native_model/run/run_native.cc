#include "native_model/run/run_native.h"

#include <algorithm>
#include <chrono>

#include "native_model/event/driver.h"
#include "native_model/model/model_checks.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/fixed_run.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

constexpr const char* kIntegratorNames[] = {"event", "verlet", "euler"};  // of scene::Integrator

Trajectory run_event(const Model& model, const scene::Run& run, const NativeOptions& options) {
  Recorder recorder(model, options.output_times.value_or(output_times(run)),
                    kWindowSteps * run.step);
  EventParameters settings;
  if (options.event) {
    settings = *options.event;
  } else {
    // The bins of the mean force are as wide as a fixed step, so that peaks are comparable, but not
    // so many that they take longer than the run.
    constexpr double kMostBins = 1e7;
    settings.force_bin = std::max(options.step.value_or(run.step), run.end / kMostBins);
  }
  EventIntegrator integrator(model, settings);
  return recorder.finish(
      integrator.run(initial_state(model), run.end, recorder, options.progress, options.interrupt));
}

}  // namespace

Trajectory run_native(const scene::Scene& scene, const NativeOptions& options) {
  const Model model = replayed(prepare(scene), options.commands);
  const double step = options.step.value_or(scene.run.step);
  const scene::Integrator integrator = options.integrator.value_or(scene.run.integrator);
  const std::vector<double>* times = options.output_times ? &*options.output_times : nullptr;
  const bool fixed = integrator != scene::Integrator::kEvent;
  check_run_size(scene, model, fixed ? std::optional(step) : std::nullopt, times);
  if (fixed) {
    refuse_compliance(scene, integrator);
    refuse_finite_impacts(scene, integrator == scene::Integrator::kVerlet
                                     ? FiniteImpacts::kUnsampled
                                     : FiniteImpacts::kNone);
    refuse_lag_with_several(scene, model);
  }
  const auto start = std::chrono::steady_clock::now();
  Trajectory out = fixed ? run_fixed(integrator, model, scene.run, step, options)
                         : run_event(model, scene.run, options);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  out.engine = "native";
  out.integrator = kIntegratorNames[static_cast<int>(integrator)];
  out.contact_model = model.is_compliant() ? "compliant" : "rigid";
  out.step = fixed ? step : 0.0;
  out.wall_s = wall.count();
  return out;
}

}  // namespace rotorub
