// The response of the free rotor at each contact, as `rotorub modes` says it: how far its centre
// goes under unbalance, weight and forces, and what is left of the clearance there.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "native_model/linear/steady_orbit.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// A contact beside which the response is told.
struct ContactPlace {
  std::size_t bearing = 0;  // among the scene's auxiliary bearings
  std::string name;         // empty: there is one alone
  double clearance = 0.0;   // m
};
std::vector<ContactPlace> contact_places(const scene::Scene& scene);

// The scene without the unbalance that comes later, as that of a lost blade does; nothing where
// none comes.
std::optional<scene::Scene> before_loss(const scene::Scene& scene);

// The response at one spin speed.
struct RotorResponse {
  FreeResponse all;                         // to all loads that come to act
  std::optional<FreeResponse> before_loss;  // of that scene
  std::vector<std::string> few_modes;       // sentences on what the modes left out would change

  std::vector<std::string> notes() const;  // those of `all`, then those on the modes
};

// m, peak to peak, of API 617: 25.4 um sqrt(12000 rpm / speed), and no more than 25.4 um; speed:
// rad/s, either sign. For a rotor at rest infinity.
double vibration_limit(double speed);

// {"orbit": m or null, how far the rotor's centre goes from the ring's (linear/steady_orbit.h),
// "least_gap": m, < 0 where it would touch, or null, "vibration": m, peak to peak,
// "vibration_limit": m, that of API 617 at this speed, null at rest, "refused": why there is no
// such orbit, or null, "before_loss": the same without it of the scene before a loss, or null}.
// speed: rad/s.
nlohmann::json response_json(const ContactPlace& place, const RotorResponse& response,
                             double speed);

// For people: of each contact, before and after a loss, then the notes; ends with a line break, or
// is empty.
std::string response_text(const std::vector<ContactPlace>& places, const RotorResponse& response,
                          double speed);

// For the page's cards, one, or two where a blade is lost: what is left of the clearance, and the
// orbit.
struct ResponseWords {
  bool touches = false;
  std::string title, headline, text;
};
std::vector<ResponseWords> response_words(const ContactPlace& place, const RotorResponse& response,
                                          double speed);

}  // namespace rotorub
