// Contact model `cone`: MuJoCo's own contact. How well it does is a finding, not a requirement;
// here it must act on the right bodies in the right direction.
#include <gtest/gtest.h>

#include <cmath>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

class ConeContact : public HookedTest {
 protected:
  static scene::Scene scene(const std::string& text) {
    return parsed(text, {"mujoco.contact=cone"});
  }
};

TEST_F(ConeContact, FrictionOpposesTheSlipAndKeepsToTheCone) {
  const ModelPointer m = load(mjcf(shipped("bench_ring", {"mujoco.contact=cone"})));
  const DataPointer d = start(m.get());
  int touched = 0;
  for (int k = 0; k < 20000; ++k) {
    mj_step(m.get(), d.get());
    const double normal = sensor(m.get(), d.get(), names::kNormalForce);
    const double friction = sensor(m.get(), d.get(), names::kFrictionForce);
    if (normal == 0.0) continue;
    ++touched;
    EXPECT_LE(friction * sensor(m.get(), d.get(), names::kSlip), 0.0);
    EXPECT_LE(std::abs(friction), 0.15 * normal * (1.0 + 1e-9));
  }
  EXPECT_GT(touched, 0);
}

// A prescribed speed is no degree of freedom, and its slip r Omega must be felt all the same.
TEST_F(ConeContact, FeelsThePrescribedSpin) {
  const std::string text = R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = "50 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.2
restitution = 0.0
[initial]
x = [0.4e-3]
vx = [0.1]
)";
  const ModelPointer m = load(mjcf(scene(text)));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 1000 && d->qvel[1] == 0.0; ++k) mj_step(m.get(), d.get());
  // e_t is +y at +x, the surface slips along it, friction pushes the rotor along -y.
  EXPECT_LT(d->qvel[1], 0.0);
}

// MuJoCo's default cone is a pyramid, whose rows are edges and no components: what the sensors say
// is what the contact exchanges. Pressed to a ring that stands, 100 N, slipping.
TEST_F(ConeContact, OfAPyramidTheForcesAreThoseThatAct) {
  const std::string text = R"(
[run]
end = 0.02
step = 1e-5
[rotor]
speed = "0.01 Hz"
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
stiffness_y = [1e8]
damping = [4000.0]
[contact]
radius = 0.05
clearance = "0.5 mm"
friction = 0.2
restitution = 0.0
[[force]]
kind = "constant"
vector = [200.0, 0.0]
[initial]
x = [0.5e-3]
)";
  for (const int cone : {int{mjCONE_PYRAMIDAL}, int{mjCONE_ELLIPTIC}}) {
    const ModelPointer m = load(mjcf(scene(text)));
    m->opt.cone = cone;
    const DataPointer d = start(m.get());
    for (int k = 0; k < 5000; ++k) mj_step(m.get(), d.get());
    mj_forward(m.get(), d.get());
    ASSERT_EQ(d->ncon, 1) << d->qpos[0] << " " << d->qpos[1] << " " << d->qvel[0];
    const double x = d->qpos[0], y = d->qpos[1], delta = std::hypot(x, y);
    const double normal = sensor(m.get(), d.get(), names::kNormalForce);
    const double friction = sensor(m.get(), d.get(), names::kFrictionForce);
    // N e_r - T e_t = (200 N, 0) - k (x, y) - d v - m a.
    const auto rest = [&](int i) { return 4000.0 * d->qvel[i] + 2.0 * d->qacc[i]; };
    const double pull_x = 200.0 - 2e5 * x - rest(0), pull_y = -1e8 * y - rest(1);
    EXPECT_NEAR(normal, (pull_x * x + pull_y * y) / delta, 1e-6);
    EXPECT_NEAR(friction, (pull_x * y - pull_y * x) / delta, 1e-6);
    EXPECT_LT(friction, -0.02 * normal);
    EXPECT_NEAR(normal, 100.0, 20.0);
  }
}

TEST_F(ConeContact, WithoutFrictionItIsTheBounceOfTheRestitution) {
  const ModelPointer m = load(mjcf(shipped("bench_drop", {"mujoco.contact=cone"})));
  const DataPointer d = start(m.get());
  double peak = 0.0;
  for (int k = 0; k < 1500; ++k) {
    mj_step(m.get(), d.get());
    peak = std::max(peak, d->qvel[1]);
  }
  EXPECT_NEAR(peak, 0.5 * std::sqrt(2.0 * 9.81 * 0.5e-3), 0.05 * 0.0495);
}

}  // namespace
}  // namespace rotorub::test
