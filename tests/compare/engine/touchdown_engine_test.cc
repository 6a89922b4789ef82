// Levitated and segment rotors in MuJoCo, by whole runs, against the native event and verlet
// integrators.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "native_model/run/run_native.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

constexpr double kStep = 1e-5;

// Rigid segments meet the magnets at the magnets' station.
TEST(TouchdownEngine, SegmentsFallAsTheModesDo) {
  const scene::Scene scene =
      shipped("touchdown", {"rotor.modes=6", "mujoco.rotor=segments", "mujoco.segments=12",
                            "magnetic_bearing.control.fails_at=5.003e-3", "run.end=0.0115",
                            "run.step=2e-6", "run.output_step=2e-4"});
  const Trajectory exact = run_event(scene);
  const Trajectory segments = mujoco_run(scene, scene::ContactModel::kRigid, 2e-6);
  EXPECT_GT(std::abs(exact.column("rotor_y").back()), 1e-4);
  EXPECT_LT(rotor_error(segments, exact), 0.03 * scene.first().contact->clearance);
}

// Only two magnetic bearings hold the rotor, with sensors beside their magnets. It starts from rest
// under its weight, so that both integrators fill; the first bearing reaches its limit.
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
  const Trajectory exact = run_event(scene);
  const Trajectory verlet = run_with(scene, scene::Integrator::kVerlet, kStep);
  const Trajectory rigid = mujoco_run(scene, scene::ContactModel::kRigid, kStep);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
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
  const Trajectory exact = run_event(scene);
  const Trajectory segments = mujoco_run(scene, scene::ContactModel::kRigid, 2e-6);
  EXPECT_GT(std::abs(exact.column("rotor_y").back()), 1e-5);
  EXPECT_LT(rotor_error(segments, exact), 2e-7);
  EXPECT_NEAR(segments.column("bearing2_current_y").back(),
              exact.column("bearing2_current_y").back(), 0.02);
}

// ---------------------------------------------------------------- rubs of the segment rotor

// With little friction the rig's rub settles. The native model keeps as many modes as matter at its
// impacts.
scene::Scene rub(int segments, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {
      "mujoco={rotor=\"segments\", segments=" + std::to_string(segments) + "}",
      "run.step=5e-6",
      "run.end=0.3",
      "contact.friction=0.1",
      "rotor.modes=5",
      "rotor.torsion.modes=3"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return shipped("paper_passive", overrides);
}

TEST(SegmentRub, RefusesAStepBeyondItsStiffness) {
  const Trajectory t = run_mujoco(rub(40), mujoco_options(scene::ContactModel::kCoulomb, 1e-5));
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_NE(t.message.find("run.step"), std::string::npos) << t.message;
}

// The ring is off the line: the segments and the beam meet it at different times.
TEST(SegmentRub, MeetsARingOffTheLineWhereItIs) {
  const double centred = run_native(rub(20, {"run.end=0.11"})).impacts.at(0).t;
  for (const char* offset :
       {"contact.offset=[2.2e-4,-1.1e-4]", "contact.offset=[-2.2e-4,1.1e-4]"}) {
    const scene::Scene scene = rub(20, {"run.end=0.11", offset});
    const double native = run_native(scene).impacts.at(0).t;
    EXPECT_GT(std::abs(native - centred), 3e-4) << offset;
    EXPECT_NEAR(mujoco_run(scene, scene::ContactModel::kRigid).impacts.at(0).t, native, 5e-5)
        << offset;
  }
}

}  // namespace
}  // namespace rotorub::test
