// Foreign actuators beside the contact: each callback is called as often as in MuJoCo alone, so
// that one that counts or filters gives the same bits with the plugin.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "plugin/inverse.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

int gains = 0, biases = 0, rates = 0;

// Each depends on the number of its calls.
mjtNum counting_gain(const mjModel*, const mjData*, int) { return 1.0 + 1e-3 * ++gains; }
mjtNum counting_bias(const mjModel*, const mjData* d, int) { return 1e-3 * ++biases - d->qvel[0]; }
mjtNum counting_rate(const mjModel*, const mjData* d, int id) {
  return 1e-2 * ++rates + d->ctrl[id];
}

Machine with_actuator(const std::string& contact) {
  Machine x;
  x.contact = contact;
  x.constraints =
      "<actuator><general name=\"pull\" joint=\"rotor_x\" dyntype=\"user\" gaintype=\"user\" "
      "biastype=\"user\"/>"
      "</actuator>";
  return x;
}

class OwnActuators : public MujocoTest {
 protected:
  OwnActuators() { forget(); }
  ~OwnActuators() override { remove(); }

  static void remove() { mjcb_act_gain = nullptr, mjcb_act_bias = nullptr, mjcb_act_dyn = nullptr; }
  static void install() {
    mjcb_act_gain = counting_gain, mjcb_act_bias = counting_bias, mjcb_act_dyn = counting_rate;
  }
  static void forget() { gains = biases = rates = 0; }
  // The numbers of calls after a run, and its state.
  static std::vector<double> run(const mjModel* m, int steps, double start_x) {
    const DataPointer d = start(m);
    forget();
    d->qpos[0] = start_x;
    d->ctrl[0] = 0.5;
    for (int k = 0; k < steps; ++k) mj_step(m, d.get());
    std::vector<double> all = state_of(m, d.get());
    all.push_back(d->act[0]);
    return all;
  }
};

constexpr int kActuatorSteps = 50;

TEST_F(OwnActuators, AreAskedOnceAPassAndMoveAsWithoutThePlugin) {
  // In flight; MuJoCo alone would collide the drawn shapes of a soft pair.
  install();
  const std::vector<double> plain =
      run(load(document(with_actuator("rigid"))).get(), kActuatorSteps, 0.0);
  EXPECT_EQ(gains, kActuatorSteps);
  remove();
  for (const char* contact : {"rigid", "coulomb"}) {
    for (const bool before : {true, false}) {
      if (before) install();
      const plugin::Hooks hooks;
      const ModelPointer m = load(document(with_actuator(contact)));
      if (!before) install();
      EXPECT_EQ(run(m.get(), kActuatorSteps, 0.0), plain) << contact << before;
      // In contact, where the force is needed earlier.
      run(m.get(), kActuatorSteps, 5e-4 + 1e-8);
      EXPECT_EQ((std::array{gains, biases, rates}),
                (std::array{kActuatorSteps, kActuatorSteps, kActuatorSteps}))
          << contact << before;
      remove();
    }
  }
}

TEST_F(OwnActuators, AreAskedAnewWhereTheControlIsSetBetweenTheHalvesOfAStep) {
  install();
  const plugin::Hooks hooks;
  const ModelPointer m = load(document(with_actuator("rigid")));
  const DataPointer d = start(m.get());
  forget();
  d->ctrl[0] = 1.0;
  mj_step1(m.get(), d.get());
  d->ctrl[0] = 2.0;
  mj_step2(m.get(), d.get());
  EXPECT_EQ(rates, 2);
  // The rate uses the present control.
  EXPECT_DOUBLE_EQ(d->act[0], m->opt.timestep * (2e-2 + 2.0));
}

TEST_F(OwnActuators, AreNotAskedByTheInverse) {
  install();
  const plugin::Hooks hooks;
  const ModelPointer m = load(document(with_actuator("rigid")));
  const DataPointer d = start(m.get());
  mj_forward(m.get(), d.get());
  forget();
  plugin::inverse(m.get(), d.get());
  EXPECT_EQ(gains + biases + rates, 0);
}

// A generated model: the native step in MuJoCo's, beside a third actuator on the chain.
TEST_F(OwnActuators, OfAGeneratedModelAreAskedOnceAPass) {
  install();
  const plugin::Hooks hooks;
  const std::string text = mjcf(shipped("paper_sliding"));
  const ModelPointer m = load(replaced(
      text, "</actuator>",
      "<general name=\"pull\" joint=\"spin\" biastype=\"user\" gainprm=\"0\"/></actuator>"));
  const DataPointer d = start(m.get());
  forget();
  for (const double pull : {0.0, 1.0}) {
    d->xfrc_applied[6] = pull;
    mj_step(m.get(), d.get());
  }
  EXPECT_EQ(biases, 2);
}

}  // namespace
}  // namespace rotorub::test
