// Two contacts of which one rolls faster than a step can follow.
#include <gtest/gtest.h>

#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

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
    const Status found = test::run_with(s, scene::Integrator::kVerlet, step).status;
    EXPECT_TRUE(found == Status::kOk || found == Status::kStepTooLarge) << step;
  }
  EXPECT_EQ(test::run_with(s, scene::Integrator::kVerlet, 1e-6).status, Status::kOk);
}

}  // namespace
}  // namespace rotorub
