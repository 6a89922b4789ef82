#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/report/modes_page.h"
#include "compare/report/rounded.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr int kPlotDigits = 7;

json list(const Eigen::VectorXd& values, double factor) {
  json out = json::array();
  for (double value : values) out.push_back(rounded(value * factor, kPlotDigits));
  return out;
}

// A branch cut where its sense changes, each piece from the last point of the one before.
void add_pieces(const WhirlBranch& branch, json& pieces) {
  constexpr double kRoundOff = 1e-10;  // of a damping ratio: an undamped mode
  json piece;
  const auto add = [&](std::size_t k) {
    const WhirlMode& mode = branch.modes[k];
    const double ratio = std::abs(mode.damping_ratio) < kRoundOff ? 0.0 : mode.damping_ratio;
    piece["speed"].push_back(rounded(branch.speed[k] * kRpm, kPlotDigits));
    piece["frequency"].push_back(rounded(std::abs(mode.frequency) * kHz, kPlotDigits));
    piece["damping"].push_back(rounded(100.0 * ratio, kPlotDigits));
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

// Where the branches are at the scene's speed.
json operating(const WhirlSpectrum& spectrum) {
  json modes = json::array();
  for (const WhirlMode& mode : spectrum.modes) {
    modes.push_back({{"sense", sense_of(mode, spectrum.speed)},
                     {"frequency", rounded(std::abs(mode.frequency) * kHz, kPlotDigits)},
                     {"damping", rounded(100.0 * mode.damping_ratio, kPlotDigits)}});
  }
  return modes;
}

json campbell(const scene::Scene& scene, const RotorAnalysis& analysis, double range,
              const std::vector<WhirlBranch>& branches) {
  json pieces = json::array();
  for (const WhirlBranch& branch : branches) add_pieces(branch, pieces);
  json critical = json::array();
  for (double speed : analysis.critical_speeds) {
    if (speed <= range) critical.push_back(rounded(speed * kRpm, kPlotDigits));
  }
  json threshold = nullptr;
  if (analysis.stability_threshold) {
    threshold = rounded(*analysis.stability_threshold * kRpm, kPlotDigits);
  }
  json torsion = json::array();
  for (const WhirlMode& mode : analysis.torsion)
    torsion.push_back(rounded(mode.frequency * kHz, kPlotDigits));
  return {{"top", rounded(range * kRpm, kPlotDigits)},
          {"torsion", torsion},
          {"operating", operating(whirl_spectrum(analysis.system, scene.rotor.speed))},
          {"running", rounded(std::abs(scene.rotor.speed) * kRpm, kPlotDigits)},
          {"critical", critical},
          {"threshold", threshold},
          {"pieces", pieces}};
}

json plane(const char* name, const PlaneShapes& shapes) {
  json modes = json::array();
  for (Eigen::Index j = 0; j < shapes.frequency.size(); ++j) {
    // Of one height in the picture, whatever the value at the contact.
    const double scale = 1.0 / shapes.shape.col(j).cwiseAbs().maxCoeff();
    modes.push_back({{"plane", name},
                     {"number", j + 1},
                     {"frequency", rounded(shapes.frequency[j] * kHz, kPlotDigits)},
                     {"shape", list(shapes.shape.col(j), scale)},
                     {"at_stations", list(shapes.at_stations.col(j), scale)}});
  }
  return modes;
}

// mm; of a disc that is thin, from J_p = m r^2 / 2. Null without a polar moment.
json disc_radius(const scene::Disc& disc) {
  if (!(disc.mass > 0.0 && disc.Jp > 0.0)) return nullptr;
  return rounded(kMilli * std::sqrt(2.0 * disc.Jp / disc.mass), kPlotDigits);
}

// A mode has its number among those of its sense.
json whirl(const std::vector<WhirlShape>& shapes, double speed) {
  constexpr int kShapeDigits = 4;  // of a curve 1 high
  json all = json::array();
  std::map<std::string, int> count;
  for (const WhirlShape& whirl : shapes) {
    json line = json::array();
    for (const double value : whirl.shape) line.push_back(std::round(value * 1e4) / 1e4);
    const std::string sense = sense_of(whirl.mode, speed);
    all.push_back({{"sense", sense},
                   {"number", ++count[sense]},
                   {"frequency", rounded(std::abs(whirl.mode.frequency) * kHz, kPlotDigits)},
                   {"roundness", rounded(whirl.roundness, kShapeDigits)},
                   {"shape", line}});
  }
  return all;
}

json shapes(const scene::Scene& scene, const RotorAnalysis& analysis) {
  if (!analysis.shapes) return nullptr;
  const scene::RotorGeometry& geometry = *scene.rotor.geometry;
  json sections = json::array();
  for (const scene::ShaftSection& section : geometry.sections) {
    sections.push_back({{"from", kMilli * section.from},
                        {"to", kMilli * section.to},
                        {"diameter", kMilli * section.diameter},
                        {"end_diameter", kMilli * section.outer_at(section.to)}});
  }
  json discs = json::array();
  for (const scene::Disc& disc : geometry.discs) {
    discs.push_back({{"z", kMilli * disc.z}, {"radius", disc_radius(disc)}});
  }
  json stations = json::array();
  for (const Station& station : analysis.shapes->stations) {
    stations.push_back({{"kind", to_string(station.kind)},
                        {"name", station.name},
                        {"z", rounded(kMilli * station.z, kPlotDigits)}});
  }
  json modes = plane("x", analysis.shapes->x);
  if (!analysis.shapes->same_planes) {
    for (json& mode : plane("y", analysis.shapes->y)) modes.push_back(std::move(mode));
  }
  return {{"z", list(analysis.shapes->z, kMilli)},
          {"stations", stations},
          {"sections", sections},
          {"discs", discs},
          {"same_planes", analysis.shapes->same_planes},
          {"whirl", whirl(analysis.whirl_shapes, scene.rotor.speed)},
          {"modes", modes}};
}

}  // namespace

double campbell_range(const scene::Scene& scene, const RotorAnalysis& analysis) {
  constexpr double kFar = 4.0;      // times what is shown anyway: too far to be shown too
  constexpr double kMargin = 1.15;  // beyond the last thing of interest
  double shown = std::abs(scene.rotor.speed);
  for (const WhirlSpectrum& spectrum : analysis.spectra) {
    shown = std::max(shown, std::abs(spectrum.speed));
  }
  for (double speed : analysis.critical_speeds) {
    if (shown == 0.0 || speed <= kFar * shown) shown = std::max(shown, speed);
  }
  const std::optional<double> threshold = analysis.stability_threshold;
  if (threshold && (shown == 0.0 || *threshold <= kFar * shown)) {
    shown = std::max(shown, *threshold);
  }
  // Nothing turns and nothing is critical: as far as the highest frequency.
  if (shown == 0.0) shown = std::abs(analysis.spectra.front().modes.back().frequency);
  return kMargin * (shown > 0.0 ? shown : 1.0);
}

json modes_plots(const scene::Scene& scene, const RotorAnalysis& analysis, double range,
                 const std::vector<WhirlBranch>& branches) {
  return {{"campbell", campbell(scene, analysis, range, branches)},
          {"shapes", shapes(scene, analysis)}};
}

}  // namespace rotorub
