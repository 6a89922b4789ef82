// Runs that explode, or whose step cannot work, end with a status and a reason, and keep their
// results; strong damping does not end a run.
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/scene/reader.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::rotor_error;
using test::run_with;
using test::shipped;

TEST(HardExploded, AnEmulatedSpringBeyondTheStepIsRefusedWithTheLimit) {
  const scene::Scene scene =
      shipped("bench_ring", {"controller={kind=\"passive\",stiffness=1e14}", "run.end=10ms"});
  const Trajectory t = test::attempt_with(scene, scene::Integrator::kVerlet);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("the limit of the controller's gains on the ring"), std::string::npos)
      << t.message;
  test::expect_refused_or_finite(t);
  // 2 / sqrt((1e9 + 1e5) / 1 kg) = 63 us.
  const scene::Scene stiff =
      shipped("bench_ring", {"controller={kind=\"passive\",stiffness=1e9}", "run.end=10ms"});
  EXPECT_EQ(test::attempt_with(stiff, scene::Integrator::kVerlet, 1e-4).status,
            Status::kStepTooLarge);
  const Trajectory exact = test::run_event(stiff);
  EXPECT_LT(rotor_error(exact, run_with(stiff, scene::Integrator::kVerlet, 1e-6)), 1e-5);
}

TEST(HardExploded, RotatingDampingOfAnySizeIsImplicit) {
  const scene::Scene scene = shipped("bench_ring", {"rotor.modal.internal_damping=[4.05e5]",
                                                    "contact.clearance=5mm", "run.end=0.1"});
  const Trajectory exact = test::run_event(scene);
  const Trajectory t = run_with(scene, scene::Integrator::kVerlet);
  EXPECT_EQ(t.statistics.impulse_total, exact.statistics.impulse_total);
  EXPECT_LT(rotor_error(exact, t), 1e-6);
}

TEST(HardExploded, AStrongDriveOnTorsionIsImplicit) {
  const scene::Scene scene =
      shipped("bench_ring",
              {"rotor.torsion={inertia=[4e-4],stiffness=[60.0],damping=[0.01],drive_shape=[-1.0]}",
               "drive.gain=100.0", "run.end=20ms"});
  const Trajectory exact = test::run_event(scene);
  const Trajectory t = run_with(scene, scene::Integrator::kVerlet);
  EXPECT_LT(rotor_error(exact, t), 1e-5);
}

TEST(HardExploded, AFlightThroughTheRingEndsOrIsHeld) {
  const scene::Scene scene =
      shipped("bench_billiard", {"initial.vx=[300.0]", "initial.vy=[400.0]", "run.end=10ms"});
  const Trajectory t = test::attempt_with(scene, scene::Integrator::kVerlet);
  test::expect_refused_or_finite(t);
  if (t.status == Status::kOk) {
    EXPECT_LE(t.statistics.max_penetration, scene.first().contact->clearance);
  } else {
    EXPECT_EQ(t.status, Status::kOutOfRange) << t.message;
  }
}

TEST(HardExploded, AnUnstableMagnetLeavesItsAirGap) {
  const scene::Scene scene = shipped(
      "bench_ring",
      {R"(actuator={kind="electromagnet",force_constant=1e-4,bias_current=3.0,air_gap=1e-3})",
       "stator.stiffness=1e3", "initial.stator=[1e-5,0]", "run.end=0.2"});
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = test::attempt_with(scene, integrator);
    EXPECT_EQ(t.status, Status::kOutOfRange) << t.message;
    EXPECT_NE(t.message.find("air gap"), std::string::npos) << t.message;
    test::expect_refused_or_finite(t);
  }
}

// A balance of the energy that does not close tells of the order of a scheme, and is no reason
// either: a motor that holds the speed within a step, a row within an impact, a rotor that is at
// rest.
TEST(HardExploded, ABalanceThatDoesNotCloseEndsNoRun) {
  const scene::Scene stiff =
      shipped("bench_ring", {"drive.gain=10.0", "rotor.modal.inertia=1e-5", "run.end=0.1"});
  EXPECT_LT(rotor_error(test::run_event(stiff), run_with(stiff, scene::Integrator::kVerlet, 1e-5)),
            1e-8);

  const scene::Scene rows = shipped(
      "bench_ring", {"contact.compression_time=1e-3", "contact.expansion_time=5e-4", "drive=none",
                     "rotor.speed=0.0", "run.end=20ms", "run.output_step=20us"});
  run_with(rows, scene::Integrator::kVerlet, 1e-5);

  const scene::Scene resting = shipped("bench_drop", {"initial.y=[-0.0005]"});
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_with(resting, integrator);
    // Relative to the weight times the clearance.
    EXPECT_LT(t.statistics.energy_residual(), 1e-5);
  }
}

// A rotor that nothing holds or stops leaves its machine, and the run reports it.
TEST(HardExploded, ARotorThatNothingHoldsLeaves) {
  const scene::Scene scene = scene::parse_scene(
      "[run]\nend = 3.0\nstep = 1e-3\n[rotor]\nspeed = 0.0\n[rotor.modal]\nmass = [2.0]\n"
      "stiffness = [0.0]\ndamping = [0.0]\n[[force]]\nkind = \"constant\"\n"
      "vector = [1e6, 0.0]\n",
      "gone.toml", {});
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = test::attempt_with(scene, integrator, 1e-3);
    EXPECT_EQ(t.status, Status::kOutOfRange) << static_cast<int>(integrator);
    EXPECT_NE(t.message.find("the rotor has left"), std::string::npos) << t.message;
    EXPECT_NEAR(t.end, std::sqrt(2.0 * 1e5 / 5e5), 2e-3);
  }
}

}  // namespace
}  // namespace rotorub
