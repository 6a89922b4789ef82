// A whole run in MuJoCo under a user's controller: it equals the native run, and ends like it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "native_model/control/library.h"
#include "native_model/run/run_native.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

// The tests open only their own libraries.
[[maybe_unused]] const bool library_engine_trusts =
    (set_scene_libraries(SceneLibraries::kAllowed), true);

scene::Scene library_scene(const std::string& library, const std::vector<std::string>& more) {
  std::vector<std::string> overrides{"rotor.modes=2",
                                     "run.end=0.02",
                                     "run.step=1e-5",
                                     "controller.kind=library",
                                     "controller.library=" + library,
                                     "controller.on=0",
                                     "controller.sample_time=1e-4",
                                     "force[0].on=0",
                                     "initial.steady=false",
                                     "actuator.force_limit=none"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  scene::Scene s = shipped("paper_sliding", overrides);
  s.folder = ROTORUB_LIBRARIES;
  return s;
}

// With delay and noise, without rounding and contact, both trajectories are the same.
TEST(LibraryEngine, ClosedLoopIsTheNativeOneUpToTheFirstTouch) {
  const scene::Scene s = library_scene("recording_controller.so",
                                       {"controller.sensors={delay=2e-4, position_noise=1e-6}",
                                        "run.output_step=1e-4", "contact.clearance=0.01"});
  NativeOptions options;
  options.integrator = scene::Integrator::kVerlet;
  const Trajectory native = run_native(s, options),
                   mujoco = mujoco_engine(scene::ContactModel::kRigid)->run(s, {});
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  ASSERT_EQ(mujoco.status, Status::kOk) << mujoco.message;
  for (const char* column : {"control_x", "control_y"}) {
    const auto &a = native.column(column), &b = mujoco.column(column);
    ASSERT_EQ(a.size(), b.size());
    const double most = largest_size(native, column);
    double apart = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
    EXPECT_GT(most, 1.0);
    EXPECT_LT(apart, 1e-9 * most) << column;
  }
}

TEST(LibraryEngine, AFailureEndsTheRunWithNameAndTime) {
  for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
    const scene::Scene s =
        library_scene("faulty_controller.so", {"controller.config={fault=\"throw\", at=0.004}"});
    const Trajectory t = mujoco_engine(contact)->run(s, {});
    EXPECT_EQ(t.status, Status::kControllerFailed) << t.message;
    EXPECT_NE(t.message.find("faulty"), std::string::npos) << t.message;
    EXPECT_NE(t.message.find("0.004"), std::string::npos) << t.message;
    EXPECT_NEAR(t.end, 0.004, 2e-5) << "and what was done before is kept";
    EXPECT_GT(t.column("t").size(), 100u);
  }
}

// ------------------------------------------------------------------ magnetic bearings

scene::Scene levitated(const std::string& law, const std::string& rotor,
                       const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides{
      "run.end=0.02",
      "run.step=1e-5",
      "run.output_step=1e-4",
      "mujoco.rotor=" + rotor,
      "magnetic_bearing[0].control={kind='shared',proportional=22e3}",
      "magnetic_bearing[1].control={kind='shared',proportional=22e3}",
      "magnetic_control={sample_time=1e-4,delay=1e-4," + law + "}"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  scene::Scene s = shipped("relevitation", overrides);
  s.folder = ROTORUB_LIBRARIES;
  return s;
}
// A derivative by the difference of two samples, of each of four axes.
const std::string kDifference =
    "state_matrix=[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0],"
    "input_matrix=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"
    "output_matrix=[-2e5,0,0,0,0,-2e5,0,0,0,0,-2e5,0,0,0,0,-2e5],"
    "feedthrough=[2.2e5,0,0,0,0,2.2e5,0,0,0,0,2.2e5,0,0,0,0,2.2e5]";
const std::string kByLibrary = "kind='library',library='magnetic_controller.so',config={";
const std::string kDifferenceByLibrary =
    kByLibrary +
    "a='0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0',b='1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1',"
    "c='-2e5 0 0 0 0 -2e5 0 0 0 0 -2e5 0 0 0 0 -2e5',"
    "d='2.2e5 0 0 0 0 2.2e5 0 0 0 0 2.2e5 0 0 0 0 2.2e5'";

TEST(MagneticLibraryEngine, TheSameLawGivesTheSameBitsInMujoco) {
  for (const std::string rotor : {"modal", "segments"}) {
    for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
      const auto engine = mujoco_engine(contact);
      const Trajectory a = engine->run(levitated(kDifference, rotor), {}),
                       b = engine->run(levitated(kDifferenceByLibrary + "}", rotor), {});
      ASSERT_EQ(a.status, Status::kOk) << a.message;
      ASSERT_EQ(b.status, Status::kOk) << b.message;
      ASSERT_EQ(a.series.size(), b.series.size());
      for (std::size_t c = 0; c < a.series.size(); ++c)
        EXPECT_EQ(a.series[c].values, b.series[c].values) << rotor << " " << a.series[c].name;
      EXPECT_GT(largest_size(b, "bearing2_current_x"), 0.01) << rotor;
    }
  }
}

TEST(MagneticLibraryEngine, AFailureEndsTheRunWithNameAndTime) {
  for (const std::string rotor : {"modal", "segments"}) {
    for (const auto contact : {scene::ContactModel::kRigid, scene::ContactModel::kCoulomb}) {
      const Trajectory t = mujoco_engine(contact)->run(
          levitated(kDifferenceByLibrary + ",fault='throw',at=0.004}", rotor), {});
      EXPECT_EQ(t.status, Status::kControllerFailed) << rotor << " " << t.message;
      EXPECT_NE(t.message.find("controller magnetic"), std::string::npos) << t.message;
      EXPECT_NE(t.message.find("thrown in step"), std::string::npos) << t.message;
      EXPECT_NEAR(t.end, 0.004, 2e-5) << rotor;
    }
  }
}

}  // namespace
}  // namespace rotorub::test
