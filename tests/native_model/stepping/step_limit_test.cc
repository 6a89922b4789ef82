// Steps that are too long for what acts in them are refused, or the run says that its energy does
// not add up.
#include "native_model/stepping/step_limit.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

scene::Scene scene_of(const std::string& text) { return scene::parse_scene(text, "made.toml"); }

// 2 kg pressed with 300 N into a wall that gives.
scene::Scene pressed(const std::string& law) {
  return scene_of(R"(
[run]
end = 0.02
step = 1e-5
integrator = "verlet"
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [0.0]
[contact]
radius = 0.05
clearance = 2e-4
friction = 0.1
restitution = 0.5
[contact.compliance]
stiffness = 2e7
)" + law + R"([[force]]
kind = "constant"
vector = [300.0, 0.0]
)");
}

// h < m / c of a damper whose rate is the mean of those at the step's ends.
TEST(StepLimit, IsThatOfTheContactsDamping) {
  const StepLimit stiff = step_limit(prepare(pressed("damping = 1e9\n")));
  EXPECT_STREQ(stiff.of, "the contact's damping");
  EXPECT_NEAR(stiff.step, 2.0 / 1e9, 1e-12);
  EXPECT_GT(step_limit(prepare(pressed("damping = 1e3\n"))).step, 1e-5);
  const Trajectory refused = run_with(pressed("damping = 1e9\n"), scene::Integrator::kVerlet);
  EXPECT_EQ(refused.status, Status::kStepTooLarge) << refused.message;
}

TEST(StepLimit, IsHeldToTheDampingOfHuntAndCrossleyAsItGoes) {
  EXPECT_EQ(run_with(pressed("hunt_crossley = 1e9\n"), scene::Integrator::kVerlet).status,
            Status::kStepTooLarge);
  EXPECT_EQ(run_with(pressed("hunt_crossley = 1.0\n"), scene::Integrator::kVerlet).status,
            Status::kOk);
}

// Two equal rings: it does not matter which one has the controller.
TEST(StepLimit, IsThatOfTheControllerOfAnyRing) {
  const std::string ring = R"(
[[contact]]
radius = 0.05
clearance = 2e-4
friction = 0.1
restitution = 0.5
[contact.stator]
mass = 1.0
damping = 200.0
stiffness = 1e5
)";
  const scene::Scene plain = scene_of(R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [0.0]
)" + ring + ring);
  double limit[2];
  for (std::size_t k = 0; k < 2; ++k) {
    scene::Scene s = plain;
    scene::Controller& c = s.auxiliary[k].controller.emplace();
    c.kind = scene::ControllerKind::kPassive;
    c.damping = 1e7;
    const StepLimit found = step_limit(prepare(s));
    EXPECT_STREQ(found.of, "the controller's gains on the ring");
    limit[k] = found.step;
  }
  EXPECT_EQ(limit[0], limit[1]);
}

TEST(StepLimit, IsThatOfASampledLawToo) {
  const auto limit = [](const std::string& gain) {
    return step_limit(prepare(scene_of(R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = 300.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [0.0]
[contact]
radius = 0.05
clearance = 2e-4
friction = 0.1
restitution = 0.5
[stator]
mass = 1.0
stiffness = 1e5
damping = 100.0
[actuator]
force_limit = 1000.0
[controller]
kind = "pd"
sample_time = 1e-4
damping = 0.0
stiffness = )" + gain + "\n")));
  };
  EXPECT_STREQ(limit("1e12").of, "the controller's gains on the ring");
  EXPECT_LT(limit("1e12").step, 1e-5);
  EXPECT_GT(limit("1e6").step, 1e-5);
}

}  // namespace
}  // namespace rotorub::test
