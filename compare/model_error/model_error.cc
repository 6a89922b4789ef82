#include "compare/model_error/model_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "compare/base/format.h"
#include "compare/base/in_parallel.h"
#include "compare/engine/engine.h"
#include "compare/figures/figure_text.h"
#include "compare/metrics/metrics.h"
#include "compare/metrics/rows.h"
#include "native_model/system/model.h"

namespace rotorub {
namespace {

// The scene with another number of modes. The native model reads no text: it is left as it is.
scene::Scene with_modes(scene::Scene scene, int modes) {
  scene::RotorGeometry& geometry = *scene.rotor.geometry;
  geometry.modes = modes;
  geometry.auto_modes = false;
  geometry.max_frequency.reset();
  // A start in modal coordinates says nothing of further modes: they start at rest.
  scene::Initial& start = scene.initial;
  for (auto* list : {&start.x, &start.y, &start.vx, &start.vy}) {
    if (!list->empty()) list->resize(static_cast<std::size_t>(modes), 0.0);
  }
  return scene;
}

Metrics run_with(const scene::Scene& scene, int modes, const ModelErrorParameters& parameters) {
  const scene::Scene rung = with_modes(scene, modes);
  RunRequest request;
  if (parameters.step > 0.0) request.step = parameters.step;
  request.output_times = dense_times(rung.run, kRows);
  request.interrupt = parameters.interrupt;
  const Trajectory t = native_engine(scene::Integrator::kEvent)->run(rung, request);
  if (t.status != Status::kOk) {
    throw std::runtime_error(fmt::format("{} ({})", rotorub::to_string(t.status), t.message));
  }
  return metrics(t, std::nullopt);
}

}  // namespace

std::vector<int> mode_ladder(int modes) {
  const int apart = std::max(2, (modes + 1) / 3);
  return {modes, modes + apart, modes + 2 * apart, modes + 3 * apart};
}

ModelError model_error(const scene::Scene& scene, const ModelErrorParameters& parameters) {
  ModelError error;
  if (!scene.rotor.geometry) {
    error.reason = scene.rotor.assembled
                       ? "a machine of your own: its joints are all that is known of it"
                       : "modal form: the scene gives its modes, and no others are known";
    return error;
  }
  if (!scene.first().contact) {
    error.reason = "no contact: nothing is judged";
    return error;
  }
  error.modes = mode_ladder(make_model(scene).layout.modes);
  const std::size_t rungs = error.modes.size();
  std::vector<Metrics> found(rungs);
  std::vector<std::string> failures(rungs);
  // The dearest first.
  in_parallel(rungs, parameters.interrupt, parameters.progress, [&](std::size_t k) {
    const std::size_t rung = rungs - 1 - k;
    try {
      found[rung] = run_with(scene, error.modes[rung], parameters);
    } catch (const std::exception& failure) {
      failures[rung] = failure.what();
    }
  });
  if (parameters.interrupt && parameters.interrupt->load()) error.reason = "interrupted";
  for (std::size_t k = 0; k < rungs && error.reason.empty(); ++k) {
    if (failures[k].empty()) continue;
    error.reason = fmt::format("no run with {} modes: {}", error.modes[k], failures[k]);
  }
  if (!error.reason.empty()) return error;

  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    if (!f.is_judged()) continue;
    std::vector<double> values;
    for (const Metrics& m : found) values.push_back(f.value(m));
    // No run has it, or it is 0 in all.
    if (std::all_of(values.begin(), values.end(),
                    [](double v) { return std::isnan(v) || v == 0.0; }))
      continue;
    const double spread = i < parameters.spread.size() ? parameters.spread[i] : 0.0;
    error.figures.push_back(figure_limit(f, error.modes, values, parameters.tolerance, spread));
  }
  return error;
}

std::string model_error_table(const ModelError& error, const std::string& lead) {
  constexpr int kLabel = 19, kValue = 9;
  if (!error.reason.empty()) return wrapped(lead, "modes kept: not known: " + error.reason);
  std::string text = fmt::format("{}{:<{}}", lead, "bending modes kept", kLabel), left;
  for (const int n : error.modes) text += fmt::format("{:>{}}", n, kValue);
  text += fmt::format("  over the modes; off by\n");
  for (const FigureLimit& f : error.figures) {
    text += fmt::format("{}{:<{}}", lead, f.figure->label, kLabel);
    for (const double v : f.values)
      text += fmt::format("{:>{}}", figure_value(*f.figure, v), kValue);
    text += fmt::format("  {}", to_string(f.convergence));
    if (f.error) text += ", " + deviation_text(*f.figure, *f.error);
    text += "\n";
    if (f.convergence == Convergence::kTrend) {
      left += fmt::format("{}{} {}", left.empty() ? "" : ", ", f.figure->label,
                          deviation_text(*f.figure, -*f.left));
    }
  }
  if (left.empty()) return text;
  return text + wrapped(lead + "* ", fmt::format("trend: to come beyond {} modes: {}",
                                                 error.modes.back(), left));
}

}  // namespace rotorub
