#include "plugin/hooks.h"

#include <gtest/gtest.h>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

class HooksTest : public MujocoTest {};

int hook_calls = 0;
void count_control(const mjModel*, mjData*) { ++hook_calls; }
void count_passive(const mjModel*, mjData*) { ++hook_calls; }

TEST_F(HooksTest, InstallsAndRestores) {
  const auto control = mjcb_control, passive = mjcb_passive;
  const auto sensor_before = mjcb_sensor;
  const auto collision = mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_CAPSULE];
  {
    const plugin::Hooks outer;
    EXPECT_NE(mjcb_control, control);
    EXPECT_NE(mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_CAPSULE], collision);
    const auto ours = mjcb_control;
    {
      const plugin::Hooks inner;
      EXPECT_EQ(mjcb_control, ours);
    }
    EXPECT_EQ(mjcb_control, ours) << "the last one restores";
    EXPECT_TRUE(plugin::hooks_installed());
  }
  EXPECT_FALSE(plugin::hooks_installed());
  EXPECT_EQ(mjcb_control, control);
  EXPECT_EQ(mjcb_passive, passive);
  EXPECT_EQ(mjcb_sensor, sensor_before);
  EXPECT_EQ(mjCOLLISIONFUNC[mjGEOM_SPHERE][mjGEOM_CAPSULE], collision);
}

TEST_F(HooksTest, CallsWhatWasInstalledBefore) {
  const ModelPointer m = load(mjcf(parsed(kNeverTouches)));
  const DataPointer d = start(m.get());
  mjcb_control = count_control;
  mjcb_passive = count_passive;
  {
    const plugin::Hooks hooks;
    hook_calls = 0;
    mj_step(m.get(), d.get());
    EXPECT_EQ(hook_calls, 2);
    EXPECT_EQ(sensor(m.get(), d.get(), mjcf_names::kActive), 1.0);
  }
  EXPECT_EQ(mjcb_control, &count_control);
  EXPECT_EQ(mjcb_passive, &count_passive);
  mjcb_control = nullptr;
  mjcb_passive = nullptr;
}

// The callbacks are overwritten, taken back, and returned to their writer: none of ours stays, none
// of the user's is lost.
TEST_F(HooksTest, GivesBackToWhoWroteOverThem) {
  const ModelPointer m = load(mjcf(parsed(kAnnularRub)));
  const mjfGeneric writes[] = {count_control, nullptr};
  for (const mjfGeneric write : writes) {
    std::vector<double> plain;
    {
      const plugin::Hooks hooks;
      plain = state_after(m.get(), 300);
      mjcb_control = write;
      hook_calls = 0;
      EXPECT_EQ(state_after(m.get(), 300), plain);
      EXPECT_EQ(hook_calls, write ? 300 : 0);
      EXPECT_NE(mjcb_control, write) << "ours is back, and hook_calls it";
    }
    EXPECT_EQ(mjcb_control, write);
    EXPECT_NE(state_after(m.get(), 300), plain) << "ours is gone";
    mjcb_control = nullptr;
  }
}

// A double pendulum over a floor, with an actuator and MuJoCo's own contacts.
constexpr const char* kForeign = R"(<mujoco>
  <option timestep="0.002"/><size nuserdata="21"/>
  <custom><text name="note" data="another's text"/></custom>
  <worldbody><geom type="plane" size="5 5 1"/>
    <body pos="0 0 0.6"><joint name="a" type="hinge" axis="0 1 0" damping="0.01"/>
      <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.05"/>
      <body pos="0.3 0 0"><joint name="b" type="hinge" axis="0 1 0"/>
        <geom type="sphere" size="0.08" pos="0.3 0 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.04"/></body></body>
    <body pos="0.4 0 1.5"><freejoint/><geom type="sphere" size="0.1"/></body>
  </worldbody>
  <actuator><motor joint="a" gear="0.5"/></actuator>
</mujoco>)";

TEST_F(HooksTest, ForeignModelRunsBitForBitAsWithout) {
  const ModelPointer m = load(kForeign);
  const std::vector<double> without = state_after(m.get(), 2000);
  const plugin::Hooks hooks;
  EXPECT_EQ(state_after(m.get(), 2000), without);
}

TEST_F(HooksTest, RotorThatNeverTouchesRunsBitForBitAsWithout) {
  // (With `rigid` the native step replaces MuJoCo's, in contact or not.)
  const ModelPointer m = load(mjcf(parsed(kNeverTouches, {"mujoco.contact=coulomb"})));
  const std::vector<double> without = state_after(m.get(), 10000);
  EXPECT_NE(without[0], 1e-3) << "it must have moved";
  const plugin::Hooks hooks;
  EXPECT_EQ(state_after(m.get(), 10000), without);
}

}  // namespace
}  // namespace rotorub::test
