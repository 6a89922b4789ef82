// A shaft with a disc over its auxiliary bearing, without the bearings that support it.
#pragma once

#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub::test {

inline constexpr const char* kFreeShaft = R"(
[run]
end = 0.05
step = 1e-5
output_step = 1e-3
[rotor]
speed = 300.0
length = 0.60
E = 2.1e11
nu = 0.3
rho = 7850.0
modes = 4
[[rotor.section]]
from = 0.0
to = 0.60
diameter = 0.018
[[rotor.disc]]
z = 0.35
mass = 2.0
Jt = 1.8e-3
Jp = 3.6e-3
eccentricity = 40e-6
[contact]
station = 0.46
radius = 0.02
clearance = 0.3e-3
friction = 0.2
restitution = 0.4
[gravity]
acceleration = [0.0, -9.81]
)";

// The shaft with the tables `bearings`.
inline scene::Scene held_shaft(const std::string& bearings,
                               const std::vector<std::string>& overrides = {}) {
  return scene::parse_scene(kFreeShaft + bearings, "shaft.toml", overrides);
}

// Why its model is refused; empty if it is accepted.
inline std::string model_refusal(const scene::Scene& scene) {
  return message_of<scene::SceneError>([&] { prepare(scene); });
}

}  // namespace rotorub::test
