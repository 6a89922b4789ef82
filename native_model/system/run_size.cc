#include "native_model/system/run_size.h"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "native_model/scene/diagnostic.h"
#include "native_model/system/model_checks.h"

namespace rotorub {
namespace {

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", number);
  return buffer;
}

// Those of every row; torsion, command and currents beside them are few.
double columns(const Model& model) {
  const Layout& l = model.layout;
  return 17.0 + 4.0 * l.modes + 2.0 * (l.torsion + l.ring_spin);
}

double rows(const scene::Run& run) {
  return run.end / run.series_step() + static_cast<double>(run.output_times.size());
}

void find_steps(const scene::Run& run, double step, std::vector<scene::Diagnostic>& wrong) {
  if (run.end / step <= kMostSteps) return;
  wrong.push_back({"", 0, "run.step",
                   text(run.end / step) + " steps of " + text(step) + " s to run.end = " +
                       text(run.end) + " s; accepted: at most " + text(kMostSteps) + " steps, of " +
                       text(run.end / kMostSteps) + " s or more"});
}

void find_rows(const scene::Run& run, const Model& model, const std::vector<double>* times,
               std::vector<scene::Diagnostic>& wrong) {
  const double count = times ? static_cast<double>(times->size()) : rows(run);
  const double most = std::floor(kMostSeriesValues / columns(model));
  if (count <= most) return;
  const char* key =
      run.output_step || run.output_times.empty() ? "run.output_step" : "run.output_times";
  wrong.push_back({"", 0, key,
                   text(count) + " rows of " + text(columns(model)) +
                       " columns to run.end = " + text(run.end) + " s; accepted: at most " +
                       text(most) + " rows, one in " + text(run.end / most) + " s"});
}

}  // namespace

void check_steps(const scene::Scene& scene, double fixed_step) {
  std::vector<scene::Diagnostic> wrong;
  find_steps(scene.run, fixed_step, wrong);
  if (!wrong.empty()) refuse(scene, std::move(wrong));
}

void check_run_size(const scene::Scene& scene, const Model& model, std::optional<double> fixed_step,
                    const std::vector<double>* times) {
  std::vector<scene::Diagnostic> wrong;
  if (fixed_step) find_steps(scene.run, *fixed_step, wrong);
  find_rows(scene.run, model, times, wrong);
  if (!wrong.empty()) refuse(scene, std::move(wrong));
}

}  // namespace rotorub
