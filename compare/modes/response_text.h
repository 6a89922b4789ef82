// The response of the free rotor at each contact in `rotorub modes`: how far its centre moves under
// unbalance, weight and forces, and how much of the clearance is left.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/result/result.h"
#include "native_model/linear/steady_orbit.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// A contact at which the response is reported.
struct ContactPlace {
  std::size_t bearing = 0;  // among the scene's auxiliary bearings
  std::string name;         // empty if there is only one
  double clearance = 0.0;   // m
};
std::vector<ContactPlace> contact_places(const scene::Scene& scene);

// The scene without the unbalance that appears later, for example from a lost blade. Empty if all
// unbalance acts from the start.
std::optional<scene::Scene> before_loss(const scene::Scene& scene);

// The response at one spin speed.
struct RotorResponse {
  FreeResponse all;                         // to all loads, including those that begin later
  std::optional<FreeResponse> before_loss;  // of the scene before the loss
  // Sentences on how the omitted modes would change the response.
  std::vector<std::string> few_modes;

  std::vector<std::string> notes() const;  // the notes of `all`, then those on the modes
};

// Vibration limit of API 617, m peak to peak: 25.4 um sqrt(12000 rpm / speed), at most 25.4 um.
// speed: rad/s, either sign. Infinite at rest.
double vibration_limit(double speed);

// README.md lists its keys. People read the response before a loss first, with its vibration.
// speed: rad/s.
result::Section response_section(const ContactPlace& place, const RotorResponse& response,
                                 double speed);

}  // namespace rotorub
