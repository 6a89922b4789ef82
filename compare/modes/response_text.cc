#include "compare/modes/response_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::json;

// Empty if the rotor is at rest or has no vibration.
std::string vibration_sentence(const FreeOrbit& orbit, double speed) {
  const double limit = vibration_limit(speed);
  if (!std::isfinite(limit) || orbit.vibration == 0.0) return "";
  return fmt::format(
      "{:.4g} µm peak to peak; API 617 allows {:.4g} µm (at the probes near the bearings)",
      kMicro * orbit.vibration, kMicro * limit);
}

// "radius 636.1 µm" for a circle about the ring's centre.
std::string size_text(const FreeOrbit& orbit) {
  constexpr double kRoundOff = 1e-9;
  const double largest = *orbit.largest, radius = 0.5 * orbit.vibration;
  return std::abs(radius - largest) <= kRoundOff * largest
             ? fmt::format("radius {:.4g} µm", kMicro * largest)
             : fmt::format("up to {:.4g} µm from the middle of the ring", kMicro * largest);
}

// An orbit at a contact and its time: " before the loss".
struct TimedOrbit {
  const FreeOrbit& orbit;
  const char* when;
  bool in_service;  // of the whole machine, for which API 617 has its limit
};

std::vector<TimedOrbit> orbits_at(const ContactPlace& place, const RotorResponse& response) {
  const FreeOrbit& last = response.all.orbits[place.bearing];
  if (!response.before_loss) return {{last, "", true}};
  return {{response.before_loss->orbits[place.bearing], " before the loss", true},
          {last, " after the loss", false}};
}

std::vector<result::Part> orbit_parts(const ContactPlace& place, const TimedOrbit& at,
                                      double speed) {
  using result::Data, result::Sentence;
  const FreeOrbit& orbit = at.orbit;
  const std::string contact =
      place.name.empty() ? "the contact" : fmt::format("contact \"{}\"", place.name);
  const std::string where = fmt::format("free orbit at {}{}", contact, at.when);
  const double gap = place.clearance - orbit.largest.value_or(0.0);
  const auto known = [&](double value) { return orbit.largest ? number_or_null(value) : json(); };
  const Data data{"",
                  {{"orbit", number_or_null(orbit.largest)},
                   {"least_gap", known(gap)},
                   {"vibration", known(orbit.vibration)},
                   {"vibration_limit", known(vibration_limit(speed))},
                   {"refused", orbit.largest ? json() : json(orbit.refused)}}};
  if (!orbit.largest)
    return {data, result::line(fmt::format("  {}: none, {}", where, orbit.refused))};
  std::vector<result::Part> parts{
      data,
      Sentence{.text = fmt::format(
                   "{}: {}, {}", where, size_text(orbit),
                   gap > 0.0 ? fmt::format("least gap {:.4g} µm", kMicro * gap)
                             : fmt::format("{:.4g} µm more than the clearance", -kMicro * gap)),
               .lead = "  "}};
  const std::string vibration = at.in_service ? vibration_sentence(orbit, speed) : "";
  if (!vibration.empty())
    parts.emplace_back(
        Sentence{.text = fmt::format("vibration at {}: {}", contact, vibration), .lead = "  "});
  return parts;
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

std::optional<scene::Scene> before_loss(const scene::Scene& scene) {
  const auto comes_later = [](const scene::Force& f) {
    return f.kind == scene::ForceKind::kUnbalance && f.on > 0.0 && f.static_moment > 0.0;
  };
  if (std::ranges::none_of(scene.forces, comes_later)) return std::nullopt;
  scene::Scene before = scene;
  std::erase_if(before.forces, comes_later);
  return before;
}

std::vector<std::string> RotorResponse::notes() const {
  std::vector<std::string> notes = all.notes;
  notes.insert(notes.end(), few_modes.begin(), few_modes.end());
  return notes;
}

result::Section response_section(const ContactPlace& place, const RotorResponse& response,
                                 double speed) {
  const std::vector<TimedOrbit> orbits = orbits_at(place, response);
  result::Section section{"response", {result::Data{"before_loss", nullptr}}};
  if (response.before_loss)
    section.add({result::Section{"before_loss", orbit_parts(place, orbits.front(), speed)}});
  section.add(orbit_parts(place, orbits.back(), speed));
  return section;
}

}  // namespace rotorub
