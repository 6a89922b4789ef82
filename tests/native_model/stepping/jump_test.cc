// `verlet` keeps its order where a load or a command jumps within a step in lasting contact: the
// contact may open there, the slip stop or turn. The jump stands at the same share of a step all
// along a ladder of steps, and away from its middle.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

constexpr double kJumpOrder = 1.9;
constexpr double kWithImpacts = 1.7;  // which fall at random within their steps
constexpr double kInstant = 0.02;     // s

// A rotor that is pressed onto the ring from the start.
constexpr const char* kPressed = R"(
[run]
end = 0.03
output_step = 1e-3
[rotor]
speed = 300.0
[rotor.modal]
mass = [2.0]
stiffness = [2e4]
damping = [400.0]
[contact]
radius = 0.05
clearance = 0.5e-3
friction = 0.15
restitution = 0.3
[[force]]
kind = "constant"
vector = [100.0, 0.0]
[initial]
x = [0.5e-3]
)";
const std::string kRing = "stator={mass=20.0,damping=400.0,stiffness=1e5}";

scene::Scene pressed(const std::vector<std::string>& overrides) {
  return scene::parse_scene(kPressed, "pressed.toml", overrides);
}

// `jump`: the override that makes it, with AT for its instant.
std::vector<std::string> jumping(std::string jump, std::vector<std::string> others, double at) {
  jump.replace(jump.find("AT"), 2, std::to_string(1e9 * at) + "e-9");
  others.push_back(jump);
  return others;
}

void expect_order_two(const std::string& jump, const std::vector<std::string>& others,
                      double least = kJumpOrder) {
  for (const double share : {0.1, 0.3, 0.5, 0.75, 0.95}) {
    const auto c = test::convergence({1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6, 2.5e-6}, [&](double step) {
      const scene::Scene scene = pressed(jumping(jump, others, kInstant + share * step));
      const Trajectory exact = test::run_event(scene);
      const Trajectory t = test::run_with(scene, scene::Integrator::kVerlet, step);
      return test::trajectory_error(t, exact, 0.05);
    });
    EXPECT_GE(c.order(), least) << "at " << share << " of a step: " << c.text();
  }
}

TEST(VerletJump, ALoadThatEndsOpensTheContact) {
  expect_order_two("force[0].off=AT", {});
  expect_order_two("force[0].off=AT", {kRing});
}

TEST(VerletJump, ALoadThatComesOpensTheContact) {
  expect_order_two("force[1]={kind='constant',vector=[-150.0,60.0],on=AT}",
                   {kRing, "contact.restitution=0.0"});
}

// The spin is free: the steps are iterated.
TEST(VerletJump, ALoadThatEndsOpensTheContactOfADrivenRotor) {
  expect_order_two("force[0].off=AT",
                   {kRing, "rotor.modal.inertia=1e-3", "rotor.modal.gyroscopic=[1e-3]",
                    "drive={kind='linear',gain=0.5,speed=300.0}"});
}

// It sticks and is torn off; it slides and is stopped.
TEST(VerletJump, ALoadAcrossTurnsTheSlip) {
  const std::vector<std::string> still = {kRing, "rotor.speed=0.0", "contact.friction=0.5"};
  expect_order_two("force[1]={kind='constant',vector=[0.0,80.0],on=AT}", still);
}

TEST(VerletJump, AMagneticBearingThatFailsOpensTheContact) {
  expect_order_two(
      "magnetic_bearing={negative_stiffness=4.5e4,control={force_per_current=60.0,"
      "proportional=2500.0,derivative=3.0,fails_at=AT}}",
      {kRing, "force[0].vector=[-60.0,-20.0]", "initial.x=[-0.5e-3]"});
}

TEST(VerletJump, AControllerSwitchedOnOpensTheContact) {
  expect_order_two(
      "controller={kind='sliding',on=AT,gap_time=4e-3,bandwidth=400.0,boundary_layer=0.1,"
      "switching_gain=60.0}",
      {kRing, "contact.restitution=0.0"}, kWithImpacts);
  expect_order_two("controller={kind='passive',stiffness=2e6,damping=10.0,on=AT}", {kRing});
  expect_order_two("controller={kind='passive',stiffness=1e5,sample_time=4e-3,on=AT}", {kRing});
}

// The mean of a coil's rates before and after the jump, at its limit, is not the rate under the
// mean command.
TEST(VerletJump, AControllerSwitchedOnFindsItsCoilsAtTheirLimit) {
  const std::string coils =
      "actuator={kind='electromagnet',force_constant=8e-6,bias_current=2.0,air_gap=2e-3,"
      "stiffness=4e3,current_limit=1.5,";
  for (const char* limit : {"coil_lag=2e-4,current_rate_limit=100.0}",
                            "inductance=0.05,resistance=1.0,coil_lag=2e-4,voltage_limit=5.0}"}) {
    expect_order_two("controller={kind='passive',stiffness=2e4,damping=10.0,on=AT}",
                     {kRing, coils + limit});
  }
}

// Where round-off alone decides in which step it is: at both neighbours of a step's begin and end.
TEST(VerletJump, AtTheEdgeOfAStep) {
  const double step = 1e-5;
  for (const int k : {1999, 2000, 2001, 2003}) {
    const double edge = (k + 0.5) * step;
    for (const double at :
         {std::nextafter(edge, 0.0), edge, std::nextafter(edge, 1.0), k * step + 0.5 * step}) {
      scene::Scene scene = pressed({kRing});
      scene.forces[0].off = at;
      const Trajectory exact = test::run_event(scene);
      const Trajectory t = test::run_with(scene, scene::Integrator::kVerlet, step);
      EXPECT_LT(test::trajectory_error(t, exact), 1e-9) << k << " " << at;
    }
  }
}

}  // namespace
}  // namespace rotorub
