// A minimal scene with contact.
#pragma once

namespace rotorub::test {

// A free mass in motion, without a spring to an equilibrium position.
inline constexpr const char* kThrown = R"(
[run]
end = 0.05
step = 1e-5
output_step = 1e-3
[rotor]
speed = 200.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
inertia = 2e-3
[contact]
radius = 0.02
clearance = 0.5e-3
friction = 0.2
restitution = 0.6
[initial]
vx = [0.1]
vy = [0.04]
)";

}  // namespace rotorub::test
