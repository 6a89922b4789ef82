#include "compare/modes/rotor_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/modes/levitation_text.h"
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
          "the response{} is that of the {} modes kept; with {} modes it is {:.3g} um ({:+.2g} %)",
          place.name.empty() ? "" : " at contact " + place.name, modes, 2 * modes, 1e6 * *many,
          100.0 * (*many / *few - 1.0)));
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
  if (!scene.first().contact && !controls) return;
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

using nlohmann::json;

std::string mode_row(const char* name, const WhirlMode& mode) {
  const double size = std::abs(mode.frequency);
  return fmt::format("  {:<12}{:>14.7g}{:>14.7g}{:>16.4g}\n", name, size, size * kHz,
                     mode.damping_ratio);
}

std::string spectrum_table(const WhirlSpectrum& spectrum) {
  std::string text =
      fmt::format("at {:.6g} rad/s ({:.6g} rpm)\n", spectrum.speed, spectrum.speed * kRpm);
  text += fmt::format("  {:<12}{:>14}{:>14}{:>16}\n", "whirl", "rad/s", "Hz", "damping ratio");
  for (const WhirlMode& mode : spectrum.modes) {
    text += mode_row(sense_of(mode, spectrum.speed), mode);
  }
  return text;
}

// One column per mode: its frequency at rest, then its value at each station.
std::string plane_table(const std::vector<Station>& stations, const PlaneShapes& plane) {
  constexpr Eigen::Index kColumns = 6;
  const Eigen::Index n = std::min(kColumns, plane.frequency.size());
  std::string text = fmt::format("  {:<18}{:>10}", "station", "z / mm");
  for (Eigen::Index j = 0; j < n; ++j) {
    text += fmt::format("{:>13}", fmt::format("{:.5g} Hz", plane.frequency[j] * kHz));
  }
  text += "\n";
  for (std::size_t i = 0; i < stations.size(); ++i) {
    text += fmt::format("  {:<18}{:>10.5g}", stations[i].name, 1e3 * stations[i].z);
    for (Eigen::Index j = 0; j < n; ++j) {
      text += fmt::format("{:>13.4f}", plane.at_stations(static_cast<Eigen::Index>(i), j));
    }
    text += "\n";
  }
  const Eigen::Index left = plane.frequency.size() - n;
  if (left > 0) text += fmt::format("  and {} higher modes, in the output of --json\n", left);
  return text;
}

std::string shapes_table(const RotorAnalysis& analysis) {
  if (!analysis.shapes) {
    return "mode shapes: none, as the scene gives its modes without a shaft; each is 1 at the "
           "contact\n";
  }
  const ModeShapes& shapes = *analysis.shapes;
  const std::string title = "mode shapes at rest, 1 at the contact or at the peak";
  if (shapes.same_planes) {
    return fmt::format("{}, planes x and y alike\n", title) +
           plane_table(shapes.stations, shapes.x);
  }
  return fmt::format("{}, plane x\n", title) + plane_table(shapes.stations, shapes.x) +
         fmt::format("\n{}, plane y\n", title) + plane_table(shapes.stations, shapes.y);
}

// The critical speeds that unbalance excites; with isotropic planes it cannot drive backward whirl.
std::string critical_table(const RotorAnalysis& analysis) {
  std::string text =
      fmt::format("\ncritical speeds that unbalance excites, undamped, up to {:.5g} rpm\n",
                  analysis.critical_bound * kRpm);
  for (std::size_t k = 0; k < analysis.critical_speeds.size(); ++k) {
    const double speed = analysis.critical_speeds[k];
    text += fmt::format("  {:.7g} rad/s ({:.7g} rpm), {}{}\n", speed, speed * kRpm,
                        to_string(analysis.critical_senses[k]),
                        analysis.table_end > 0.0 && speed > analysis.table_end
                            ? " (beyond the bearings' tables, so their last values are used)"
                            : "");
  }
  if (analysis.critical_speeds.empty()) text += "  none\n";
  return text;
}

std::string torsion_table(const RotorAnalysis& analysis) {
  if (analysis.torsion.empty()) return "";
  std::string text = fmt::format("\ntorsion, elastic modes{}\n",
                                 analysis.motor_is_held ? ", with the motor's end held" : "");
  for (const WhirlMode& mode : analysis.torsion) text += mode_row("torsion", mode);
  return text;
}

std::string contact_mass_text(const std::optional<ContactMass>& mass) {
  if (!mass) return "";
  return "\nmass that an impact meets at the contact\n" +
         wrapped("  ",
                 fmt::format("{:.4g} kg with the {} modes kept, {:.4g} kg with all {} of the "
                             "mesh{}",
                             mass->kept, mass->kept_modes, mass->mesh, mass->mesh_modes,
                             mass->truncated() ? ": impacts are those of the modes kept" : ""));
}

std::vector<double> list(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

json plane_json(const PlaneShapes& plane) {
  json modes = json::array();
  for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
    modes.push_back({{"frequency", plane.frequency[j]},
                     {"shape", list(plane.shape.col(j))},
                     {"at_stations", list(plane.at_stations.col(j))}});
  }
  return modes;
}

json shapes_json(const std::optional<ModeShapes>& shapes) {
  if (!shapes) return nullptr;
  json stations = json::array();
  for (const Station& station : shapes->stations) {
    stations.push_back(
        {{"kind", to_string(station.kind)}, {"name", station.name}, {"z", station.z}});
  }
  return {{"z", list(shapes->z)},
          {"stations", stations},
          {"same_planes", shapes->same_planes},
          {"x", plane_json(shapes->x)},
          {"y", plane_json(shapes->y)}};
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

bool is_unstable(const RotorAnalysis& analysis, double speed) {
  return std::ranges::any_of(analysis.unstable, [speed](const UnstableRange& range) {
    return (speed > range.from || range.from == 0.0) && speed < range.to;
  });
}

std::string stability_text(const RotorAnalysis& analysis) {
  if (!analysis.unstable.empty()) {
    std::vector<std::string> ranges;
    for (const auto& [from, to] : analysis.unstable) {
      ranges.push_back(std::isinf(to)
                           ? fmt::format("above {:.7g} rad/s ({:.7g} rpm)", from, from * kRpm)
                           : fmt::format("from {:.7g} to {:.7g} rad/s ({:.7g} to {:.7g} rpm)", from,
                                         to, from * kRpm, to * kRpm));
    }
    return fmt::format("unstable {}", fmt::join(ranges, " and "));
  }
  if (std::isinf(analysis.stability_bound)) return "no whirl grows at any speed";
  return fmt::format("no whirl grows up to {:.5g} rad/s ({:.5g} rpm)", analysis.stability_bound,
                     analysis.stability_bound * kRpm);
}

json modes_json(const RotorAnalysis& analysis) {
  json spectra = json::array();
  for (const WhirlSpectrum& spectrum : analysis.spectra) {
    const RubAnalyses& rubs = analysis.rubs.front();
    const std::size_t at = spectra.size();
    const auto response = [&](std::size_t bearing) -> json {
      const auto place = std::ranges::find(analysis.contacts, bearing, &ContactPlace::bearing);
      if (place == analysis.contacts.end()) return nullptr;
      return response_json(*place, analysis.responses[at], spectrum.speed);
    };
    spectra.push_back(
        {{"speed", spectrum.speed},
         {"modes", whirls_json(spectrum.modes)},
         {"rub", rubs.at.empty() ? json(nullptr) : rub_json(rubs.at[at])},
         {"response", response(0)},
         {"notes",
          analysis.responses.empty() ? json::array() : json(analysis.responses[at].notes())},
         {"levitation", analysis.levitations.empty() ? json(nullptr)
                                                     : levitation_json(analysis.levitations[at])}});
    for (std::size_t k = 0; k < analysis.rubs.size(); ++k) {
      const RubAnalyses& of = analysis.rubs[k];
      if (of.contact.empty()) break;  // there is only one contact
      spectra.back()["contacts"].push_back(
          {{"name", of.contact},
           {"response", response(k)},
           {"rub", of.at.empty() ? json(nullptr) : rub_json(of.at[at])},
           {"rub_refused", of.refused.empty() ? json(nullptr) : json(of.refused)}});
    }
  }
  json result{{"speeds", spectra},
              {"critical_speeds", analysis.critical_speeds},
              {"stability_threshold", nullptr},
              {"stability_bound", nullptr},
              {"torsion", whirls_json(analysis.torsion)},
              {"contact_mass", contact_mass_json(analysis.contact_mass)},
              {"mode_shapes", shapes_json(analysis.shapes)},
              {"rub_refused", nullptr}};
  if (!analysis.rubs.front().refused.empty()) result["rub_refused"] = analysis.rubs.front().refused;
  if (const auto threshold = analysis.stability_threshold())
    result["stability_threshold"] = *threshold;
  result["unstable_ranges"] = json::array();
  for (const auto& [from, to] : analysis.unstable) {
    result["unstable_ranges"].push_back({from, number_or_null(to)});
  }
  result["critical"] = json::array();
  for (std::size_t k = 0; k < analysis.critical_speeds.size(); ++k) {
    result["critical"].push_back({{"speed", analysis.critical_speeds[k]},
                                  {"whirl", to_string(analysis.critical_senses[k])}});
  }
  if (std::isfinite(analysis.stability_bound)) {
    result["stability_bound"] = analysis.stability_bound;
  }
  return result;
}

std::string modes_table(const std::string& name, const RotorAnalysis& analysis) {
  std::string text = fmt::format("{}: whirl of the free rotor\n", name);
  for (std::size_t i = 0; i < analysis.spectra.size(); ++i) {
    text += "\n" + spectrum_table(analysis.spectra[i]);
    if (!analysis.responses.empty())
      text += response_text(analysis.contacts, analysis.responses[i], analysis.spectra[i].speed);
    if (!analysis.levitations.empty()) {
      text += levitation_table(analysis.spectra[i].speed, analysis.levitations[i]);
    }
  }
  text += torsion_table(analysis);

  text += critical_table(analysis);

  text += "\n" + stability_text(analysis) + "\n" + contact_mass_text(analysis.contact_mass);
  text += "\n" + shapes_table(analysis);
  for (const RubAnalyses& of : analysis.rubs) {
    if (!of.contact.empty()) text += fmt::format("\ncontact {}, the others open\n", of.contact);
    for (const RubAnalysis& rubs : of.at) text += "\n" + rub_table(rubs);
    if (!of.refused.empty()) text += fmt::format("\nrotor and ring together: {}\n", of.refused);
  }
  return text;
}

const char* to_string(StationKind kind) {
  constexpr std::array<const char*, 6> kNames{"disc",  "bearing",          "contact",
                                              "drive", "magnetic_bearing", "force"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace rotorub
