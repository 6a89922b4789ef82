#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/report/modes_page.h"
#include "compare/report/plot_points.h"
#include "compare/report/response_plots.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr int kPlotDigits = 7;

double shown(double value) { return rounded(value, kPlotDigits); }
json list(const Eigen::VectorXd& values, double factor) {
  return rounded_list(values, factor, kPlotDigits);
}

// Cuts a branch where its sense changes; each piece starts at the last point of the previous one.
void add_pieces(const WhirlBranch& branch, json& pieces) {
  constexpr double kRoundOff = 1e-10;  // damping ratio of an undamped mode
  json piece;
  const auto add = [&](std::size_t k) {
    const WhirlMode& mode = branch.modes[k];
    const double ratio = std::abs(mode.damping_ratio) < kRoundOff ? 0.0 : mode.damping_ratio;
    piece["speed"].push_back(shown(branch.speed[k] * kRpm));
    piece["frequency"].push_back(shown(std::abs(mode.frequency) * kHz));
    piece["damping"].push_back(shown(100.0 * ratio));
  };
  for (std::size_t k = 0; k < branch.modes.size(); ++k) {
    const std::string sense = sense_of(branch.modes[k], branch.speed[k]);
    if (k == 0 || piece["sense"] != sense) {
      if (k > 0) pieces.push_back(piece);
      piece = {{"sense", sense},
               {"speed", json::array()},
               {"frequency", json::array()},
               {"damping", json::array()}};
      if (k > 0) add(k - 1);
    }
    add(k);
  }
  pieces.push_back(piece);
}

// The modes at the scene's speed.
json operating(const WhirlSpectrum& spectrum) {
  return list_of(spectrum.modes, [&](const WhirlMode& mode) -> json {
    return {{"sense", sense_of(mode, spectrum.speed)},
            {"frequency", shown(std::abs(mode.frequency) * kHz)},
            {"damping", shown(100.0 * mode.damping_ratio)}};
  });
}

json campbell_json(const scene::Scene& scene, const Campbell& campbell) {
  const RotorAnalysis& analysis = campbell.analysis;
  json pieces = json::array(), critical = json::array();
  for (const WhirlBranch& branch : campbell.branches) add_pieces(branch, pieces);
  for (const double speed : analysis.critical_speeds) critical.push_back(shown(speed * kRpm));
  const std::optional<double> threshold = analysis.stability_threshold();
  return {{"top", shown(campbell.range * kRpm)},
          {"torsion", list_of(analysis.torsion,
                              [](const WhirlMode& mode) { return shown(mode.frequency * kHz); })},
          {"operating", operating(whirl_spectrum(analysis.system, scene.rotor.speed))},
          {"running", shown(std::abs(scene.rotor.speed) * kRpm)},
          {"critical", critical},
          {"threshold", threshold ? json(shown(*threshold * kRpm)) : json(nullptr)},
          {"pieces", pieces}};
}

json plane(const char* name, const PlaneShapes& shapes) {
  json modes = json::array();
  for (Eigen::Index j = 0; j < shapes.frequency.size(); ++j) {
    // All shapes have the same height in the picture.
    const double scale = 1.0 / shapes.shape.col(j).cwiseAbs().maxCoeff();
    modes.push_back({{"plane", name},
                     {"number", j + 1},
                     {"frequency", shown(shapes.frequency[j] * kHz)},
                     {"shape", list(shapes.shape.col(j), scale)},
                     {"at_stations", list(shapes.at_stations.col(j), scale)}});
  }
  return modes;
}

// mm: radius of a thin disc, from J_p = m r^2 / 2. null without a polar moment.
json disc_radius(const scene::Disc& disc) {
  if (!(disc.mass > 0.0 && disc.Jp > 0.0)) return nullptr;
  return shown(kMilli * std::sqrt(2.0 * disc.Jp / disc.mass));
}

// Each mode is numbered among the modes of its sense, of which the first are shown.
json whirl(const std::vector<WhirlShape>& shapes, double speed) {
  constexpr int kShown = 4;
  constexpr int kShapeDigits = 4;  // of a curve with height 1
  std::map<std::string, int> count;
  json all = json::array();
  for (const WhirlShape& whirl : shapes) {
    const std::string sense = sense_of(whirl.mode, speed);
    if (++count[sense] > kShown) continue;
    all.push_back(
        {{"sense", sense},
         {"number", count[sense]},
         {"frequency", shown(std::abs(whirl.mode.frequency) * kHz)},
         {"roundness", rounded(whirl.roundness, kShapeDigits)},
         {"shape", list_of(whirl.shape, [](double y) { return std::round(y * 1e4) / 1e4; })}});
  }
  return all;
}

json shapes_json(const scene::Scene& scene, const RotorAnalysis& analysis) {
  if (!analysis.shapes) return nullptr;
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  json modes = plane("x", analysis.shapes->x);
  if (!analysis.shapes->same_planes) {
    for (json& mode : plane("y", analysis.shapes->y)) modes.push_back(std::move(mode));
  }
  return {{"z", list(analysis.shapes->z, kMilli)},
          {"stations", list_of(analysis.shapes->stations,
                               [](const Station& station) -> json {
                                 return {{"kind", to_string(station.kind)},
                                         {"name", station.name},
                                         {"z", shown(kMilli * station.z)}};
                               })},
          {"sections", list_of(geometry.sections,
                               [](const scene::ShaftSection& section) -> json {
                                 return {{"from", kMilli * section.from},
                                         {"to", kMilli * section.to},
                                         {"diameter", kMilli * section.diameter},
                                         {"end_diameter", kMilli * section.outer_at(section.to)}};
                               })},
          {"discs", list_of(geometry.discs,
                            [](const scene::Disc& disc) -> json {
                              return {{"z", kMilli * disc.z}, {"radius", disc_radius(disc)}};
                            })},
          {"same_planes", analysis.shapes->same_planes},
          {"whirl", whirl(analysis.whirl_shapes, scene.rotor.speed)},
          {"modes", modes}};
}

// Covers the scene's speed and the next critical speed instead of all of them: two and a half times
// the scene's speed, or a quarter beyond the next critical speed.
double bode_range(const scene::Scene& scene, const Campbell& campbell) {
  const double speed = std::abs(scene.rotor.speed);
  const std::vector<double>& critical = campbell.analysis.critical_speeds;
  if (speed == 0.0) return campbell.range;
  const auto next = std::upper_bound(critical.begin(), critical.end(), speed);
  const double beyond = next == critical.end() ? 0.0 : 1.25 * *next;
  return std::min(campbell.range, std::max(2.5 * speed, beyond));
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

json modes_plots(const scene::Scene& scene, const Campbell& campbell) {
  return {{"campbell", campbell_json(scene, campbell)},
          {"shapes", shapes_json(scene, campbell.analysis)},
          {"bode", bode_data(scene, bode_range(scene, campbell))}};
}

}  // namespace rotorub
