#include "compare/modes_command.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "native_model/rotor/campbell.h"
#include "native_model/rotor/whirl_system.h"

namespace rotorub {
namespace {

constexpr double kRpm = 30.0 / std::numbers::pi;  // rpm in a rad/s
constexpr double kHz = 0.5 / std::numbers::pi;    // Hz in a rad/s

// Everything that is said, computed once for either form.
struct Analysis {
  std::vector<WhirlSpectrum> spectra;
  std::vector<double> critical_speeds;        // rad/s
  std::optional<double> stability_threshold;  // rad/s
  double stability_bound;                     // rad/s
  bool isotropic;
};

Analysis analyse(const scene::Scene& scene, std::vector<double> speeds) {
  if (speeds.empty()) speeds = {scene.rotor.speed};
  const WhirlSystem system = whirl_system(scene);
  Analysis analysis{{},
                    critical_speeds(system),
                    stability_threshold(system),
                    stability_bound(system),
                    system.isotropic};
  for (double speed : speeds) analysis.spectra.push_back(whirl_spectrum(system, speed));
  return analysis;
}

const char* sense(const WhirlMode& mode) {
  if (mode.frequency == 0.0) return mode.damping_ratio == 0.0 ? "rigid" : "overdamped";
  return mode.frequency > 0.0 ? "forward" : "backward";
}

std::string stability_text(const Analysis& analysis) {
  if (analysis.stability_threshold) {
    return fmt::format("unstable above {:.7g} rad/s ({:.7g} rpm)", *analysis.stability_threshold,
                       *analysis.stability_threshold * kRpm);
  }
  if (std::isinf(analysis.stability_bound)) return "no whirl grows at any speed";
  return fmt::format("no whirl grows up to {:.5g} rad/s ({:.5g} rpm)", analysis.stability_bound,
                     analysis.stability_bound * kRpm);
}

std::string spectrum_table(const WhirlSpectrum& spectrum) {
  std::string text =
      fmt::format("at {:.6g} rad/s ({:.6g} rpm)\n", spectrum.speed, spectrum.speed * kRpm);
  text += fmt::format("  {:<12}{:>14}{:>14}{:>16}\n", "whirl", "rad/s", "Hz", "damping ratio");
  for (const WhirlMode& mode : spectrum.modes) {
    const double size = std::abs(mode.frequency);
    text += fmt::format("  {:<12}{:>14.7g}{:>14.7g}{:>16.4g}\n", sense(mode), size, size * kHz,
                        mode.damping_ratio);
  }
  return text;
}

}  // namespace

nlohmann::json modes_json(const scene::Scene& scene, const std::vector<double>& speeds) {
  const Analysis analysis = analyse(scene, speeds);
  nlohmann::json spectra = nlohmann::json::array();
  for (const WhirlSpectrum& spectrum : analysis.spectra) {
    nlohmann::json modes = nlohmann::json::array();
    for (const WhirlMode& mode : spectrum.modes) {
      modes.push_back({{"frequency", mode.frequency}, {"damping_ratio", mode.damping_ratio}});
    }
    spectra.push_back({{"speed", spectrum.speed}, {"modes", modes}});
  }
  nlohmann::json result{{"speeds", spectra},
                        {"critical_speeds", analysis.critical_speeds},
                        {"stability_threshold", nullptr},
                        {"stability_bound", nullptr}};
  if (analysis.stability_threshold) result["stability_threshold"] = *analysis.stability_threshold;
  if (std::isfinite(analysis.stability_bound)) {
    result["stability_bound"] = analysis.stability_bound;
  }
  return result;
}

std::string modes_table(const scene::Scene& scene, const std::vector<double>& speeds) {
  const Analysis analysis = analyse(scene, speeds);
  std::string text = fmt::format("{}: whirl of the free rotor\n", scene.name);
  for (const WhirlSpectrum& spectrum : analysis.spectra) text += "\n" + spectrum_table(spectrum);

  text += fmt::format("\ncritical speeds, undamped, {}\n",
                      analysis.isotropic ? "forward whirl" : "whirl of either sense");
  for (double speed : analysis.critical_speeds) {
    text += fmt::format("  {:.7g} rad/s ({:.7g} rpm)\n", speed, speed * kRpm);
  }
  if (analysis.critical_speeds.empty()) text += "  none\n";

  text += "\n" + stability_text(analysis) + "\n";
  return text;
}

}  // namespace rotorub
