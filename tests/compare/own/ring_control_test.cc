// A user's controller on a user's machine: both sides run the same law.
#include "compare/own/ring_control.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "compare/own/own_machine.h"
#include "native_model/control/library_file.h"
#include "native_model/run/run_native.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/order.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

const std::string kShipped = std::string(ROTORUB_MJCF_DIR) + "/examples/own_model.xml";

std::vector<std::string> law_of(const std::string& library,
                                const std::vector<std::string>& further = {}) {
  const std::string file = std::string(ROTORUB_LIBRARIES) + "/" + library;
  allow_library(file);
  std::vector<std::string> all{"controller.kind=library", "controller.library=" + file,
                               "controller.sample_time=50us"};
  all.insert(all.end(), further.begin(), further.end());
  return all;
}

// The example in C that is shipped, as mjcf/examples/own_controller.toml sets it.
std::vector<std::string> example(const std::string& preload = "50") {
  return law_of("own_controller.so",
                {"controller.on=10ms", "controller.config.stiffness=3e5",
                 "controller.config.preload=" + preload, "controller.config.damping=600",
                 "controller.config.ring_damping=400"});
}

std::shared_ptr<const OwnMachine> machine_with(const std::vector<std::string>& control, double end,
                                               const std::string& file = kShipped) {
  OwnRun run;
  run.end = end;
  run.control = control;
  return std::make_shared<const OwnMachine>(file, run);
}

Trajectory mujoco_of(const std::shared_ptr<const OwnMachine>& machine, double step,
                     scene::ContactModel contact = scene::ContactModel::kRigid) {
  RunRequest request;
  request.step = step;
  return own_engine(machine, contact)->run(machine->scene(), request);
}

// The law moves the ring to the rotor. Its memory, samples and switching on are those of the native
// model, so MuJoCo tends to it as its step falls.
TEST(RingControl, ConvergesToTheTwinUnderTheSameLaw) {
  const auto machine = machine_with(example(), 0.04);
  const Trajectory native = run_native(machine->scene(), {});
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  EXPECT_GT(test::largest_size(native, "control_x"), 40.0) << "it presses";
  double error[2], force[2];
  for (int k = 0; k < 2; ++k) {
    const Trajectory t = mujoco_of(machine, k == 0 ? 1e-5 : 2.5e-6);
    ASSERT_EQ(t.status, Status::kOk) << t.message;
    error[k] = test::rotor_error(t, native);
    force[k] = test::largest_size(t, "control_x") - test::largest_size(native, "control_x");
  }
  EXPECT_LT(error[0], 5e-6);
  EXPECT_LT(error[1], 0.4 * error[0]);
  EXPECT_NEAR(force[1], 0.0, 0.01 * test::largest_size(native, "control_x"));
}

// The ctrlrange of its motors, 600 N, does not limit the commands: both sides keep |F_x| + |F_y|
// within it.
TEST(RingControl, KeepsTheLimitsOfTheActuators) {
  const auto machine = machine_with(example("2000"), 0.02);
  const Trajectory native = run_native(machine->scene(), {});
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  const Trajectory mujoco = mujoco_of(machine, 2.5e-6);
  for (const Trajectory* t : {&native, &mujoco}) {
    double most = 0.0;
    for (std::size_t k = 0; k < t->rows(); ++k) {
      most =
          std::max(most, std::abs(t->column("control_x")[k]) + std::abs(t->column("control_y")[k]));
    }
    EXPECT_NEAR(most, 600.0, 1e-9) << t->engine;
  }
  ASSERT_EQ(machine->limits().size(), 1U);
  EXPECT_NE(machine->limits()[0].find("|F_x| + |F_y| <= 600 N"), std::string::npos);
  EXPECT_LT(test::rotor_error(mujoco, native), 2e-5);
}

// A gear is divided out, and the law overwrites ctrl of these two actuators, whatever the start has
// there.
TEST(RingControl, CommandsForcesWhateverTheGear) {
  std::ifstream in(kShipped);
  std::string text(std::istreambuf_iterator<char>(in), {});
  text = test::replaced(
      text, R"(<motor name="push_x" joint="ring_x" ctrllimited="true" ctrlrange="-600 600"/>)",
      R"(<motor name="push_x" joint="ring_x" gear="-4" ctrllimited="true" ctrlrange="-150 150"/>)");
  text = test::replaced(text, R"(<key name="start" qvel="0 0 300 0 0" ctrl="320 0 0"/>)",
                        R"(<key name="start" qvel="0 0 300 0 0" ctrl="320 25 0"/>)");
  const test::TemporaryFolder folder;
  const std::string file = folder.write("geared.xml", text);
  const Trajectory plain = mujoco_of(machine_with(example(), 0.02), 1e-5);
  const auto geared = machine_with(example(), 0.02, file);
  EXPECT_LT(test::rotor_error(mujoco_of(geared, 1e-5), plain), 1e-12);
  EXPECT_EQ(run_native(geared->scene(), {}).column("control_x"),
            run_native(machine_with(example(), 0.02)->scene(), {}).column("control_x"));
}

// A built-in law is accepted as well, sampled at every step.
TEST(RingControl, TakesABuiltInLaw) {
  const auto machine = machine_with(
      {"controller.kind=sliding", "controller.on=10ms", "controller.preload=20"}, 0.04);
  EXPECT_EQ(machine->scene().first().controller->sample_time, 1e-5) << "the model's step";
  const Trajectory native = run_native(machine->scene(), {});
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  EXPECT_GT(native.contact_fraction(), 0.9);
  const double coarse = test::rotor_error(mujoco_of(machine, 1e-5), native);
  const double fine = test::rotor_error(mujoco_of(machine, 2.5e-6), native);
  EXPECT_LT(coarse, 2e-5);
  EXPECT_LT(fine, 0.4 * coarse);
}

TEST(RingControl, AFailureIsTheRuns) {
  const auto machine =
      machine_with(law_of("faulty_controller.so",
                          {"controller.config.fault=\"nan\"", "controller.config.at=0.002"}),
                   0.01);
  const Trajectory t = mujoco_of(machine, 1e-5);
  EXPECT_EQ(t.status, Status::kControllerFailed);
  EXPECT_NE(t.message.find("faulty at t = 0.002"), std::string::npos) << t.message;
}

std::string refused(const test::Machine& x, const std::vector<std::string>& control) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("driven.xml", test::document(x));
  return test::message_of([&] { machine_with(control, 0.01, file); });
}

TEST(RingControl, RefusesActuatorsThatTakeNoForce) {
  const auto with = [](const std::string& actuators) {
    test::Machine x;
    x.constraints = "<actuator>" + actuators + "</actuator>";
    return x;
  };
  const std::string x = R"(<motor name="a" joint="ring_x"/>)",
                    y = R"(<motor name="b" joint="ring_y"/>)";
  EXPECT_EQ(refused(with(x + y), example()), "");
  const auto expect = [&](const std::string& actuators, const std::string& part) {
    EXPECT_TRUE(test::contains(refused(with(actuators), example()), part)) << actuators;
  };
  expect("", "no actuator pushes the ring along x");
  expect(x, "no actuator pushes the ring along y");
  expect(x + y + R"(<motor name="c" joint="ring_y" gear="2"/>)",
         "actuator \"c\": pushes the ring along y as \"b\" does");
  expect(x + R"(<motor name="c" joint="ring_y" ctrllimited="true" ctrlrange="-1 2"/>)",
         "actuator \"c\": ctrlrange=\"-1 2\"");
  expect(x + R"(<motor name="c" joint="ring_y" forcelimited="true" forcerange="-1 1"/>)",
         "actuator \"c\": has a state");
  test::Machine fixed = with(R"(<motor name="a" joint="rotor_x"/>)");
  fixed.ring_moves = false;
  EXPECT_TRUE(test::contains(refused(fixed, example()), "no actuator pushes the ring along x"));
  test::Machine tied = with(R"(<motor name="a" tendon="t"/>)" + y);
  tied.constraints += R"(<tendon><fixed name="t"><joint joint="ring_x" coef="1"/>
      <joint joint="rotor_x" coef="-1"/></fixed></tendon>)";
  EXPECT_TRUE(
      test::contains(refused(tied, example()), "actuator \"a\": pushes more than the ring"));
  const auto law = law_of("own_controller.so", {"controller.config.gain=1"});
  EXPECT_TRUE(test::contains(refused(with(x + y), law), "controller.config"));
}

}  // namespace
}  // namespace rotorub
