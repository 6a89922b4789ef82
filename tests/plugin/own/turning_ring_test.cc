// A user's ring that turns: a hinge about the ring's axis beside its slides. Rotor and ring float; the
// rotor circles in the ring's bore, where the normal force is known: m w^2 / delta_0, m the reduced mass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "mjcf/names.h"
#include "native_model/run/run_native.h"
#include "plugin/hooks.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

constexpr double kClearance = 5e-4, kWhirl = 0.4, kRingSpeed = 314.0, kSpeed = 100.0;

// The same machine, as a scene.
const std::string kScene = R"(
[run]
end = 0.02
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
inertia = 1e-3
[drive]
kind = "free"
[contact]
radius = 0.05
clearance = 5e-4
friction = 0.15
restitution = 0.5
[stator]
mass = 1.0
stiffness = 0.0
[stator.spin]
inertia = 1e-3
drag = 2e-3
speed = 314.0
[initial]
x = [5e-4]
vy = [0.4]
)";

class OwnTurningRing : public MujocoTest {
 protected:
  static ModelPointer turning(const std::string& contact, double friction) {
    Machine x;
    x.contact = contact;
    x.friction = friction;
    x.ring_geoms = R"(<joint name="turn" type="hinge" axis="0 0 1" damping="2e-3"/>)";
    return load(document(x));
  }
  static DataPointer begin(const mjModel* m) {
    DataPointer d = start(m);
    d->qpos[0] = kClearance;
    d->qvel[1] = kWhirl;
    d->qvel[2] = kSpeed;
    d->qvel[5] = kRingSpeed;
    return d;
  }

  plugin::Hooks hooks_;
};

TEST_F(OwnTurningRing, WithoutFrictionItsTurningGivesTheRotorNoForce) {
  constexpr double kReducedMass = 2.0 / 3.0;
  const double exact = kReducedMass * kWhirl * kWhirl / kClearance;
  for (const std::string contact : {"rigid", "coulomb"}) {
    const ModelPointer m = turning(contact, 0.0);
    const DataPointer d = begin(m.get());
    for (int k = 0; k < 2000; ++k) {
      mj_step(m.get(), d.get());
      if (k < 100) continue;  // until the soft contact has found its depth
      ASSERT_NEAR(sensor(m.get(), d.get(), mjcf_names::kNormalForce), exact, 1e-3 * exact)
          << contact << ", step " << k;
    }
  }
}

// Of first order, as own models are.
TEST_F(OwnTurningRing, FollowsTheNativeAnswer) {
  NativeOptions options;
  options.integrator = scene::Integrator::kEvent;
  const Trajectory native = run_native(parsed(kScene), options);
  ASSERT_EQ(native.status, Status::kOk);
  const auto last = [&](const char* column) { return native.column(column).back(); };
  ASSERT_GT(std::abs(last("ring_speed") - kRingSpeed), 5.0) << "friction does something";
  for (const std::string contact : {"rigid", "coulomb"}) {
    SCOPED_TRACE(contact);
    const auto error = [&](double step) {
      const ModelPointer m = turning(contact, 0.15);
      m->opt.timestep = step;
      const DataPointer d = begin(m.get());
      for (int k = 0; k < std::lround(0.02 / step); ++k) mj_step(m.get(), d.get());
      EXPECT_NEAR(d->qvel[2], last("spin_speed"), 0.1);
      EXPECT_NEAR(d->qvel[5], last("ring_speed"), 0.1);
      return std::max(std::hypot(d->qpos[0] - last("rotor_x"), d->qpos[1] - last("rotor_y")),
                      std::hypot(d->qpos[3] - last("stator_x"), d->qpos[4] - last("stator_y")));
    };
    const double coarse = error(1e-5), fine = error(2.5e-6);
    EXPECT_LT(fine, 0.3 * coarse);
    EXPECT_LT(fine, 1e-2 * kClearance);
  }
}

// What friction gives the one it takes from the other, at one point: the bore's radius is its lever there,
// to the gap of the step's begin.
TEST_F(OwnTurningRing, FrictionsMomentsBalance) {
  const ModelPointer m = turning("rigid", 0.15);
  const DataPointer d = begin(m.get());
  const double radius = 0.05, inertia = 1e-3, drag = 2e-3;
  for (int k = 0; k < 500; ++k) {
    const double spin = d->qvel[2], ring = d->qvel[5], h = m->opt.timestep;
    const double delta = std::hypot(d->qpos[0] - d->qpos[3], d->qpos[1] - d->qpos[4]);
    EXPECT_NEAR(delta, kClearance, 1e-3 * kClearance);
    mj_step(m.get(), d.get());
    const double friction = sensor(m.get(), d.get(), mjcf_names::kFrictionForce);
    EXPECT_NEAR(inertia * (d->qvel[2] - spin) / h, radius * friction, 1e-9);
    // MuJoCo's joint damping is that of the step's end.
    EXPECT_NEAR(inertia * (d->qvel[5] - ring) / h + drag * d->qvel[5],
                -(radius + delta) * friction, 1e-9);
  }
}

}  // namespace
}  // namespace rotorub::test
