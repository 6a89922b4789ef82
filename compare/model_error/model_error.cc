#include "compare/model_error/model_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/in_parallel.h"
#include "compare/base/json.h"
#include "compare/engine/engine.h"
#include "compare/metrics/metrics.h"
#include "compare/metrics/rows.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"

namespace rotorub {
namespace {

// Whether each change is smaller than the previous one by more than chance.
bool shrink(const std::vector<double>& changes) {
  constexpr double kMargin = 0.9;
  for (std::size_t i = 1; i < changes.size(); ++i) {
    if (std::abs(changes[i]) > kMargin * std::abs(changes[i - 1])) return false;
  }
  return true;
}

// The scene with another number of modes. Its text stays unchanged, because the native model does
// not read it.
scene::Scene with_modes(scene::Scene scene, int modes) {
  scene::RotorGeometry& geometry = *scene.rotor.geometry;
  geometry.modes = modes;
  geometry.auto_modes = false;
  geometry.max_frequency.reset();
  // A start in modal coordinates does not define the further modes, which start at rest.
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
  return metrics(t, {});
}

}  // namespace

const char* to_string(Convergence convergence) {
  constexpr const char* kWords[] = {"converged", "trend", "no limit seen"};
  return kWords[static_cast<int>(convergence)];
}

FigureLimit figure_limit(const Figure& figure, const std::vector<int>& modes,
                         const std::vector<double>& values, double tolerance, double spread) {
  assert(values.size() >= kFewestRungs && values.size() == modes.size());
  FigureLimit result{&figure, values, Convergence::kNoLimit, 0.0, {}, {}};
  const std::size_t k = values.size() - 1;
  // The share of a change in SI is positive if the magnitude grows, as for deviation().
  const double sense = values[0] < 0.0 ? -1.0 : 1.0;
  const auto share = [&](double change) { return sense * share_of(figure, values[0], change); };
  std::vector<double> changes;
  for (std::size_t i = 1; i <= k; ++i) {
    changes.push_back(share(values[i] - values[i - 1]));
  }
  result.last_change = changes.back();
  if (!std::isfinite(result.last_change)) return result;

  const double noise = std::max(tolerance, spread);
  const double off = share(values[0] - values[k]);
  const double last_two = std::abs(changes[k - 1] + changes[k - 2]);
  if (std::max({std::abs(changes[k - 1]), std::abs(changes[k - 2]), last_two}) <= noise) {
    result.convergence = Convergence::kConverged;
    result.left = 0.0;
    result.error = off;
    return result;
  }
  const double left = result.last_change * modes[k - 1] / (modes[k] - modes[k - 1]);
  const double value = std::abs(share_of(figure, values[0], values[k]));
  // The last three changes, because the first modes differ in kind.
  const std::vector<double> last(changes.end() - 3, changes.end());
  if (!shrink(last) || std::abs(left) >= 0.5 * value) return result;
  result.convergence = Convergence::kTrend;
  result.left = left;
  result.error = off - left;
  return result;
}

std::vector<int> mode_ladder(int modes) {
  const int apart = std::max(2, (modes + 1) / 3);
  return {modes, modes + apart, modes + 2 * apart, modes + 3 * apart};
}

ModelError model_error(const scene::Scene& scene, const ModelErrorParameters& parameters) {
  ModelError error;
  if (!scene.rotor.geometry) {
    error.reason = scene.rotor.assembled ? "a machine of your own has no further modes"
                                         : "a scene in modal form has no further modes";
    return error;
  }
  if (!scene.has_contact()) {
    error.reason = "without a contact nothing is judged";
    return error;
  }
  error.modes = mode_ladder(prepare(scene).layout.modes);
  const std::size_t rungs = error.modes.size();
  std::vector<Metrics> found(rungs);
  std::vector<std::string> failures(rungs);
  // The most expensive rung first.
  in_parallel(rungs, parameters.jobs, parameters.interrupt, parameters.progress,
              [&](std::size_t k) {
                const std::size_t rung = rungs - 1 - k;
                try {
                  found[rung] = run_with(scene, error.modes[rung], parameters);
                } catch (const std::exception& failure) {
                  failures[rung] = failure.what();
                }
              });
  if (parameters.interrupt && parameters.interrupt->load()) error.reason = "it was interrupted";
  for (std::size_t k = 0; k < rungs && error.reason.empty(); ++k) {
    if (failures[k].empty()) continue;
    error.reason = fmt::format("the run with {} modes failed: {}", error.modes[k], failures[k]);
  }
  if (!error.reason.empty()) return error;

  for (std::size_t i = 0; i < figures().size(); ++i) {
    const Figure& f = figures()[i];
    if (!f.is_judged()) continue;
    std::vector<double> values;
    for (const Metrics& m : found) values.push_back(f.value(m));
    // No run has the figure, or it is 0 in all runs.
    if (std::all_of(values.begin(), values.end(),
                    [](double v) { return std::isnan(v) || v == 0.0; }))
      continue;
    const double spread = i < parameters.spread.size() ? parameters.spread[i] : 0.0;
    error.figures.push_back(figure_limit(f, error.modes, values, parameters.tolerance, spread));
  }
  return error;
}

result::Section model_error_section(const ModelError& error) {
  result::Section section{"model_error", {result::Data{"modes", error.modes}}};
  section.title = "What the bending modes kept leave out";
  section.id = "modes";
  if (!error.reason.empty()) {
    section.add({result::Data{"reason", error.reason},
                 result::Sentence{"modes kept: not checked, because " + error.reason, "  "}});
    return section;
  }
  result::Table table{"figures/{row}/{column}",
                      {{"", "bending modes kept", -21, result::kAll, "figure"},
                       {.heading = "unit", .seen = result::kPage}}};
  for (const int n : error.modes)
    table.columns.push_back(
        {"", fmt::format("{}", n), 9, result::kAll, fmt::format("{} modes", n)});
  table.columns.push_back({"convergence", "  with more modes; error of those kept", 0, result::kAll,
                           "with more modes, and the error of the modes kept"});
  table.columns.push_back({"", "left beyond the last", 9, result::kPage});
  std::string left;
  for (const FigureLimit& f : error.figures) {
    section.add({result::Data{f.figure->key, number_or_null(f.error)}});
    result::Row row{.key = f.figure->key,
                    .items = {{f.figure->label}, {f.figure->unit}},
                    .data = {{"values", f.values},
                             {"last_change", f.last_change},
                             {"left", number_or_null(f.left)},
                             {"error", number_or_null(f.error)}}};
    for (const double v : f.values) row.items.push_back({figure_value(*f.figure, v)});
    const std::string word = to_string(f.convergence);
    row.items.push_back(
        {word,
         "  " + word + (f.error ? ", " + deviation_text(*f.figure, f.values[0], *f.error) : "")});
    row.items.push_back(
        {.text = f.left ? size_text(*f.figure, f.values[0], std::abs(*f.left)) : "–"});
    table.rows.push_back(std::move(row));
    if (f.convergence == Convergence::kTrend) {
      left += fmt::format("{}{} {}", left.empty() ? "" : ", ", f.figure->label,
                          deviation_text(*f.figure, f.values[0], *f.left));
    }
  }
  section.add({std::move(table)});
  if (!left.empty()) {
    section.add(
        {result::Sentence{.text = fmt::format("trend: estimated further change beyond {} modes: {}",
                                              error.modes.back(), left),
                          .lead = "  * ",
                          .seen = result::kTerminal}});
  }
  return section;
}

}  // namespace rotorub
