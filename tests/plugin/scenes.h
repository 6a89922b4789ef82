// Scenes of the plugin's tests.
#pragma once

#include <string>

namespace rotorub::test {

// Two gyroscopic modes in two planes, rotating damping, spin held: everything that whirls, no
// contact.
inline const std::string kWhirl = R"(
[run]
end = 0.02
step = 1e-6
[rotor]
speed = "200 Hz"
[rotor.modal]
mass = [2.0, 0.8]
stiffness = [2e5, 1e6]
stiffness_y = [2.2e5, 1e6]
damping = [4.0, 6.0]
internal_damping = [2.0, 1.0]
gyroscopic = [0.3, 0.1]
[initial]
x = [2e-4, 1e-5]
vy = [0.1, -0.02]
)";

// The same without any damping, isotropic: its energy is constant.
inline const std::string kUndampedWhirl = R"(
[run]
end = 1.0
step = 1e-5
[rotor]
speed = "200 Hz"
[rotor.modal]
mass = [2.0, 0.8]
stiffness = [2e5, 1e6]
damping = [0.0, 0.0]
gyroscopic = [1.0, 0.4]
[initial]
x = [2e-4, 1e-5]
vy = [0.1, -0.02]
)";

// A rotor that is far from its ring, with nothing that the plugin has to add.
inline const std::string kNeverTouches = R"(
[run]
end = 0.1
step = 1e-5
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[contact]
radius = 0.05
clearance = "5 mm"
friction = 0.3
restitution = 0.5
[initial]
x = [1e-3]
vy = [0.2]
)";

// A synchronous full annular rub on a rigid ring; the closed form stands in exact_rub_test.cc.
inline const std::string kAnnularRub = R"(
[run]
end = 1.0
step = 1e-5
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [3e5]
damping = [40.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.2
restitution = 0.5
[[force]]
kind = "rotating"
amplitude = 200.0
frequency = "50 Hz"
)";

// A ring for it, on springs.
inline const std::string kElasticRing = R"(
[stator]
mass = 1.0
damping = 200.0
stiffness = 4e5
)";

// A shaft pressed on a fixed ring: friction brakes its free spin to rest, and holds it there.
inline const std::string kBrake = R"(
[run]
end = 0.1
step = 1e-5
[rotor]
speed = 10.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [2000.0]
inertia = 1e-2
[drive]
kind = "free"
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.5
restitution = 0.0
[[force]]
kind = "constant"
vector = [0.0, -100.0]
[initial]
y = [-0.5e-3]
)";

// A short shaft of segments that is thrown against its ring.
inline const std::string kSegmentRub = R"(
[run]
end = 0.02
step = 1e-6
[rotor]
speed = 100.0
length = 1.0
E = "210 GPa"
nu = 0.3
rho = 7850.0
modes = 2
[[rotor.section]]
from = 0.0
to = 1.0
diameter = "50 mm"
[[rotor.disc]]
z = 0.5
mass = 4.0
Jt = 0.01
Jp = 0.018
[[rotor.bearing]]
z = 0.0
stiffness = 2e7
[[rotor.bearing]]
z = 1.0
stiffness = 2e7
[contact]
station = 0.5
radius = 0.05
clearance = "0.2 mm"
friction = 0.2
restitution = 0.5
[stator]
mass = 0.5
damping = 200.0
stiffness = 1e5
[mujoco]
rotor = "segments"
segments = 4
[initial]
x = [1.9e-4, 0.0]
vx = [0.5, 0.0]
)";

}  // namespace rotorub::test
