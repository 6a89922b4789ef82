#include "native_model/system/run_size.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <utility>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"
#include "native_model/system/model_checks.h"

namespace rotorub {
namespace {

std::string rough_text(double number) { return scene::number_text(number, 3); }

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
                   rough_text(run.end / step) + " steps of " + rough_text(step) +
                       " s to run.end = " + rough_text(run.end) + " s; accepted: at most " +
                       rough_text(kMostSteps) + " steps, of " + rough_text(run.end / kMostSteps) +
                       " s or more"});
}

void find_samples(const scene::Scene& scene, std::vector<scene::Diagnostic>& wrong) {
  const double time = scene.first().controller ? scene.first().controller->sample_time : 0.0;
  if (!(time > 0.0) || scene.run.end / time <= kMostSteps) return;
  wrong.push_back({"", 0, "controller.sample_time",
                   rough_text(scene.run.end / time) +
                       " samples to run.end = " + rough_text(scene.run.end) +
                       " s; accepted: at most " + rough_text(kMostSteps) + " samples, one in " +
                       rough_text(scene.run.end / kMostSteps) + " s"});
}

// An integrator that chooses its steps follows every turn of a load.
void find_turns(const scene::Scene& scene, std::vector<scene::Diagnostic>& wrong) {
  const auto look = [&](const std::string& key, double frequency, double from, double to) {
    const double turns = std::abs(frequency) * (std::min(to, scene.run.end) - std::max(from, 0.0)) /
                         (2.0 * std::numbers::pi);
    if (!(turns > kMostSteps)) return;
    wrong.push_back({"", 0, key,
                     rough_text(turns) + " turns to run.end = " + rough_text(scene.run.end) +
                         " s; accepted: at most " + rough_text(kMostSteps)});
  };
  for (std::size_t k = 0; k < scene.forces.size(); ++k) {
    const scene::Force& f = scene.forces[k];
    const std::string path = scene::list_element("force", k);
    if (f.kind == scene::ForceKind::kRotating) look(path + ".frequency", f.frequency, f.on, f.off);
    if (f.kind == scene::ForceKind::kChirp)
      look(path + ".frequency_end", f.frequency_end, f.on, f.off);
  }
}

void find_rows(const scene::Run& run, const Model& model, const std::vector<double>* times,
               std::vector<scene::Diagnostic>& wrong) {
  const double count = times ? static_cast<double>(times->size()) : rows(run);
  const double most = std::floor(kMostSeriesValues / columns(model));
  if (count <= most) return;
  const char* key =
      run.output_step || run.output_times.empty() ? "run.output_step" : "run.output_times";
  wrong.push_back({"", 0, key,
                   rough_text(count) + " rows of " + rough_text(columns(model)) +
                       " columns to run.end = " + rough_text(run.end) + " s; accepted: at most " +
                       rough_text(most) + " rows, one in " + rough_text(run.end / most) + " s"});
}

}  // namespace

void check_steps(const scene::Scene& scene, double fixed_step) {
  std::vector<scene::Diagnostic> wrong;
  find_steps(scene.run, fixed_step, wrong);
  find_samples(scene, wrong);
  if (!wrong.empty()) refuse(scene, std::move(wrong));
}

void check_run_size(const scene::Scene& scene, const Model& model, std::optional<double> fixed_step,
                    const std::vector<double>* times) {
  std::vector<scene::Diagnostic> wrong;
  if (fixed_step) {
    find_steps(scene.run, *fixed_step, wrong);
  } else {
    find_turns(scene, wrong);
  }
  find_samples(scene, wrong);
  find_rows(scene.run, model, times, wrong);
  if (!wrong.empty()) refuse(scene, std::move(wrong));
}

}  // namespace rotorub
