#include "compare/modes/response_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::json;

constexpr double kMicrons = 1e6;

// Empty: at rest, or nothing moves it about its mean.
std::string vibration_sentence(const FreeOrbit& orbit, double speed, const char* micron) {
  const double limit = vibration_limit(speed);
  if (!std::isfinite(limit) || orbit.vibration == 0.0) return "";
  return fmt::format("{:.5g} {} peak to peak, {} the {:.4g} {} of API 617",
                     kMicrons * orbit.vibration, micron,
                     orbit.vibration <= limit ? "within" : "beyond", kMicrons * limit, micron);
}

std::string contact_text(const ContactPlace& place, const FreeOrbit& orbit, double speed) {
  const std::string where =
      place.name.empty() ? "response at the contact" : "response at contact " + place.name;
  if (!orbit.largest) return fmt::format("  {}: none, {}\n", where, orbit.refused);
  const double gap = place.clearance - *orbit.largest;
  const std::string sentence = fmt::format(
      "{}: {:.4g} um from the middle of the ring, {}", where, kMicrons * *orbit.largest,
      gap > 0.0 ? fmt::format("least gap {:.4g} um", kMicrons * gap)
                : fmt::format("it touches: {:.4g} um beyond the clearance", -kMicrons * gap));
  const std::string vibration = vibration_sentence(orbit, speed, "um");
  return wrapped("  ", sentence) +
         (vibration.empty() ? "" : fmt::format("  vibration there: {}\n", vibration));
}

}  // namespace

std::vector<ContactPlace> contact_places(const scene::Scene& scene) {
  std::vector<ContactPlace> places;
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    if (!scene.auxiliary[k].contact) continue;
    places.push_back({k, scene.auxiliary.size() > 1 ? scene.name_of(k) : "",
                      scene.auxiliary[k].contact->clearance});
  }
  return places;
}

double vibration_limit(double speed) {
  const double rpm = std::abs(speed) * kRpm;
  return rpm > 0.0 ? 25.4e-6 * std::min(1.0, std::sqrt(12000.0 / rpm))
                   : std::numeric_limits<double>::infinity();
}

json response_json(const ContactPlace& place, const FreeResponse& response, double speed) {
  const FreeOrbit& orbit = response.orbits[place.bearing];
  if (!orbit.largest)
    return {{"orbit", nullptr},
            {"least_gap", nullptr},
            {"vibration", nullptr},
            {"vibration_limit", nullptr},
            {"refused", orbit.refused}};
  const double limit = vibration_limit(speed);
  return {{"orbit", *orbit.largest},
          {"least_gap", place.clearance - *orbit.largest},
          {"vibration", orbit.vibration},
          {"vibration_limit", std::isfinite(limit) ? json(limit) : json(nullptr)},
          {"refused", nullptr}};
}

std::string response_text(const std::vector<ContactPlace>& places, const FreeResponse& response,
                          double speed) {
  std::string text;
  for (const ContactPlace& place : places)
    text += contact_text(place, response.orbits[place.bearing], speed);
  for (const std::string& note : response.notes) text += wrapped("  ", "note: " + note);
  return text;
}

ResponseWords response_words(const ContactPlace& place, const FreeResponse& response,
                             double speed) {
  const FreeOrbit& orbit = response.orbits[place.bearing];
  if (!orbit.largest) return {false, "none", orbit.refused};
  const double gap = place.clearance - *orbit.largest;
  ResponseWords words{!(gap > 0.0),
                      gap > 0.0 ? fmt::format("least gap {:.4g} µm", kMicrons * gap)
                                : fmt::format("touches, {:.4g} µm beyond", -kMicrons * gap),
                      fmt::format("{:.4g} µm from the middle of the ring, clearance {:.4g} µm",
                                  kMicrons * *orbit.largest, kMicrons * place.clearance)};
  const std::string vibration = vibration_sentence(orbit, speed, "µm");
  if (!vibration.empty()) words.text += "; vibration " + vibration;
  return words;
}

}  // namespace rotorub
