// The contact in a user's own model, without a scene.
#include <gtest/gtest.h>

#include <cmath>

#include "mjcf/names.h"
#include "native_model/run/run_native.h"
#include "plugin/model/mujoco_versions.h"
#include "tests/support/mujoco_document.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

// A rotor and a ring on springs, lying: the shaft is along the world's x, the bending planes are
// those of a turned body.
const std::string kMachine = R"(<mujoco>
  <option timestep="1e-5" gravity="0 0 0" cone="elliptic"/>
  <size nuserdata="32"/>
  <worldbody>
    <body euler="0 90 0" pos="0.1 0.2 0.3">
      <body>
        <joint type="slide" axis="1 0 0" stiffness="2e5" damping="40"/>
        <joint type="slide" axis="0 1 0" stiffness="2e5" damping="40"/>
        <joint type="hinge" axis="0 0 1"/>
        <inertial pos="0 0 0" mass="2" diaginertia="1e-3 1e-3 1e-3"/>
        <geom name="disc" type="cylinder" size="0.05 0.01" contype="0" conaffinity="0"/>
      </body>
      <body>
        <joint type="slide" axis="1 0 0" stiffness="1e5" damping="200"/>
        <joint type="slide" axis="0 1 0" stiffness="1e5" damping="200"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1e-3 1e-3 1e-3"/>
        <geom name="bore" type="box" size="0.06 0.06 0.01" contype="0" conaffinity="0"/>
      </body>
    </body>
  </worldbody>
  <contact>
    <pair geom1="disc" geom2="bore" PAIR/>
  </contact>
  <custom>
    <text name="rotorub_rotor_geom" data="disc"/>
    <text name="rotorub_ring_geom" data="bore"/>
    <text name="rotorub_contact" data="MODEL"/>
    <numeric name="rotorub_clearance" data="5e-4"/>
    <numeric name="rotorub_friction" data="0.15"/>
    <numeric name="rotorub_restitution" data="0.5"/>
  </custom>
</mujoco>)";

// The same machine, as a scene.
const std::string kScene = R"(
[run]
end = 0.1
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
inertia = 1e-3
[drive]
kind = "free"
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.15
restitution = 0.5
[stator]
mass = 1.0
damping = 200.0
stiffness = 1e5
[[force]]
kind = "constant"
vector = [200.0, 0.0]
[initial]
vx = [0.2]
vy = [0.3]
)";

std::string machine(const std::string& contact) {
  // sqrt(K) h = 0.2; K and B of a restitution of 0.5, as bench_ring.xml has them.
  const std::string soft = "solref=\"-4e8 -10211.0255\" solimp=\"0.9999 0.9999 0.001\" ";
  const std::string pair = contact == "rigid" ? "condim=\"1\" margin=\"5e-6\" gap=\"1\""
                           : contact == "coulomb"
                               ? soft + "condim=\"1\" margin=\"5e-7\" gap=\"0\""
                               : soft + "condim=\"3\" friction=\"0.15 0.15 0 0 0\" gap=\"0\"";
  return replaced(replaced(kMachine, "PAIR", pair), "MODEL", contact);
}

class OwnModel : public HookedTest {
 protected:
  static DataPointer begin(const mjModel* m) {
    DataPointer d = start(m);
    d->qvel[0] = 0.2;
    d->qvel[1] = 0.3;
    d->qvel[2] = 100.0;
    d->qfrc_applied[0] = 200.0;
    return d;
  }

  // Largest distance of rotor and ring from the native `event` run, every millisecond, m. friction:
  // as in <custom>; overrides: the scene's.
  static double error(const std::string& contact, double step, const std::string& friction = "0.15",
                      const std::vector<std::string>& overrides = {}) {
    const ModelPointer m =
        load(replaced(machine(contact), "friction\" data=\"0.15", "friction\" data=\"" + friction));
    m->opt.timestep = step;
    const DataPointer d = begin(m.get());
    NativeOptions options;
    options.integrator = scene::Integrator::kEvent;
    options.output_times.emplace();
    for (int k = 1; k <= 100; ++k) options.output_times->push_back(1e-3 * k);
    const Trajectory native = run_native(parsed(kScene, overrides), options);
    double largest = 0.0;
    const auto between = static_cast<int>(std::lround(1e-3 / step));
    for (std::size_t row = 0; row < 100; ++row) {
      for (int k = 0; k < between; ++k) mj_step(m.get(), d.get());
      const double e[] = {
          d->qpos[0] - native.column("rotor_x")[row], d->qpos[1] - native.column("rotor_y")[row],
          d->qpos[3] - native.column("stator_x")[row], d->qpos[4] - native.column("stator_y")[row]};
      largest = std::max({largest, std::hypot(e[0], e[1]), std::hypot(e[2], e[3])});
    }
    return largest;
  }
};

// Static, kinetic, Stribeck speed, viscous, over the slips of the run.
constexpr const char* kFalling = "0.25 0.1 3.0 0.005";
const std::vector<std::string> kFallingScene{
    "contact.friction={static=0.25,kinetic=0.1,stribeck_speed=3.0,viscous=0.005}"};

TEST_F(OwnModel, FrictionThatFallsFollowsTheNativeModel) {
  const double coarse = error("rigid", 1e-4, kFalling, kFallingScene);
  const double fine = error("rigid", 1e-5, kFalling, kFallingScene);
  EXPECT_LT(fine, 5e-6);
  EXPECT_LT(fine, 0.2 * coarse);
  EXPECT_GT(error("rigid", 1e-5, "0.15", kFallingScene), 3.0 * fine) << "it matters";
  EXPECT_LT(error("coulomb", 1e-5, kFalling, kFallingScene), 2e-5);
}

TEST_F(OwnModel, FrictionThatIsNoLawIsRefused) {
  for (const char* law : {"0.1 0.25 3 0", "0.25 0.1 0 0", "0.25 0.1 3 -1"}) {
    expect_refused(replaced(machine("rigid"), "0.15", law), "rotorub_friction");
  }
  const std::string given = "friction\" data=\"";
  expect_refused(replaced(machine("cone"), given + "0.15", given + kFalling), "rigid or coulomb");
}

// A contact of the shape that the frame of the ring's geom says, in the world's axes.
TEST_F(OwnModel, ContactIsWhereTheWorldSeesIt) {
  const ModelPointer m = load(machine("rigid"));
  const DataPointer d = start(m.get());
  d->qpos[0] = 0.3e-3;
  d->qpos[1] = 0.4e-3;
  mj_forward(m.get(), d.get());
  ASSERT_EQ(d->ncon, 1);
  EXPECT_EQ(d->nefc, 0);
  const mjContact& c = d->contact[0];
  // From 3.9 on it is told as no deeper than the margin, which keeps it from the solver.
  EXPECT_NEAR(c.dist, plugin::kGapKeepsOut ? 0.0 : m->pair_margin[0], 1e-15);
  // The bodies' x is the world's -z, their y the world's y.
  const double out[] = {0.1, 0.2 + 0.8 * 0.0505, 0.3 - 0.6 * 0.0505};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(c.pos[i], out[i], 1e-12) << i;
  EXPECT_NEAR(std::abs(c.frame[1]), 0.8, 1e-12);
  EXPECT_NEAR(std::abs(c.frame[2]), 0.6, 1e-12);
}

TEST_F(OwnModel, BadTextIsRefusedAtLoadByName) {
  const std::string good = machine("rigid");
  expect_refused(replaced(good, "<numeric name=\"rotorub_clearance\" data=\"5e-4\"/>", ""),
                 "rotorub_clearance");
  expect_refused(replaced(good, "data=\"0.15\"", "data=\"-0.15\""), "rotorub_friction");
  expect_refused(replaced(good, "data=\"rigid\"", "data=\"soft\""), "rigid, coulomb, cone");
  expect_refused(replaced(good, "gap=\"1\"", "gap=\"0\""), "gap");
  expect_refused(replaced(machine("coulomb"), "condim=\"1\"", "condim=\"3\""), "condim");
}

// The hand-written example: the motor drives it through the resonance, it rubs, and stays in its
// ring.
TEST_F(OwnModel, ExampleRubs) {
  const ModelPointer m = load(own_model_example());
  const DataPointer d = start(m.get());
  EXPECT_EQ(sensor(m.get(), d.get(), names::kActive), 0.0);
  int pressed = 0;
  double deepest = 0.0;
  for (int k = 0; k < 50000; ++k) {
    mj_step(m.get(), d.get());
    if (sensor(m.get(), d.get(), names::kNormalForce) > 0.0) ++pressed;
    deepest = std::max(deepest, -sensor(m.get(), d.get(), names::kGap));
  }
  EXPECT_EQ(sensor(m.get(), d.get(), names::kActive), 1.0);
  EXPECT_GT(pressed, 1000);
  EXPECT_LT(deepest, 1e-7);
}

}  // namespace
}  // namespace rotorub::test
