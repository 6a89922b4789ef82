#include "compare/modes/rotor_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/base/units.h"
#include "native_model/linear/free_motion.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

// The scene's speed if none is requested.
std::vector<double> speeds_of(const scene::Scene& scene, const std::vector<double>& asked) {
  return asked.empty() ? std::vector<double>{scene.rotor.speed} : asked;
}

// Critical speeds above this multiple of the highest speed asked for (or of the lowest critical
// speed, if that is higher) are not listed: no machine reaches them, and a mesh of beams cannot
// resolve them.
constexpr double kCriticalMultiple = 20.0;

void add_critical_speeds(double sense, const std::vector<double>& speeds, RotorAnalysis& analysis) {
  std::vector<double>& critical = analysis.critical_speeds;
  critical = critical_speeds(analysis.system, sense);
  double reference = critical.empty() ? 0.0 : critical.front();
  for (const double speed : speeds) reference = std::max(reference, std::abs(speed));
  analysis.critical_bound = kCriticalMultiple * reference;
  std::erase_if(critical, [&](double speed) { return speed > analysis.critical_bound; });
  analysis.critical_senses = critical_senses(analysis.system, critical, sense);
  analysis.table_end = table_speeds(analysis.system, sense).back();
}

RotorAnalysis analysis_of(const scene::Scene& scene, const std::vector<double>& speeds) {
  RotorAnalysis analysis;
  analysis.system = whirl_system(scene);
  const double sense = scene.rotor.speed < 0.0 ? -1.0 : 1.0;
  add_critical_speeds(sense, speeds, analysis);
  analysis.unstable = unstable_ranges(analysis.system, sense);
  analysis.stability_bound = stability_bound(analysis.system);
  analysis.shapes = mode_shapes(scene);
  if (analysis.shapes) {
    analysis.whirl_shapes =
        whirl_shapes(scene, analysis.system, scene.rotor.speed, *analysis.shapes);
  }
  analysis.contact_mass = contact_mass(scene);
  analysis.motor_is_held = !scene.drive;
  if (scene.rotor.torsion) analysis.torsion = torsion_frequencies(modal_rotor(scene));
  for (double speed : speeds) analysis.spectra.push_back(whirl_spectrum(analysis.system, speed));
  return analysis;
}

// With a shaft, the band of the modes kept, beside the rubs at each speed.
void add_bands(const scene::Scene& scene, RotorAnalysis& analysis) {
  if (!scene.rotor.geometry) return;
  for (RubAnalyses& rubs : analysis.rubs) {
    for (std::size_t k = 0; k < rubs.at.size(); ++k)
      rubs.at[k].band = mode_band(analysis.spectra[k]);
  }
}

// A note is added if twice as many modes change the response by more than this share.
constexpr double kModesMatter = 0.005;

// Notes how much the omitted modes would change the response at the contacts.
void note_modes_left_out(scene::Scene free, int modes, const std::vector<double>& speeds,
                         RotorAnalysis& analysis) {
  if (!free.rotor.geometry) return;
  scene::RotorGeometry& geometry = *free.rotor.geometry;
  geometry.modes = 2 * modes;
  geometry.auto_modes = false;
  geometry.max_frequency.reset();
  std::optional<Model> model;
  try {
    model = prepare(free);
  } catch (const scene::SceneError&) {
    return;  // the mesh has fewer modes
  }
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const FreeResponse finer = free_response(free, *model, speeds[k]);
    RotorResponse& response = analysis.responses[k];
    for (const ContactPlace& place : analysis.contacts) {
      const auto few = response.all.orbits[place.bearing].largest,
                 many = finer.orbits[place.bearing].largest;
      if (!few || !many || std::abs(*many - *few) <= kModesMatter * *many) continue;
      response.few_modes.push_back(fmt::format(
          "the response{} uses the {} modes kept; with {} modes it is {:.3g} µm ({:+.2g} %)",
          place.name.empty() ? "" : fmt::format(" at contact \"{}\"", place.name), modes, 2 * modes,
          kMicro * *many, 100.0 * (*many / *few - 1.0)));
    }
  }
}

// The machine in operation: a magnetic bearing that works at some time works at all times, as in
// the list of whirl frequencies.
scene::Scene in_operation(scene::Scene scene) {
  for (scene::MagneticBearing& bearing : scene.magnetic_bearings) {
    if (!bearing.control || !bearing.control->works()) continue;
    bearing.control->works_from = 0.0;
    bearing.control->fails_at = bearing.control->returns_at = scene::kNever;
  }
  return scene;
}

void add_response(const scene::Scene& scene, const std::vector<double>& speeds,
                  RotorAnalysis& analysis) {
  const bool controls =
      std::ranges::any_of(scene.magnetic_bearings,
                          [](const scene::MagneticBearing& b) { return b.control.has_value(); });
  if (!scene.has_contact() && !controls) return;
  const scene::Scene free = in_operation(without_start(scene));
  const Model model = prepare(free);
  for (double speed : speeds) analysis.levitations.push_back(levitation(model, speed));
  analysis.contacts = contact_places(scene);
  for (double speed : speeds)
    analysis.responses.push_back({free_response(free, model, speed), std::nullopt, {}});
  if (const auto before = before_loss(free)) {
    const Model intact = prepare(*before);
    for (std::size_t k = 0; k < speeds.size(); ++k)
      analysis.responses[k].before_loss = free_response(*before, intact, speeds[k]);
  }
  note_modes_left_out(free, model.layout.modes, speeds, analysis);
}

}  // namespace

RotorAnalysis analyse_rotor(const scene::Scene& scene, const std::vector<double>& speeds) {
  return with_place(scene, [&] {
    const std::vector<double> all = speeds_of(scene, speeds);
    RotorAnalysis analysis = analysis_of(scene, all);
    analysis.rubs = analyse_rubs(scene, all);
    add_bands(scene, analysis);
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

const char* to_string(StationKind kind) {
  constexpr std::array<const char*, 6> kNames{"disc",  "bearing",          "contact",
                                              "drive", "magnetic_bearing", "force"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace rotorub
