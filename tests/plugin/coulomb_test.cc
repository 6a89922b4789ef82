// Contact model `coulomb` against the exact answers of the rub.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/system/model.h"
#include "plugin/hooks.h"
#include "tests/plugin/normal_force.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

class CoulombContact : public MujocoTest {
 protected:
  plugin::Hooks hooks_;
};

scene::Scene coulomb(const std::string& text, std::vector<std::string> overrides = {}) {
  overrides.push_back("mujoco.contact=coulomb");
  return parsed(text, overrides);
}

TEST_F(CoulombContact, AnnularRubOnARigidRing) {
  const double m = 2.0, k = 3e5, c = 40.0, mu = 0.2, amplitude = 200.0, delta = 0.5e-3;
  const double om = 100.0 * std::numbers::pi;
  const double a = (k - m * om * om) * delta, b = c * om * delta, p = a + mu * b;
  const double exact =
      (-p + std::sqrt(p * p - (1 + mu * mu) * (a * a + b * b - amplitude * amplitude))) /
      (1 + mu * mu);
  const NormalForce found = normal_force(coulomb(kAnnularRub), 20000);
  EXPECT_NEAR(found.mean, exact, kForce * exact);
  EXPECT_LT(found.deviation, kScatter * exact);
  EXPECT_EQ(found.steps_in_contact, 20000);
}

TEST_F(CoulombContact, AnnularRubOnAnElasticRing) {
  using Stiffness = std::complex<double>;
  const double om = 100.0 * std::numbers::pi, mu = 0.2, u = 200.0, delta = 0.5e-3;
  const Stiffness rotor(3e5 - 2.0 * om * om, 40.0 * om), stator(4e5 - om * om, 200.0 * om);
  const Stiffness h = Stiffness(1.0, mu) * (1.0 / rotor + 1.0 / stator);
  const double a = std::norm(h), b = delta * h.real();
  const double constant = delta * delta - u * u / std::norm(rotor);
  const double exact = (-b + std::sqrt(b * b - a * constant)) / a;
  ASSERT_GT(exact, 0.0);
  const NormalForce found = normal_force(coulomb(kAnnularRub + kElasticRing), 20000);
  EXPECT_NEAR(found.mean, exact, kForce * exact);
  EXPECT_LT(found.deviation, kScatter * exact);
  EXPECT_EQ(found.steps_in_contact, 20000);
}

TEST_F(CoulombContact, TheErrorFallsWithTheStep) {
  const double exact = 145.5398062816846;  // of the rigid ring, above
  const double coarse =
      std::abs(normal_force(coulomb(kAnnularRub, {"run.step=1e-4"}), 2000).mean - exact);
  const double fine =
      std::abs(normal_force(coulomb(kAnnularRub, {"run.step=1e-5"}), 2000).mean - exact);
  EXPECT_LT(fine, 0.15 * coarse);
  EXPECT_LT(coarse, 1e-3 * exact);
}

// The spin comes to rest and stays: friction must not push it to and fro.
TEST_F(CoulombContact, SticksWithoutFlippingItsSign) {
  const ModelPointer m = load(mjcf(coulomb(kBrake)));
  const DataPointer d = start(m.get());
  int flips = 0, last = 0;
  for (int k = 0; k < 10000; ++k) {
    mj_step(m.get(), d.get());
    const double slip = sensor(m.get(), d.get(), names::kSlip);
    const int sign = std::abs(slip) > 1e-9 ? (slip > 0.0 ? 1 : -1) : 0;
    if (sign != 0 && last != 0 && sign != last) ++flips;
    if (sign != 0) last = sign;
    const double normal = sensor(m.get(), d.get(), names::kNormalForce);
    EXPECT_LE(std::abs(sensor(m.get(), d.get(), names::kFrictionForce)), 0.5 * normal + 1e-9);
  }
  EXPECT_LE(flips, 2);
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kSlip), 0.0, 1e-9);
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 100.0, 50.0);
}

// The bounce of the scene's restitution, without a load: MuJoCo's law makes up for loads while it
// pushes, so one that presses on the contact costs some of the rebound, a / (v sqrt K).
TEST_F(CoulombContact, BouncesByTheRestitution) {
  const scene::Scene scene =
      shipped("bench_billiard", {"mujoco.contact=coulomb", "mujoco.solref_stiffness=1e6",
                                 "run.step=2e-6", "contact.restitution=0.5", "initial.vy=[0.0]"});
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 30000 && d->qvel[0] > 0.0; ++k) mj_step(m.get(), d.get());
  for (int k = 0; k < 30000 && sensor(m.get(), d.get(), names::kGap) < 0.0; ++k) {
    mj_step(m.get(), d.get());
  }
  EXPECT_NEAR(d->qvel[0], -0.5 * 0.3, 0.3 * 2e-3);  // sqrt(K) step = 2e-3
}

// Hard: MuJoCo raises a friction coefficient of 0 to 1e-5 in its contacts.
TEST_F(CoulombContact, WithoutFrictionThereIsNone) {
  const ModelPointer m = load(mjcf(shipped("bench_billiard", {"mujoco.contact=coulomb"})));
  const DataPointer d = start(m.get());
  int touching = 0;
  for (int k = 0; k < 2000; ++k) {
    mj_step(m.get(), d.get());
    touching += sensor(m.get(), d.get(), names::kNormalForce) > 0.0 ? 1 : 0;
    EXPECT_EQ(sensor(m.get(), d.get(), names::kFrictionForce), 0.0);
  }
  EXPECT_GT(touching, 10);
}

TEST_F(CoulombContact, StepsAreTheSameAfterASecondForward) {
  const ModelPointer m = load(mjcf(shipped("bench_ring", {"mujoco.contact=coulomb"})));
  const DataPointer once = start(m.get()), twice = start(m.get());
  for (int k = 0; k < 3000; ++k) {
    mj_step(m.get(), once.get());
    mj_forward(m.get(), twice.get());
    mj_forwardSkip(m.get(), twice.get(), mjSTAGE_VEL, 0);
    mj_step(m.get(), twice.get());
  }
  // The solver's warm start differs; forces do not pile up.
  for (int i = 0; i < m->nq; ++i) EXPECT_NEAR(once->qpos[i], twice->qpos[i], 1e-9);
}

}  // namespace
}  // namespace rotorub::test
