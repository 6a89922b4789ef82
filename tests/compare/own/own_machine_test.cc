// A user's machine beside its twin.
#include "compare/own/own_machine.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "compare/study/scene_comparison.h"
#include "mjcf/mujoco_version.h"
#include "native_model/run/run_native.h"
#include "tests/plugin/own/machine.h"
#include "tests/plugin/own/two_rings.h"
#include "tests/support/order.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

using test::contains;

const std::string kOwn = std::string(ROTORUB_MJCF_DIR) + "/examples/own_model.xml";

OwnRun until(double end) {
  OwnRun run;
  run.end = end;
  return run;
}

Trajectory own_run(const std::shared_ptr<const OwnMachine>& machine, scene::ContactModel contact,
                   double step) {
  RunRequest request;
  request.step = step;
  const Trajectory t = own_engine(machine, contact)->run(machine->scene(), request);
  EXPECT_EQ(t.status, Status::kOk) << t.message;
  EXPECT_EQ(t.contact_model, to_string(contact));
  return t;
}

// The run-up of the shipped machine into its rub: MuJoCo's `rigid` tends to the twin as its step
// falls.
TEST(OwnMachine, ConvergesToItsTwin) {
  const auto machine = std::make_shared<const OwnMachine>(kOwn, until(0.05));
  EXPECT_EQ(machine->scene().name, "own_model");
  EXPECT_TRUE(machine->limits().empty());
  const Trajectory native = run_native(machine->scene(), {});
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  ASSERT_GT(native.impacts.size(), 3U);
  const double coarse =
      test::rotor_error(own_run(machine, scene::ContactModel::kRigid, 1e-5), native);
  const double fine =
      test::rotor_error(own_run(machine, scene::ContactModel::kRigid, 2.5e-6), native);
  EXPECT_LT(coarse, 5e-6);
  EXPECT_LT(fine, 0.35 * coarse);
}

// A ring that turns: the rub accelerates the rotor and slows the ring. It is of first order, as in
// all models of users.
TEST(OwnMachine, ConvergesToItsTwinInARingThatTurns) {
  test::Machine x;
  x.friction = 0.15;
  x.ring_geoms = R"(<joint name="turn" type="hinge" axis="0 0 1" damping="2e-3"/>)";
  x.constraints =
      R"(<keyframe><key name="start" qpos="5e-4 0 0 0 0 0" qvel="0 0.4 100 0 0 314"/></keyframe>)";
  const test::TemporaryFolder folder;
  const std::string file = folder.write("turning_ring.xml", test::document(x));
  const auto machine = std::make_shared<const OwnMachine>(file, until(0.02));
  // The ring is drawn with 60 mm around a rotor of 50 mm.
  ASSERT_EQ(machine->limits().size(), 1U);
  EXPECT_EQ(
      machine->limits()[0],
      "the drawn shapes of geoms \"disc\" and \"bore\": their radii differ by 0.01 m, but both "
      "sides use the clearance of 0.0005 m");
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  const Trajectory native = run_native(machine->scene(), options);
  ASSERT_EQ(native.status, Status::kOk) << native.message;
  const auto last = [](const Trajectory& t, const char* column) { return t.column(column).back(); };
  ASSERT_LT(last(native, "ring_speed"), 309.0) << "friction does something";
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const Trajectory t = own_run(machine, scene::ContactModel::kRigid, k == 0 ? 1e-5 : 2.5e-6);
    error[k] = test::rotor_error(t, native);
    for (const char* speed : {"spin_speed", "ring_speed"})
      EXPECT_NEAR(last(t, speed), last(native, speed), 0.1);
  }
  EXPECT_LT(error[1], 0.35 * error[0]);
  EXPECT_LT(error[1], 5e-6);
}

std::string refusal(const std::string& file) {
  return test::message_of<std::runtime_error>([&] { OwnMachine(file, until(0.02)); });
}
std::string refusal_of(const std::string& name, const std::string& document) {
  const test::TemporaryFolder folder;
  return refusal(folder.write(name + ".xml", document));
}

TEST(OwnMachine, SaysAllThatIsWrongAtOnce) {
  test::Machine x;
  x.option = "integrator=\"RK4\"";
  x.constraints = R"(<keyframe><key name="begin" qpos="5e-4 0 0 0 0"/></keyframe>)";
  std::string text = test::document(x);
  text = test::replaced(text, "<text name=\"rotorub_contact\" data=\"rigid\"/>", "");
  const std::string why = refusal_of("all", text);
  // A keyframe of another name has no effect.
  EXPECT_TRUE(contains(why, {"integrator=\"RK4\"", "add it with data=\"rigid\"",
                             "<keyframe>: has only \"begin\", but a run starts from the key"}));
  text = test::replaced(text, "nuserdata=\"32\"", "nuserdata=\"2\"");
  text = test::replaced(text, "gap=\"1\"", "gap=\"0\"");
  EXPECT_TRUE(contains(refusal_of("more", text),
                       {"nuserdata", "set gap at least ten clearances above margin", "<keyframe>",
                        "data=\"rigid\""}));
}

TEST(OwnMachine, NamesItsMujocoForAWordThatItDoesNotKnow) {
  test::Machine x;
  x.option = "integrator=\"explicit\"";
  EXPECT_TRUE(contains(refusal_of("word", test::document(x)),
                       "reads MJCF with MuJoCo " + to_string(built_for())));
  x.option = "tempo=\"3\"";
  EXPECT_TRUE(contains(refusal_of("attribute", test::document(x)), "reads MJCF with MuJoCo"));
}

TEST(OwnMachine, SaysWhatATextWithoutDataNeeds) {
  const std::string text = test::replaced(test::document(test::Machine{}),
                                          "<text name=\"rotorub_contact\" data=\"rigid\"/>",
                                          "<text name=\"rotorub_contact\"/>");
  EXPECT_TRUE(contains(refusal_of("no_data", text), "add data=\"...\""));
}

// Driven by a gear, or held by a weld, which the twin would lack.
TEST(OwnMachine, RefusesADriveOrASupportByAnEquality) {
  test::Machine x;
  x.bodies = R"(<body name="motor"><joint name="shaft2" type="hinge" axis="0 0 1"/>
      <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/></body>)";
  x.constraints =
      R"(<equality><joint name="gears" joint1="spin" joint2="shaft2" polycoef="0 2 0 0 0"/></equality>)";
  EXPECT_TRUE(contains(refusal_of("gear", test::document(x)),
                       "<equality> \"gears\": acts on <joint name=\"spin\">"));
  EXPECT_TRUE(contains(refusal_of("weld", test::document(test::welded())), "moves geom \"bore\""));
  // One that holds neither is left out and reported, as before.
  x.constraints = R"(<equality><joint name="brake" joint1="shaft2"/></equality>)";
  EXPECT_EQ(refusal_of("brake", test::document(x)), "");
}

// Two rings: MuJoCo's `rigid` solves both contacts at once, and so does the twin.
TEST(OwnMachine, HasTheImpulsesOfEachOfTwoRings) {
  test::TwoRings x;
  x.friction = 0.15;
  x.constraints =
      R"(<keyframe><key name="start" qpos="0 0 0 0 0" qvel="0.3 0.05 0.5 2 200"/></keyframe>)";
  const test::TemporaryFolder folder;
  // With 0.02 kg m^2 each ring would be at the other's centre of percussion.
  const std::string file = folder.write(
      "two_rings.xml", test::replaced(test::document(x), R"(diaginertia="0.02 0.02 2e-3")",
                                      R"(diaginertia="0.03 0.03 2e-3")"));
  // Later the whirl grows as v' = mu v^2 / delta_0, and each error with it.
  const auto machine = std::make_shared<const OwnMachine>(file, until(0.012));
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  const Trajectory event = run_native(machine->scene(), options);
  ASSERT_EQ(event.status, Status::kOk) << event.message;
  options.integrator = scene::Integrator::kVerlet;
  const Trajectory verlet = run_native(machine->scene(), options);
  const Trajectory rigid = own_run(machine, scene::ContactModel::kRigid, 2.5e-6);
  const Trajectory coulomb = own_run(machine, scene::ContactModel::kCoulomb, 2.5e-6);
  for (const std::size_t k : {0U, 1U}) {
    const auto expect_near = [&](const Trajectory& t, double share) {
      SCOPED_TRACE(t.contact_model + " " + t.integrator);
      const ContactStatistics &exact = event.statistics.contacts[k],
                              &own = t.statistics.contacts[k];
      EXPECT_NEAR(own.impulse_total, exact.impulse_total, share * exact.impulse_total) << k;
      EXPECT_NEAR(own.friction_impulse, exact.friction_impulse, share * exact.impulse_total) << k;
    };
    ASSERT_GT(event.statistics.contacts[k].impulse_total, 0.2);
    expect_near(verlet, 2e-3);
    expect_near(rigid, 5e-3);
    // Over steps from 10 to 0.5 us it scatters by 4 %, depending on the impacts of its
    // accumulation.
    expect_near(coulomb, 6e-2);
  }
}

// The other contact models on the same file, which sets one of them.
TEST(OwnMachine, HasEveryContactModel) {
  const auto machine = std::make_shared<const OwnMachine>(kOwn, until(0.1));
  const Trajectory native = run_native(machine->scene(), {});
  ASSERT_GT(native.mean_force(), 0.0);
  for (const auto contact : {scene::ContactModel::kCoulomb, scene::ContactModel::kCone}) {
    const Trajectory t = own_run(machine, contact, 1e-5);
    // The cone chatters in this rub, and its mean is that of its bounces.
    const double share = contact == scene::ContactModel::kCone ? 0.3 : 1e-3;
    EXPECT_NEAR(t.mean_force(), native.mean_force(), share * native.mean_force())
        << to_string(contact);
    EXPECT_GT(t.statistics.max_penetration, 0.0);
  }
}

TEST(OwnMachine, IsComparedLikeAScene) {
  CompareOptions options;
  options.own = std::make_shared<const OwnMachine>(kOwn, until(0.04));
  options.twins = 2;
  options.timing_repeats = 1;
  const SceneComparison c = compare_scene(options.own->scene(), options);
  EXPECT_EQ(c.status(), Status::kOk);
  EXPECT_TRUE(c.own);
  ASSERT_EQ(c.models.size(), 5U);
  const Side& rigid = c.models[0].run;
  EXPECT_EQ(rigid.engine, "mujoco-rigid");
  ASSERT_TRUE(c.native.metrics.first_touch && rigid.metrics.first_touch);
  EXPECT_NEAR(*rigid.metrics.first_touch, *c.native.metrics.first_touch, 2e-5);
}

// MuJoCo alone as anyone has it: its default solref, whatever restitution the file wants. It is
// critically damped with 50 1/s: met at v the ring gives way by v / (50 e).
TEST(OwnMachine, IsComparedWithMujocosDefaultToo) {
  constexpr double kSpeed = 0.01;  // m/s
  test::Machine x;
  x.constraints =
      R"(<keyframe><key name="start" qpos="4.9e-4 0 0 0 0" qvel="0.01 0 0 0 0"/></keyframe>)";
  const test::TemporaryFolder folder;
  const std::string file = folder.write("default_solref.xml", test::document(x));
  const auto machine = std::make_shared<const OwnMachine>(file, until(0.05));
  constexpr auto kCone = scene::ContactModel::kCone;
  const auto engine = own_engine(machine, kCone, OwnSolref::kDefault);
  EXPECT_EQ(engine->name(), "mujoco-cone-default");
  RunRequest request;
  request.step = 1e-5;
  std::string solref;
  request.solref = &solref;
  const Trajectory soft = engine->run(machine->scene(), request);
  EXPECT_EQ(solref, "0.02 1");
  ASSERT_EQ(soft.status, Status::kOk) << soft.message;
  const double depth = kSpeed / (50.0 * std::numbers::e);
  EXPECT_NEAR(soft.statistics.max_penetration, depth, 2e-3 * depth);
}

TEST(OwnMachine, TakesNeitherCommandsNorAnotherStart) {
  const auto machine = std::make_shared<const OwnMachine>(kOwn, until(0.001));
  const auto engine = own_engine(machine, scene::ContactModel::kRigid);
  RunRequest moved, commanded;
  moved.perturbation_ulps = 1;
  commanded.commands = std::make_shared<const CommandRecord>();
  EXPECT_THROW(engine->run(machine->scene(), moved), std::invalid_argument);
  EXPECT_THROW(engine->run(machine->scene(), commanded), std::invalid_argument);
}

TEST(OwnMachine, RefusesWhatIsNone) {
  EXPECT_TRUE(contains(refusal(ROTORUB_MJCF_DIR "/bench_ring.xml"), "compare the scene"));
  EXPECT_TRUE(
      contains(refusal_of("foreign", "<mujoco><worldbody/></mujoco>"), "names no rotor in a ring"));
}

// The file has no keys of a scene, so messages must not name any.
TEST(OwnMachine, RefusesAStartOutsideTheRing) {
  test::Machine x;
  x.constraints = R"(<keyframe><key name="start" qpos="0 6e-4 0 0 0"/></keyframe>)";
  const std::string why = refusal_of("outside", test::document(x));
  EXPECT_TRUE(contains(why, "in the keyframe \"start\" the rotor is 0.0006 m from the centre"))
      << why;
  EXPECT_TRUE(contains(why, "but the clearance is 0.0005 m")) << why;
}

TEST(OwnMachine, SaysThatACorrectedPairIsNoRotor) {
  EXPECT_TRUE(contains(refusal_of("pair", R"(<mujoco><size nuserdata="21"/><worldbody>
      <geom name="floor" type="plane" size="1 1 1"/>
      <body name="ball"><freejoint/><geom name="ball" size="0.1"/></body></worldbody>
      <contact><pair name="sliding" geom1="floor" geom2="ball" condim="3"/></contact>
      <custom><text name="rotorub_cone_coulomb_pair" data="sliding"/></custom></mujoco>)"),
                       "has no rotor in a ring, so there is nothing to compare"));
}

}  // namespace
}  // namespace rotorub
