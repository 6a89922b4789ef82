// Runs that explode, or whose step cannot work, end with a status and a reason, what there is kept;
// damping of any size is no reason.
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/scene/reader.h"
#include "tests/native_model/hard/rules.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using test::run_with;

scene::Scene with(const std::string& name, const std::vector<std::string>& overrides) {
  return scene::read_scene(std::string(ROTORUB_SOURCE_DIR) + "/mjcf/" + name + ".toml", overrides);
}

double error(const Trajectory& a, const Trajectory& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.rows(); ++k) {
    most = std::max(most, std::hypot(a.column("rotor_x")[k] - b.column("rotor_x")[k],
                                     a.column("rotor_y")[k] - b.column("rotor_y")[k]));
  }
  return most;
}

TEST(HardExploded, AnEmulatedSpringBeyondTheStepIsRefusedWithTheLimit) {
  const scene::Scene scene =
      with("bench_ring", {"controller={kind=\"passive\",stiffness=1e14}", "run.end=10ms"});
  const Trajectory t = run_with(scene, scene::Integrator::kVerlet);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("the limit of the controller's gains on the ring"), std::string::npos)
      << t.message;
  test::expect_refused_or_finite(t);
  // 2 / sqrt((1e9 + 1e5) / 1 kg) = 63 us.
  const scene::Scene stiff =
      with("bench_ring", {"controller={kind=\"passive\",stiffness=1e9}", "run.end=10ms"});
  EXPECT_EQ(run_with(stiff, scene::Integrator::kVerlet, 1e-4).status, Status::kStepTooLarge);
  const Trajectory exact = test::run_event(stiff);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  EXPECT_LT(error(exact, run_with(stiff, scene::Integrator::kVerlet, 1e-6)), 1e-5);
}

TEST(HardExploded, RotatingDampingOfAnySizeIsImplicit) {
  const scene::Scene scene = with("bench_ring", {"rotor.modal.internal_damping=[4.05e5]",
                                                 "contact.clearance=5mm", "run.end=0.1"});
  const Trajectory exact = test::run_event(scene);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  const Trajectory t = run_with(scene, scene::Integrator::kVerlet);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  EXPECT_EQ(t.statistics.impulse_total, exact.statistics.impulse_total);
  EXPECT_LT(error(exact, t), 1e-6);
}

TEST(HardExploded, AStrongDriveOnTorsionIsImplicit) {
  const scene::Scene scene =
      with("bench_ring",
           {"rotor.torsion={inertia=[4e-4],stiffness=[60.0],damping=[0.01],drive_shape=[-1.0]}",
            "drive.gain=100.0", "run.end=20ms"});
  const Trajectory exact = test::run_event(scene);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  const Trajectory t = run_with(scene, scene::Integrator::kVerlet);
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  EXPECT_LT(error(exact, t), 1e-5);
}

TEST(HardExploded, AFlightThroughTheRingEndsOrIsHeld) {
  const scene::Scene scene =
      with("bench_billiard", {"initial.vx=[300.0]", "initial.vy=[400.0]", "run.end=10ms"});
  const Trajectory t = run_with(scene, scene::Integrator::kVerlet);
  test::expect_refused_or_finite(t);
  if (t.status == Status::kOk) {
    EXPECT_LE(t.statistics.max_penetration, scene.first().contact->clearance);
  } else {
    EXPECT_EQ(t.status, Status::kOutOfRange) << t.message;
  }
}

TEST(HardExploded, AnUnstableMagnetLeavesItsAirGap) {
  const scene::Scene scene =
      with("bench_ring",
           {R"(actuator={kind="electromagnet",force_constant=1e-4,bias_current=3.0,air_gap=1e-3})",
            "stator.stiffness=1e3", "initial.stator=[1e-5,0]", "run.end=0.2"});
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_with(scene, integrator);
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
      with("bench_ring", {"drive.gain=10.0", "rotor.modal.inertia=1e-5", "run.end=0.1"});
  EXPECT_LT(error(test::run_event(stiff), run_with(stiff, scene::Integrator::kVerlet, 1e-5)), 1e-8);

  const scene::Scene rows =
      with("bench_ring", {"contact.compression_time=1e-3", "contact.expansion_time=5e-4",
                          "drive=none", "rotor.speed=0.0", "run.end=20ms", "run.output_step=20us"});
  EXPECT_EQ(run_with(rows, scene::Integrator::kVerlet, 1e-5).status, Status::kOk);

  const scene::Scene resting = with("bench_drop", {"initial.y=[-0.0005]"});
  for (const scene::Integrator integrator :
       {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_with(resting, integrator);
    EXPECT_EQ(t.status, Status::kOk) << t.message;
    // Of the weight over the clearance.
    EXPECT_LT(t.statistics.energy_residual(), 1e-5);
  }
}

// The impact is one row; the force of lasting contact does not grow as the step falls.
TEST(HardExploded, RestitutionZeroIsAnImpactAndNotAForce) {
  const scene::Scene scene = with("bench_ring", {"contact.restitution=0"});
  const Trajectory exact = test::run_event(scene);
  ASSERT_EQ(exact.impacts.size(), 1u);
  const double force = test::largest(exact.column("normal_force"));
  for (const double step : {1e-4, 1e-5, 1e-6}) {
    const Trajectory t = run_with(scene, scene::Integrator::kVerlet, step);
    ASSERT_EQ(t.impacts.size(), 1u) << step;
    EXPECT_NEAR(t.impacts[0].normal_impulse, exact.impacts[0].normal_impulse,
                0.05 * exact.impacts[0].normal_impulse);
    EXPECT_LT(test::largest(t.column("normal_force")), 1.05 * force) << step;
  }
}

// A rotor that no ring stops and that nothing holds is gone, and the run says so.
TEST(HardExploded, ARotorThatNothingHoldsLeaves) {
  const scene::Scene scene = scene::parse_scene(
      "[run]\nend = 3.0\nstep = 1e-3\n[rotor]\nspeed = 0.0\n[rotor.modal]\nmass = [2.0]\n"
      "stiffness = [0.0]\ndamping = [0.0]\n[[force]]\nkind = \"constant\"\n"
      "vector = [1e6, 0.0]\n",
      "gone.toml", {});
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = run_with(scene, integrator, 1e-3);
    EXPECT_EQ(t.status, Status::kOutOfRange) << static_cast<int>(integrator);
    EXPECT_NE(t.message.find("the rotor has left"), std::string::npos) << t.message;
    EXPECT_NEAR(t.end, std::sqrt(2.0 * 1e5 / 5e5), 2e-3);
  }
}

}  // namespace
}  // namespace rotorub
