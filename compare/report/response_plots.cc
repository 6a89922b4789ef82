#include "compare/report/response_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/units.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/report/plot_points.h"
#include "native_model/linear/synchronous_response.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr double kMicronsOfMetre = 1e6;  // um per m
constexpr int kResponseDigits = 5;

// running: rad/s, >= 0.
json curve_json(const ProbeResponse& probe, const std::vector<double>& speed, double running,
                bool same_planes) {
  json amplitude = json::array(), phase = json::array(), peaks = json::array();
  double last = 0.0;
  std::vector<double> phases;
  for (const std::complex<double>& x : probe.deflection) {
    if (std::isnan(x.real())) {
      amplitude.push_back(nullptr);
      phase.push_back(nullptr);
    } else {
      last = phase_degrees(x, last);
      amplitude.push_back(rounded(kMicronsOfMetre * std::abs(x), kResponseDigits));
      phase.push_back(rounded(last, kResponseDigits));
    }
    phases.push_back(last);
  }
  for (const ResponsePeak& peak : probe.peaks) {
    const auto at = std::upper_bound(speed.begin(), speed.end(), peak.speed) - speed.begin() - 1;
    const double beside = phases[static_cast<std::size_t>(std::max<std::ptrdiff_t>(at, 0))];
    std::optional<double> margin;
    if (peak.amplification && running > 0.0)
      margin = required_margin(*peak.amplification, peak.speed > running);
    peaks.push_back(
        {{"speed", rounded(kRpm * peak.speed)},
         {"amplitude", rounded(kMicronsOfMetre * std::abs(peak.deflection), kResponseDigits)},
         {"phase", rounded(phase_degrees(peak.deflection, beside), kResponseDigits)},
         {"factor",
          peak.amplification ? json(rounded(*peak.amplification, kResponseDigits)) : json()},
         {"margin", margin ? json(rounded(*margin, kResponseDigits)) : json()}});
  }
  return {{"name", probe.name},
          {"plane", same_planes        ? ""
                    : probe.plane == 0 ? "x"
                                       : "y"},
          {"amplitude", amplitude},
          {"phase", phase},
          {"peaks", peaks}};
}

// In the order of StiffnessMap::Of.
struct MapWords {
  const char *title, *axis, *reading;
};
constexpr MapWords kMapWords[] = {
    {"Critical speed map", "stiffness of a bearing",
     "how the undamped critical speeds change if the springs of all bearings become softer or "
     "stiffer in one proportion. A flat curve belongs to the shaft, a rising one to the bearings; "
     "where a curve meets the scene's speed, unbalance resonates"},
    {"Critical speed map of the magnets", "stiffness of a magnetic bearing",
     "how the undamped critical speeds change if all magnetic bearings become softer or stiffer in "
     "one proportion; their stiffness is the control's less the magnets' pull. A flat curve "
     "belongs to the shaft, a rising one to the magnets; where a curve meets the scene's speed, "
     "unbalance resonates; no line where the magnets do not bear the rotor"},
    {"Critical speed map of the ring", "stiffness of the ring's spring",
     "how the undamped critical speeds of the rotor with its centre held to the ring's, as in a "
     "synchronous rub, change if the spring that carries the ring becomes softer or stiffer. Where "
     "a solid curve meets the scene's speed, a rub resonates; dashed: the ring alone, √(k/m); long "
     "dashes: the rotor alone"},
    {"Critical speed map of the ring's mount", "stiffness of the mount",
     "the same if the mount of the ring becomes softer or stiffer. Where a solid curve meets the "
     "scene's speed, a rub resonates; dashed: ring and mount alone; long dashes: the rotor alone"},
};

// [[rpm]] of the k-th speed in each list; null if there is none.
json speed_curves(const std::vector<std::vector<double>>& speeds) {
  std::size_t most = 0;
  for (const auto& at : speeds) most = std::max(most, at.size());
  json curves = json::array();
  for (std::size_t k = 0; k < most; ++k) {
    curves.push_back(list_of(speeds, [&](const std::vector<double>& at) {
      return k < at.size() ? json(rounded(kRpm * at[k])) : json();
    }));
  }
  return curves;
}

}  // namespace

namespace {

// Interpolates the response linearly at the speeds of another one.
ProbeResponse on_speeds(const SynchronousResponse& response, const ProbeResponse& probe,
                        const std::vector<double>& speeds) {
  ProbeResponse out = probe;
  out.deflection.clear();
  const std::vector<double>& own = response.speed;
  for (const double speed : speeds) {
    const auto next =
        std::clamp<std::ptrdiff_t>(std::upper_bound(own.begin(), own.end(), speed) - own.begin(), 1,
                                   static_cast<std::ptrdiff_t>(own.size()) - 1);
    const auto k = static_cast<std::size_t>(next);
    const double share = (speed - own[k - 1]) / (own[k] - own[k - 1]);
    out.deflection.push_back(share <= 0.0   ? probe.deflection[k - 1]
                             : share >= 1.0 ? probe.deflection[k]
                                            : (1.0 - share) * probe.deflection[k - 1] +
                                                  share * probe.deflection[k]);
  }
  return out;
}

// If unbalance appears later, for example from a lost blade: the response without it and with it.
std::optional<SynchronousResponse> response_of(const scene::Scene& scene, double top) {
  auto after = synchronous_response(scene, top);
  const auto intact = before_loss(scene);
  if (!after || !intact) return after;
  const auto before = synchronous_response(*intact, top);
  if (!before || before->speed.size() < 2) return after;
  const std::size_t probes = std::min(before->probes.size(), after->probes.size());
  std::vector<ProbeResponse> both;
  for (std::size_t k = 0; k < probes; ++k) {
    both.push_back(on_speeds(*before, before->probes[k], after->speed));
    both.back().name += ", before the loss";
  }
  for (ProbeResponse& probe : after->probes) {
    both.push_back(std::move(probe));
    both.back().name += ", after it";
  }
  after->probes = std::move(both);
  return after;
}

}  // namespace

json bode_data(const scene::Scene& scene, double top) {
  const auto response = response_of(scene, top);
  if (!response) return nullptr;
  const bool held = std::ranges::any_of(scene.magnetic_bearings, [](const auto& bearing) {
    return bearing.control && bearing.control->works();
  });
  // The contact that is touched first if all stations move equally.
  const std::vector<ContactPlace> contacts = contact_places(scene);
  const auto least = std::ranges::min_element(contacts, {}, &ContactPlace::clearance);
  const bool several = contacts.size() > 1,
             alike = std::ranges::all_of(
                 contacts, [&](const auto&at) { return at.clearance == least->clearance; });
  // Half of the permitted peak-to-peak value.
  const auto limit = [](double speed) {
    return rounded(0.5 * kMicronsOfMetre * vibration_limit(speed), kResponseDigits);
  };
  return {{"speed", rounded_list(response->speed, kRpm)},
          {"running", rounded(std::abs(scene.rotor.speed) * kRpm)},
          {"forces", response->forces},
          {"clearance",
           least == contacts.end() ? json() : json(rounded(kMicronsOfMetre * least->clearance))},
          {"clearance_of", alike ? "clearance at the contact" + std::string(several ? "s" : "")
                                 : "least clearance, at contact " + least->name},
          {"limit", held ? list_of(response->speed, limit) : json()},
          {"curves", list_of(response->probes, [&](const ProbeResponse& probe) {
             return curve_json(probe, response->speed, std::abs(scene.rotor.speed),
                               response->same_planes);
           })}};
}

json stiffness_data(const scene::Scene& scene) {
  return list_of(stiffness_maps(scene), [&](const StiffnessMap& map) -> json {
    const MapWords& words = kMapWords[static_cast<std::size_t>(map.of)];
    const bool one_of_several = !map.ring.empty() && scene.auxiliary.size() > 1;
    return {
        {"stiffness", rounded_list(map.stiffness)},
        {"own", rounded(map.own)},
        {"title", one_of_several ? fmt::format("{}, {}", words.title, scene.name_of(map.contact))
                                 : words.title},
        {"words", words.reading},
        {"of", words.axis},
        {"curves", speed_curves(map.critical)},
        {"ring", speed_curves(map.ring)}};
  });
}

}  // namespace rotorub
