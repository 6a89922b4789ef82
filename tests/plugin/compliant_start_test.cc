// Compliant contacts in MuJoCo that begin closed: loaded and not struck, as natively
// (tests/native_model/event/compliant_start_test.cc), after a keyframe, a reset and a state that a
// program writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kDepth = 5e-6, kSpeed = 0.05, kClearance = 0.5e-3;
const double kLeaves = std::sqrt(kSpeed * kSpeed + 1e7 * kDepth * kDepth);  // 0.05244 m/s
// Of MuJoCo's step, of first order: sqrt(k/m) step = 3e-3.
constexpr double kError = 5e-3;

std::string start_text(const std::string& contact, const std::string& start) {
  return R"([run]
end = 2e-3
step = 1e-6
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = 0.0005
friction = 0.0
restitution = 0.5
[contact.compliance]
stiffness = 2e7
[mujoco]
contact = ")" +
         contact + "\"\n[initial]\n" + start + "\n";
}

class CompliantStart : public HookedTest, public testing::WithParamInterface<const char*> {
 protected:
  // m/s, with which the rotor flies after 1.5 ms; half a period on the spring is 1 ms.
  static double speed_after(const mjModel* m, mjData* d) {
    for (int k = 0; k < 1500; ++k) mj_step(m, d);
    EXPECT_GT(sensor(m, d, mjcf_names::kGap), 0.0);
    return std::hypot(d->qvel[0], d->qvel[1]);
  }
};

TEST_P(CompliantStart, InTheWallItKeepsItsEnergy) {
  const ModelPointer m = load(mjcf(parsed(start_text(GetParam(), "x = [0.000505]\nvx = [0.05]"))));
  const DataPointer d = start(m.get());
  EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError);
  mj_resetDataKeyframe(m.get(), d.get(), mj_name2id(m.get(), mjOBJ_KEY, "start"));
  EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError) << "a keyframe";
  for (const double time : {d->time, 7.0}) {  // from flight, with the clock going on, and another
    d->time = time;
    d->qpos[0] = -(kClearance + kDepth);
    d->qpos[1] = 0.0;
    d->qvel[0] = -kSpeed;
    d->qvel[1] = 0.0;
    mj_forward(m.get(), d.get());
    EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError) << "written at " << time;
  }
  mj_resetData(m.get(), d.get());
  d->qpos[1] = kClearance + kDepth;
  d->qvel[1] = -kSpeed;
  EXPECT_NEAR(speed_after(m.get(), d.get()) / kLeaves, 1.0, kError) << "a reset";
}

// 2 F / k = 30 um under 300 N.
TEST_P(CompliantStart, OnTheCircleAtRestItIsLoaded) {
  const ModelPointer m = load(mjcf(parsed(start_text(
      GetParam(), "x = [0.0005]\n[[force]]\nkind = \"constant\"\nvector = [300.0, 0.0]"))));
  const DataPointer d = start(m.get());
  double deepest = 0.0;
  for (int k = 0; k < 1500; ++k) {
    mj_forward(m.get(), d.get());  // a second pass at the same time changes nothing
    mj_step(m.get(), d.get());
    deepest = std::max(deepest, std::hypot(d->qpos[0], d->qpos[1]) - kClearance);
  }
  EXPECT_NEAR(deepest / 3e-5, 1.0, kError);
}

// A touch from flight still has the restitution's damping.
TEST_P(CompliantStart, FromFlightItIsStruck) {
  const ModelPointer m = load(mjcf(parsed(start_text(GetParam(), "x = [0.00049]\nvx = [0.05]"))));
  const DataPointer d = start(m.get());
  EXPECT_NEAR(speed_after(m.get(), d.get()) / (0.5 * kSpeed), 1.0, 2.0 * kError);
}

INSTANTIATE_TEST_SUITE_P(, CompliantStart, testing::Values("coulomb", "cone-coulomb"),
                         [](const auto& of) {
                           return std::string(of.param) == "coulomb" ? "Coulomb" : "ConeCoulomb";
                         });

}  // namespace
}  // namespace rotorub::test
