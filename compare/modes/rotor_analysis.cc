#include "compare/modes/rotor_analysis.h"

#include <fmt/format.h>

#include <cmath>

#include "compare/base/units.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {

namespace {

// The scene's own where none are asked for.
std::vector<double> speeds_of(const scene::Scene& scene, const std::vector<double>& asked) {
  return asked.empty() ? std::vector<double>{scene.rotor.speed} : asked;
}

RotorAnalysis analysis_of(const scene::Scene& scene, const std::vector<double>& speeds) {
  RotorAnalysis analysis;
  analysis.system = whirl_system(scene);
  const double sense = scene.rotor.speed < 0.0 ? -1.0 : 1.0;
  analysis.critical_speeds = critical_speeds(analysis.system, sense);
  analysis.stability_threshold = stability_threshold(analysis.system, sense);
  analysis.stability_bound = stability_bound(analysis.system);
  analysis.shapes = mode_shapes(scene);
  if (analysis.shapes) {
    analysis.whirl_shapes =
        whirl_shapes(scene, analysis.system, scene.rotor.speed, *analysis.shapes);
  }
  analysis.contact_mass = contact_mass(scene);
  if (scene.rotor.torsion) analysis.torsion = torsion_frequencies(modal_rotor(scene));
  for (double speed : speeds) analysis.spectra.push_back(whirl_spectrum(analysis.system, speed));
  return analysis;
}

void add_response(const scene::Scene& scene, const std::vector<double>& speeds,
                  RotorAnalysis& analysis) {
  if (!scene.first().contact) return;
  analysis.clearance = scene.first().contact->clearance;
  scene::Scene free = scene;
  free.initial = {};
  const Model model = make_model(free);
  for (double speed : speeds) analysis.orbits.push_back(free_orbit(free, model, speed));
}

}  // namespace

RotorAnalysis analyse_rotor(const scene::Scene& scene, const std::vector<double>& speeds) {
  return with_place(scene, [&] {
    const std::vector<double> all = speeds_of(scene, speeds);
    RotorAnalysis analysis = analysis_of(scene, all);
    analysis.rubs = analyse_rubs(scene, all);
    add_response(scene, all, analysis);
    return analysis;
  });
}

RotorAnalysis analyse_free_rotor(const scene::Scene& scene, const std::vector<double>& speeds) {
  return with_place(scene, [&] { return analysis_of(scene, speeds_of(scene, speeds)); });
}

const char* sense_of(const WhirlMode& mode, double speed) {
  if (mode.frequency == 0.0) return mode.damping_ratio == 0.0 ? "rigid" : "overdamped";
  return (mode.frequency > 0.0) == (speed >= 0.0) ? "forward" : "backward";
}

std::string stability_text(const RotorAnalysis& analysis) {
  if (analysis.stability_threshold) {
    return fmt::format("unstable above {:.7g} rad/s ({:.7g} rpm)", *analysis.stability_threshold,
                       *analysis.stability_threshold * kRpm);
  }
  if (std::isinf(analysis.stability_bound)) return "no whirl grows at any speed";
  return fmt::format("no whirl grows up to {:.5g} rad/s ({:.5g} rpm)", analysis.stability_bound,
                     analysis.stability_bound * kRpm);
}

}  // namespace rotorub
