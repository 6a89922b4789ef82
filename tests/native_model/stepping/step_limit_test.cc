// Steps that are too long for the loads are refused, or the run reports that its energy balance
// does not close.
#include "native_model/stepping/step_limit.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <string>

#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub::test {
namespace {

const Jeffcott kRotor{.stiffness = 2e5, .clearance = 2e-4, .friction = 0.1, .restitution = 0.5};

// 2 kg pressed with 300 N into a compliant wall.
scene::Scene pressed(Compliance law) {
  scene::Scene s = make_scene(kRotor);
  law.stiffness = 2e7;
  s.first().contact->compliance = law;
  add_constant_force(s, {300.0, 0.0});
  s.run.end = 0.02;
  return s;
}

// h < m / c of a damper whose rate is the mean of those at the step's ends.
TEST(StepLimit, IsThatOfTheContactsDamping) {
  const StepLimit stiff = step_limit(prepare(pressed({.damping = 1e9})));
  EXPECT_STREQ(stiff.of, "the contact's damping");
  EXPECT_NEAR(stiff.step, 2.0 / 1e9, 1e-12);
  EXPECT_GT(step_limit(prepare(pressed({.damping = 1e3}))).step, 1e-5);
  const Trajectory refused = attempt_with(pressed({.damping = 1e9}), scene::Integrator::kVerlet);
  EXPECT_EQ(refused.status, Status::kStepTooLarge) << refused.message;
}

TEST(StepLimit, IsHeldToTheDampingOfHuntAndCrossleyAsItGoes) {
  EXPECT_EQ(attempt_with(pressed({.hunt_crossley = 1e9}), scene::Integrator::kVerlet).status,
            Status::kStepTooLarge);
  run_with(pressed({.hunt_crossley = 1.0}), scene::Integrator::kVerlet);
}

// Two equal rings: it does not matter which of them has the controller.
TEST(StepLimit, IsThatOfTheControllerOfAnyRing) {
  scene::Scene plain = make_scene(kRotor);
  add_ring(plain, 1.0, 200.0, 1e5);
  plain.auxiliary.push_back(plain.first());
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
  const auto limit = [](double gain) {
    scene::Scene s = make_scene(kRotor);
    add_ring(s, 1.0, 100.0, 1e5);
    scene::Controller& c = s.first().controller.emplace();
    c.kind = scene::ControllerKind::kPd;
    c.sample_time = 1e-4;
    c.stiffness = gain;
    return step_limit(prepare(s));
  };
  EXPECT_STREQ(limit(1e12).of, "the controller's gains on the ring");
  EXPECT_LT(limit(1e12).step, 1e-5);
  EXPECT_GT(limit(1e6).step, 1e-5);
}

// ---------------------------------------------------------------- rolling
// Two contacts, of which one rolls faster than a step can follow.

// A rotor that rolls in its ring at 142,000 rad/s turns by a radian a step: such a step may be too
// large, but it is no jamming, which two equal planes and a held spin cannot have.
TEST(SeveralContacts, AWhirlThatOutrunsTheStepIsNoJamming) {
  const scene::Scene s = scene::parse_scene(R"([run]
end = 0.006
output_step = 0.0005
[rotor]
speed = 200.36947627437178
[rotor.modal]
mass = [4.011981656787932]
stiffness = [24176604.556414854]
damping = [393.9463801153694]
inertia = 0.0004909104499774304
stiffness_y = [19985947.127279736]
gyroscopic = [-1.0902793659575505]
[[contact]]
radius = 0.0510155024204074
clearance = 7.19726033733322e-05
friction = 0.5620548500785395
restitution = 0.0
tangential_restitution = 0.8906111326545659
offset = [4.015041819258156e-06, 5.370535719270383e-06]
[[contact]]
radius = 0.0441175888481947
clearance = 8.353372105301424e-05
friction = 0.0668393802093351
restitution = 0.36579745386957796
shape = [0.26797335501710506]
[contact.stator]
mass = [0.2033641153330159, 0.19980979396409154]
damping = 299.61066103074506
stiffness = [167546.21778781762, 166760.63814731356]
[[force]]
kind = "synchronous"
amplitude = -535.6047174359778
phase = 0.1715531230167615
[[force]]
kind = "synchronous"
shape = [-0.8536667378530975]
amplitude = -535.6047174359778
phase = -2.1917116100891594
on = 0.018927575010957664
[[force]]
kind = "synchronous"
amplitude = 535.6047174359778
phase = 0.529115820121631
on = 0.0009943138934952157
off = 0.01269481610774839
ramp = 0.0010273790077960116
[initial]
x = [2.3377444387272868e-06]
y = [-1.9428504066298532e-05]
vx = [-0.20795314757849612]
vy = [-0.05330240500428424]
spin_angle = -1.6419327104680812
)",
                                            "rolls");
  for (const double step : {8e-6, 4e-6}) {
    const Status found = test::attempt_with(s, scene::Integrator::kVerlet, step).status;
    EXPECT_TRUE(found == Status::kOk || found == Status::kStepTooLarge) << step;
  }
  test::run_with(s, scene::Integrator::kVerlet, 1e-6);
}

}  // namespace
}  // namespace rotorub::test
