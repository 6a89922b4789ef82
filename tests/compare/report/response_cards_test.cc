// What the page of `modes` says at its top of the response at each contact.
#include <gtest/gtest.h>

#include <string>

#include "compare/modes/rotor_analysis.h"
#include "compare/report/modes_page.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

// 20 N that turn with it move it by 264 um at the first contact, by 793 um at the second, and ask
// the magnets for 0.3 A.
constexpr const char* kScene = R"(
[run]
end = 0.01
[rotor]
speed = 250.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[[force]]
kind = "synchronous"
amplitude = 20.0
[magnetic_bearing]
negative_stiffness = 0.0
[magnetic_bearing.control]
force_per_current = 1e-3
proportional = 1200.0
derivative = 0.0
current_limit = 0.1
[[contact]]
name = "near"
radius = 0.02
clearance = 0.5e-3
friction = 0.1
restitution = 0.3
[[contact]]
name = "far"
radius = 0.02
clearance = 0.6e-3
friction = 0.1
restitution = 0.3
shape = [3.0]
)";

TEST(ModesPage, HasACardOfTheResponseAtEachContact) {
  const scene::Scene s = scene::parse_scene(kScene, "scene.toml", {});
  const std::string page = modes_page(s, campbell_of(s, analyse_rotor(s, {})));
  for (const char* words :
       {"Free orbit at near, 2387.3 rpm", "least gap 23", "Free orbit at far, 2387.3 rpm",
        "touches, 19", "µm peak to peak, beyond the 25.4 µm of API 617",
        "Magnetic bearing, 2387.3 rpm", "beyond its current limit", "where its law is not linear",
        "least clearance, at contact near"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace rotorub
