#include "compare/report/modes_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/units.h"
#include "compare/report/assets.h"
#include "compare/report/page_frame.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

std::string rpm_text(double speed) { return fmt::format("{:.5g} rpm", speed * kRpm); }

std::string damping_text(double ratio) {
  constexpr double kRoundOff = 1e-10;  // an undamped mode
  return fmt::format("{:.3g} %", std::abs(ratio) < kRoundOff ? 0.0 : 100.0 * ratio);
}

json spectrum_values(const WhirlSpectrum& spectrum) {
  json rows = json::array();
  for (const WhirlMode& mode : spectrum.modes) {
    const double size = std::abs(mode.frequency);
    const bool grows = mode.damping_ratio < -1e-9;
    rows.push_back({{"sense", sense_of(mode, spectrum.speed)},
                    {"hertz", fmt::format("{:.6g}", size * kHz)},
                    {"radians", fmt::format("{:.6g}", size)},
                    {"damping", damping_text(mode.damping_ratio)},
                    {"tone", grows ? "bad" : ""},
                    {"grows", grows}});
  }
  return {{"speed", fmt::format("{} ({:.6g} rad/s)", rpm_text(spectrum.speed), spectrum.speed)},
          {"rows", rows}};
}

json critical_values(const std::vector<double>& speeds) {
  json rows = json::array();
  for (double speed : speeds) {
    rows.push_back({{"number", rows.size() + 1},
                    {"rpm", fmt::format("{:.6g}", speed * kRpm)},
                    {"hertz", fmt::format("{:.6g}", speed * kHz)},
                    {"radians", fmt::format("{:.7g}", speed)}});
  }
  return rows;
}

// The nearest critical speed, seen from the speed that the rotor runs at.
std::string nearest_text(const std::vector<double>& critical, double speed) {
  if (critical.empty()) return "no critical speed";
  if (speed == 0.0) return fmt::format("first critical speed at {}", rpm_text(critical.front()));
  const double nearest = *std::min_element(
      critical.begin(), critical.end(),
      [&](double a, double b) { return std::abs(a - speed) < std::abs(b - speed); });
  const double share = nearest / speed - 1.0;
  return fmt::format("nearest critical speed {}, {:.3g} % {}", rpm_text(nearest),
                     100.0 * std::abs(share), share >= 0.0 ? "above" : "below");
}

json critical_card(const RotorAnalysis& analysis) {
  constexpr std::size_t kShown = 3;
  const std::vector<double>& speeds = analysis.critical_speeds;
  std::string headline;
  for (std::size_t k = 0; k < std::min(kShown, speeds.size()); ++k) {
    headline += (k > 0 ? ", " : "") + rpm_text(speeds[k]);
  }
  if (speeds.size() > kShown) headline += fmt::format(" and {} more", speeds.size() - kShown);
  return {{"title", "Critical speeds"},
          {"tone", ""},
          {"headline", speeds.empty() ? "none" : headline},
          {"text", analysis.system.isotropic
                       ? "undamped; forward whirl, which unbalance excites"
                       : "undamped; whirl of either sense, since the planes differ"}};
}

bool runs_unstable(const scene::Scene& scene, const RotorAnalysis& analysis) {
  return analysis.stability_threshold &&
         std::abs(scene.rotor.speed) > *analysis.stability_threshold;
}

json stability_card(const scene::Scene& scene, const RotorAnalysis& analysis) {
  const bool at_rest = analysis.stability_threshold == 0.0;
  std::string headline = "stable at any speed", text = "nothing in the rotor can make a whirl grow";
  if (analysis.stability_threshold) {
    headline = at_rest ? "unstable at rest"
                       : fmt::format("unstable above {}", rpm_text(*analysis.stability_threshold));
    text = at_rest ? "the negative stiffness is stronger than the shaft and its bearings"
                   : "beyond it rotating damping feeds a whirl";
  } else if (std::isfinite(analysis.stability_bound)) {
    headline = fmt::format("stable up to {}", rpm_text(analysis.stability_bound));
    text = "where the search ends: 20 times the highest frequency";
  }
  return {{"title", "Stability"},
          {"tone", runs_unstable(scene, analysis) ? "bad"
                   : analysis.stability_threshold ? ""
                                                  : "good"},
          {"headline", headline},
          {"text", text}};
}

json running_card(const scene::Scene& scene, const RotorAnalysis& analysis) {
  const double speed = std::abs(scene.rotor.speed);
  const bool unstable = runs_unstable(scene, analysis);
  return {{"title", "The scene's speed"},
          {"tone", unstable ? "bad" : ""},
          {"headline", rpm_text(speed) + (unstable ? ", unstable" : "")},
          {"text", nearest_text(analysis.critical_speeds, std::abs(speed))}};
}

json shape_rows(const ModeShapes& shapes, const PlaneShapes& plane) {
  json rows = json::array();
  for (std::size_t i = 0; i < shapes.stations.size(); ++i) {
    json cells = json::array();
    for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
      cells.push_back(fmt::format("{:.4f}", plane.at_stations(static_cast<Eigen::Index>(i), j)));
    }
    rows.push_back({{"name", shapes.stations[i].name},
                    {"z", fmt::format("{:.5g}", 1e3 * shapes.stations[i].z)},
                    {"cells", cells}});
  }
  return rows;
}

json plane_values(const std::string& name, const ModeShapes& shapes, const PlaneShapes& plane) {
  json modes = json::array();
  for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
    modes.push_back(
        {{"number", j + 1}, {"hertz", fmt::format("{:.5g}", plane.frequency[j] * kHz)}});
  }
  return {{"plane", name}, {"modes", modes}, {"stations", shape_rows(shapes, plane)}};
}

json planes_values(const RotorAnalysis& analysis) {
  if (!analysis.shapes) return json::array();
  const ModeShapes& shapes = *analysis.shapes;
  if (shapes.same_planes) {
    return json::array({plane_values("planes x and y, which are alike", shapes, shapes.x)});
  }
  return json::array(
      {plane_values("plane x", shapes, shapes.x), plane_values("plane y", shapes, shapes.y)});
}

json torsion_values(const std::vector<WhirlMode>& modes) {
  json rows = json::array();
  for (const WhirlMode& mode : modes) {
    rows.push_back({{"number", rows.size() + 1},
                    {"hertz", fmt::format("{:.6g}", mode.frequency * kHz)},
                    {"radians", fmt::format("{:.6g}", mode.frequency)},
                    {"damping", damping_text(mode.damping_ratio)}});
  }
  return rows;
}

}  // namespace

std::string beyond_text(const RotorAnalysis& analysis, double range) {
  const std::vector<double>& speeds = analysis.critical_speeds;
  const auto first = std::upper_bound(speeds.begin(), speeds.end(), range);
  std::string text;
  if (first != speeds.end()) {
    std::string list;
    for (auto speed = first; speed != speeds.end(); ++speed)
      list += fmt::format("{}{:.0f}", list.empty() ? "" : ", ", *speed * kRpm);
    text = fmt::format("Beyond the diagram: {} critical speed{}, {} rpm.", speeds.end() - first,
                       speeds.end() - first > 1 ? "s" : "", list);
  }
  if (analysis.stability_threshold && *analysis.stability_threshold > range) {
    text += fmt::format("{}The threshold of stability, {}, lies beyond the diagram.",
                        text.empty() ? "" : " ", rpm_text(*analysis.stability_threshold));
  }
  return text;
}

Campbell campbell_of(const scene::Scene& scene, RotorAnalysis analysis, std::optional<double> range,
                     const std::function<void(double)>& progress) {
  const double top = range.value_or(campbell_range(scene, analysis));
  auto branches = whirl_branches(condensed(analysis.system, top, kCampbellAccuracy),
                                 even_speeds(top, kCampbellSpeeds), progress);
  return {std::move(analysis), top, std::move(branches)};
}

std::string modes_page(const scene::Scene& scene, const RotorAnalysis& analysis, double range,
                       const std::vector<WhirlBranch>& branches) {
  json values = page_frame({scene.name, "whirl of the free rotor",
                            "Where does it whirl, and where does it stay stable?"},
                           {{"rotor", modes_plots(scene, analysis, range, branches)}});
  json spectra = json::array();
  for (const WhirlSpectrum& spectrum : analysis.spectra) {
    spectra.push_back(spectrum_values(spectrum));
  }
  values["hash"] = scene::scene_hash(scene);
  values["cards"] = json::array(
      {running_card(scene, analysis), critical_card(analysis), stability_card(scene, analysis)});
  values["top"] = rpm_text(range);
  values["beyond"] = beyond_text(analysis, range);
  values["has_shapes"] = analysis.shapes.has_value();
  values["planes"] = planes_values(analysis);
  values["spectra"] = spectra;
  values["critical"] = critical_values(analysis.critical_speeds);
  values["stability"] = stability_text(analysis);
  values["has_torsion"] = !analysis.torsion.empty();
  values["torsion"] = torsion_values(analysis.torsion);
  values["text"] = scene.text;
  return fill_page(modes_html(), values);
}

}  // namespace rotorub
