#include "compare/modes/page_data.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "compare/base/json.h"
#include "compare/base/plot_points.h"
#include "compare/modes/levitation_text.h"
#include "compare/modes/result.h"
#include "native_model/linear/stiffness_map.h"
#include "native_model/linear/synchronous_response.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

json pair(const std::complex<double>& z) { return {z.real(), z.imag()}; }

json modes_json(const std::vector<WhirlMode>& modes) {
  return list_of(modes, [](const WhirlMode& m) -> json { return {m.frequency, m.damping_ratio}; });
}

json shaft_json(const scene::Scene& scene) {
  if (!scene.rotor.geometry) return nullptr;
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  return {{"sections", list_of(geometry.sections,
                               [](const scene::ShaftSection& s) -> json {
                                 return {{"from", s.from},
                                         {"to", s.to},
                                         {"diameter", s.diameter},
                                         {"end_diameter", s.outer_at(s.to)}};
                               })},
          {"discs", list_of(geometry.discs, [](const scene::Disc& d) -> json {
             return {{"z", d.z}, {"mass", d.mass}, {"Jp", d.Jp}};
           })}};
}

// ---------------------------------------------------------------- response to unbalance
// The margin is the one that API 617 requires of the scene's speed, a share of it, or null.
json peak_json(const ResponsePeak& peak, double running) {
  std::optional<double> margin;
  if (peak.amplification && running > 0.0)
    margin = required_margin(*peak.amplification, peak.speed > running);
  return {{"speed", peak.speed},
          {"deflection", pair(peak.deflection)},
          {"amplification", number_or_null(peak.amplification)},
          {"margin", number_or_null(margin)}};
}

json probes_json(const SynchronousResponse& response, double running) {
  return {{"speed", response.speed},
          {"probes", list_of(response.probes, [&](const ProbeResponse& probe) -> json {
             return {{"name", probe.name},
                     {"plane", response.same_planes ? ""
                               : probe.plane == 0   ? "x"
                                                    : "y"},
                     {"deflection", list_of(probe.deflection, pair)},
                     {"peaks", list_of(probe.peaks, [&](const ResponsePeak& peak) {
                        return peak_json(peak, running);
                      })}};
           })}};
}

// {"speed", "probes", "forces", "before": the same before unbalance is added, for example by a lost
// blade, or null, "contacts": [{"name", "clearance"}], "limit": m, peak to peak, that API 617
// allows with controlled magnetic bearings, or null}.
json response_json(const scene::Scene& scene, double top) {
  const auto response = synchronous_response(scene, top);
  if (!response) return nullptr;
  const double running = std::abs(scene.rotor.speed);
  json data = probes_json(*response, running);
  data["forces"] = response->forces;
  data["before"] = nullptr;
  if (const auto intact = before_loss(scene)) {
    const auto before = synchronous_response(*intact, top);
    if (before && before->speed.size() > 1) data["before"] = probes_json(*before, running);
  }
  data["contacts"] = list_of(contact_places(scene), [](const ContactPlace& at) -> json {
    return {{"name", at.name}, {"clearance", at.clearance}};
  });
  const bool is_held = std::ranges::any_of(scene.magnetic_bearings, [](const auto& bearing) {
    return bearing.control && bearing.control->works();
  });
  data["limit"] = is_held ? list_of(response->speed, vibration_limit) : json();
  return data;
}

// Covers the scene's speed and the next critical speed instead of all of them.
double response_range(const scene::Scene& scene, const Campbell& campbell) {
  constexpr double kBeyondSpeed = 2.5, kBeyondCritical = 1.25;
  const double speed = std::abs(scene.rotor.speed);
  const std::vector<double>& critical = campbell.analysis.critical_speeds;
  if (speed == 0.0) return campbell.range;
  const auto next = std::upper_bound(critical.begin(), critical.end(), speed);
  const double beyond = next == critical.end() ? 0.0 : kBeyondCritical * *next;
  return std::min(campbell.range, std::max(kBeyondSpeed * speed, beyond));
}

json stiffness_data(const scene::Scene& scene) {
  constexpr const char* kOf[] = {"bearings", "magnets", "ring", "mount"};  // as StiffnessMap::Of
  return list_of(stiffness_maps(scene), [&](const StiffnessMap& map) -> json {
    const bool is_one_of_several = !map.ring.empty() && scene.auxiliary.size() > 1;
    return {{"of", kOf[static_cast<std::size_t>(map.of)]},
            {"contact", is_one_of_several ? scene.name_of(map.contact) : ""},
            {"stiffness", map.stiffness},
            {"own", map.own},
            {"critical", map.critical},
            {"ring", map.ring}};
  });
}

json loop_data(const RotorAnalysis& analysis) {
  constexpr std::size_t kBuckets = 300;
  constexpr double kBeyondSettling = 1.4;
  json loops = json::array();
  for (const Levitation& levitation : analysis.levitations) {
    if (!has_loop(levitation)) continue;
    json sensitivity = json::array();
    const Eigen::Index shown = levitation.unstable() ? 0 : levitation.sensitivities.rows();
    for (Eigen::Index k = 0; k < shown; ++k) {
      const Eigen::VectorXd sizes = levitation.sensitivities.row(k);
      sensitivity.push_back(series(levitation.frequencies, {sizes.begin(), sizes.end()}, kBuckets));
    }
    double end = 0.0;  // s
    for (const StepResponse& step : levitation.steps)
      end = std::max(end, kBeyondSettling * step.settling_time);
    loops.push_back({{"sensitivity", sensitivity},
                     {"step", list_of(levitation.steps, [&](const StepResponse& step) {
                        const auto last = std::ranges::upper_bound(step.t, end) - step.t.begin();
                        return series({step.t.begin(), step.t.begin() + last},
                                      {step.y.begin(), step.y.begin() + last}, kBuckets);
                      })}});
  }
  return loops;
}

}  // namespace

double campbell_range(const scene::Scene& scene, const RotorAnalysis& analysis) {
  constexpr double kFar = 4.0;      // factor beyond which a speed is too far away to be shown
  constexpr double kMargin = 1.15;  // beyond the last speed of interest
  double shown = std::abs(scene.rotor.speed);
  for (const WhirlSpectrum& spectrum : analysis.spectra) {
    shown = std::max(shown, std::abs(spectrum.speed));
  }
  const std::vector<double>& critical = analysis.critical_speeds;
  const std::optional<double> threshold = analysis.stability_threshold();
  if (shown == 0.0) shown = critical.empty() ? threshold.value_or(0.0) : critical.front();
  // Relative to the machine's own speeds, because a series of critical speeds would extend it
  // repeatedly.
  const double far = kFar * shown;
  for (double speed : critical) {
    if (speed <= far) shown = std::max(shown, speed);
  }
  if (threshold && *threshold <= far) shown = std::max(shown, *threshold);
  // Nothing rotates and nothing is critical, so the highest frequency determines the range.
  if (shown == 0.0) shown = std::abs(analysis.spectra.front().modes.back().frequency);
  return kMargin * (shown > 0.0 ? shown : 1.0);
}

Campbell campbell_of(const scene::Scene& scene, RotorAnalysis analysis, std::optional<double> range,
                     const std::function<void(double)>& progress) {
  constexpr int kSpeeds = 161;
  constexpr double kAccuracy = 1e-5;  // relative accuracy of the curves, finer than a line
  const double top = range.value_or(campbell_range(scene, analysis));
  auto branches = whirl_branches(condensed(analysis.system, top, kAccuracy),
                                 even_speeds(top, kSpeeds), progress);
  return {std::move(analysis), top, std::move(branches)};
}

json rotor_data(const scene::Scene& scene, const Campbell& campbell) {
  const RotorAnalysis& analysis = campbell.analysis;
  const double running = scene.rotor.speed;
  return {
      {"running", running},
      {"top", campbell.range},
      {"branches", list_of(campbell.branches,
                           [](const WhirlBranch& branch) -> json {
                             return {{"speed", branch.speed}, {"modes", modes_json(branch.modes)}};
                           })},
      {"operating", modes_json(whirl_spectrum(analysis.system, running).modes)},
      {"whirl_shapes", list_of(analysis.whirl_shapes,
                               [](const WhirlShape& whirl) -> json {
                                 return {{"mode", modes_json({whirl.mode})[0]},
                                         {"roundness", whirl.roundness},
                                         {"shape", whirl.shape}};
                               })},
      {"shaft", shaft_json(scene)},
      {"response", response_json(scene, response_range(scene, campbell))}};
}

json rotor_data(const scene::Scene& scene) {
  try {
    const Campbell campbell = campbell_of(scene, analyse_free_rotor(scene, {}));
    json data = rotor_data(scene, campbell);
    data["found"] = result::json_of(modes_result(scene.name, campbell.analysis));
    return data;
  } catch (const std::runtime_error& error) {
    // The page of the run must not depend on its rotor's eigenvalues.
    return {{"refusal", error.what()}};
  }
}

json modes_data(const scene::Scene& scene, const Campbell& campbell) {
  json rotor = rotor_data(scene, campbell);
  rotor["stiffness"] = stiffness_data(scene);
  const bool is_sheared =
      scene.rotor.geometry && scene.rotor.geometry->theory == scene::ShaftTheory::kTimoshenko;
  return {{"rotor", std::move(rotor)},
          {"loops", loop_data(campbell.analysis)},
          {"hash", scene::scene_hash(scene)},
          {"theory", is_sheared ? "Timoshenko" : "Euler-Bernoulli"}};
}

}  // namespace rotorub
