// A levitated rotor, and how it drops into its ring: MuJoCo against the native `event` and `verlet`
// integrators.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compare/engine/mujoco_engine.h"
#include "native_model/run/run_native.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

constexpr double kStep = 1e-5;

scene::Scene touchdown(double end, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"rotor.modes=2", "run.output_step=2e-4",
                                        "magnetic_bearing.control.fails_at=5.003e-3"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  scene::Scene s = shipped("touchdown", overrides);
  s.run.end = end;
  return s;
}

Trajectory native(const scene::Scene& scene, scene::Integrator integrator) {
  NativeOptions options;
  options.integrator = integrator;
  options.step = kStep;
  Trajectory t = run_native(scene, options);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  return t;
}

// `rigid` takes the native step: the fall, the first impacts, and the current.
TEST(TouchdownEngine, RigidIsVerletUpToAndOverTheTouch) {
  const scene::Scene scene = touchdown(0.02);
  const Trajectory exact = native(scene, scene::Integrator::kEvent);
  const Trajectory verlet = native(scene, scene::Integrator::kVerlet);
  const Trajectory rigid = mujoco_run(scene, scene::ContactModel::kRigid, kStep);
  ASSERT_FALSE(exact.impacts.empty());
  ASSERT_FALSE(rigid.impacts.empty());
  EXPECT_LT(rotor_error(rigid, verlet), 1e-9 * scene.first().contact->clearance);
  EXPECT_LT(rotor_error(rigid, exact), 1e-3 * scene.first().contact->clearance);
  EXPECT_NEAR(rigid.impacts[0].t, exact.impacts[0].t, kStep);
  const auto &a = rigid.column("bearing_current_y"), &b = verlet.column("bearing_current_y");
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-6) << k;
  EXPECT_GT(a.front(), 0.05);
  EXPECT_EQ(a.back(), 0.0);
  EXPECT_LT(rigid.statistics.energy_residual(), 1e-3);
}

// The limit of the current too: thrown at it from rest, without a contact.
TEST(TouchdownEngine, SoftContactsSeeTheSameBearing) {
  const scene::Scene scene =
      touchdown(0.01, {"initial={vx=[0.05,0.0]}", "magnetic_bearing.control.current_limit=0.5",
                       "contact.clearance=0.02"});
  const Trajectory exact = native(scene, scene::Integrator::kEvent);
  const double coarse = rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, 1e-5), exact);
  const double fine = rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, 2.5e-6), exact);
  EXPECT_LT(coarse, 1e-6);
  EXPECT_LT(fine, 0.3 * coarse);  // MuJoCo's own step is of first order
}

// What the integrator holds is in MuJoCo's state: modes, segments and soft contacts have it.
TEST(TouchdownEngine, TheIntegratorIsTheSameInMujoco) {
  const std::vector<std::string> more = {
      "magnetic_bearing.control.integral=2e5", "initial.steady=false",
      "magnetic_bearing.control.fails_at=1.0", "contact.clearance=0.02"};
  const scene::Scene scene = touchdown(0.025, more);
  const Trajectory exact = native(scene, scene::Integrator::kEvent);
  const Trajectory verlet = native(scene, scene::Integrator::kVerlet);
  const Trajectory rigid = mujoco_run(scene, scene::ContactModel::kRigid, kStep);
  EXPECT_LT(rotor_error(rigid, verlet), 1e-9 * scene.first().contact->clearance);
  EXPECT_LT(rotor_error(rigid, exact), 1e-6);
  const double coarse = rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, 1e-5), exact);
  const double fine = rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, 2.5e-6), exact);
  EXPECT_LT(fine, 0.3 * coarse);
  // The integrator matters: without it the rotor is elsewhere by far more than all of these.
  const Trajectory without =
      native(touchdown(0.025, {"initial.steady=false", "contact.clearance=0.02",
                               "magnetic_bearing.control.fails_at=1.0"}),
             scene::Integrator::kEvent);
  EXPECT_GT(rotor_error(without, exact), 1e-5);
  auto chain = more;
  chain.insert(chain.end(),
               {"rotor.modes=6", "mujoco.rotor=segments", "mujoco.segments=12", "run.step=2e-6"});
  const scene::Scene segmented = touchdown(0.025, chain);
  const Trajectory segments = mujoco_run(segmented, scene::ContactModel::kRigid, 2e-6);
  EXPECT_LT(rotor_error(segments, native(segmented, scene::Integrator::kEvent)), 2e-6);
}

// Rigid segments see the magnets at their own station.
TEST(TouchdownEngine, SegmentsFallAsTheModesDo) {
  const scene::Scene scene = touchdown(
      0.0115, {"rotor.modes=6", "mujoco.rotor=segments", "mujoco.segments=12", "run.step=2e-6"});
  const Trajectory exact = native(scene, scene::Integrator::kEvent);
  const Trajectory segments = mujoco_run(scene, scene::ContactModel::kRigid, 2e-6);
  EXPECT_GT(std::abs(exact.column("rotor_y").back()), 1e-4);
  EXPECT_LT(rotor_error(segments, exact), 0.03 * scene.first().contact->clearance);
}

// Two magnetic bearings alone hold the rotor, sensed beside their magnets. From rest under its
// weight, so that both integrators fill; the first bearing at its limit.
scene::Scene levitated(const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"run.end=0.03",
                                        "run.output_step=1e-3",
                                        "rotor.modes=4",
                                        "mujoco.rotor=modal",
                                        "contact[1]=none",
                                        "contact.clearance=0.02",
                                        "initial.steady=false",
                                        "gravity.acceleration=[0.0,-3.0]",
                                        "magnetic_bearing[0].control.current_limit=1.5",
                                        "magnetic_bearing[0].control.fails_at=25.003e-3",
                                        "magnetic_bearing[1].control.fails_at=1.0"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return shipped("amb_machine", overrides);
}

TEST(LevitatedEngine, MujocoHoldsTheRotorAsTheNativeModelDoes) {
  const scene::Scene scene = levitated();
  const Trajectory exact = native(scene, scene::Integrator::kEvent);
  const Trajectory verlet = native(scene, scene::Integrator::kVerlet);
  const Trajectory rigid = mujoco_run(scene, scene::ContactModel::kRigid, kStep);
  EXPECT_LT(rotor_error(rigid, verlet), 1e-10);
  EXPECT_LT(rotor_error(rigid, exact), 1e-7);
  for (const char* column : {"bearing_current_y", "bearing2_current_y"}) {
    const auto &a = rigid.column(column), &b = verlet.column(column);
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-5) << k;
  }
  EXPECT_GT(exact.column("bearing2_current_y").back(), 0.5);
  EXPECT_EQ(std::ranges::max(exact.column("bearing_current_y")), 1.5);
  EXPECT_EQ(exact.column("bearing_current_y").back(), 0.0);
  const double coarse = rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, 1e-5), exact);
  const double fine = rotor_error(mujoco_run(scene, scene::ContactModel::kCoulomb, 2.5e-6), exact);
  EXPECT_LT(fine, 0.3 * coarse);  // MuJoCo's own step is of first order
}

// The chain is another beam, which the magnets and sensors meet at their stations: an error
// of second order in its segments beside one of first order in the step, of a motion of 75 um.
TEST(LevitatedEngine, SegmentsHangInTheSameMagnets) {
  const scene::Scene scene = levitated({"run.end=0.024", "rotor.modes=16", "mujoco.rotor=segments",
                                        "mujoco.segments=24", "run.step=2e-6"});
  const Trajectory exact = native(scene, scene::Integrator::kEvent);
  const Trajectory segments = mujoco_run(scene, scene::ContactModel::kRigid, 2e-6);
  EXPECT_GT(std::abs(exact.column("rotor_y").back()), 1e-5);
  EXPECT_LT(rotor_error(segments, exact), 2e-7);
  EXPECT_NEAR(segments.column("bearing2_current_y").back(),
              exact.column("bearing2_current_y").back(), 0.02);
}

}  // namespace
}  // namespace rotorub::test
