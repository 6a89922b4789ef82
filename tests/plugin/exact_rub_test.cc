// Contact models `rigid` and `coulomb` against the exact answers of the rub.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/oracles/annular_rub.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

// The force of an annular rub is to be met at a step of 1e-5; MuJoCo's implicit damping alone, d
// times the velocity of half a step away, makes 6.5e-5 of it.
constexpr double kForce = 1e-4;
constexpr double kScatter = 1e-3;

struct NormalForce {
  double mean = 0.0, deviation = 0.0;  // N
  int steps_in_contact = 0;
};

// Over the last `steps` of a scene; the friction force is the law's at each of them.
NormalForce normal_force(const scene::Scene& scene, int steps) {
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  const auto all = static_cast<int>(std::lround(scene.run.end / scene.run.step));
  double sum = 0.0, squares = 0.0;
  NormalForce out;
  for (int k = 0; k < all; ++k) {
    mj_step(m.get(), d.get());
    if (k < all - steps) continue;
    const double force = sensor(m.get(), d.get(), names::kNormalForce);
    sum += force;
    squares += force * force;
    if (force > 0.0) ++out.steps_in_contact;
    EXPECT_NEAR(sensor(m.get(), d.get(), names::kFrictionForce),
                -scene.first().contact->friction.coefficient * force, 1e-9 * force);
  }
  out.mean = sum / steps;
  out.deviation = std::sqrt(std::max(0.0, squares / steps - out.mean * out.mean));
  return out;
}

class ExactRub : public HookedTest, public testing::WithParamInterface<const char*> {
 protected:
  static scene::Scene rub(const std::string& text, std::vector<std::string> overrides = {}) {
    overrides.push_back(std::string("mujoco.contact=") + GetParam());
    return parsed(text, overrides);
  }
  static bool is_rigid() { return GetParam() == std::string("rigid"); }
  static void expect_steady(const scene::Scene& scene, double exact) {
    const NormalForce found = normal_force(scene, 20000);
    EXPECT_NEAR(found.mean, exact, kForce * exact);
    EXPECT_LT(found.deviation, kScatter * exact);
    EXPECT_EQ(found.steps_in_contact, 20000);
  }
};

// Of kAnnularRub, and of it on kElasticRing.
constexpr double kWhirlSpeed = 100.0 * std::numbers::pi;  // rad/s
constexpr oracle::Support kRubRotor{2.0, 40.0, 3e5}, kRubRing{1.0, 200.0, 4e5};

double rigid_ring_force() {
  return oracle::annular_rub(kRubRotor, 0.5e-3, 0.2, 200.0, kWhirlSpeed).value().force;
}

TEST_P(ExactRub, OnARigidRing) {
  for (const char* integrator : {"euler", "implicit"}) {
    SCOPED_TRACE(integrator);
    expect_steady(rub(kAnnularRub, {std::string("mujoco.integrator=") + integrator}),
                  rigid_ring_force());
  }
}

TEST_P(ExactRub, OnAnElasticRing) {
  const auto exact = oracle::annular_rub(kRubRotor, kRubRing, 0.5e-3, 0.2, 200.0, kWhirlSpeed);
  ASSERT_TRUE(exact);
  expect_steady(rub(kAnnularRub + kElasticRing), exact->force);
}

TEST_P(ExactRub, TheErrorFallsWithTheStep) {
  const double exact = rigid_ring_force();
  const double coarse =
      std::abs(normal_force(rub(kAnnularRub, {"run.step=1e-4"}), 2000).mean - exact);
  const double fine =
      std::abs(normal_force(rub(kAnnularRub, {"run.step=1e-5"}), 2000).mean - exact);
  EXPECT_LT(fine, 0.15 * coarse);
  EXPECT_LT(coarse, 1e-3 * exact);
}

// The spin comes to rest and stays: friction must not push it to and fro.
TEST_P(ExactRub, SticksWithoutFlippingItsSign) {
  const ModelPointer m = load(mjcf(rub(kBrake)));
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
  EXPECT_NEAR(sensor(m.get(), d.get(), names::kNormalForce), 100.0, is_rigid() ? 1.0 : 50.0);
}

INSTANTIATE_TEST_SUITE_P(, ExactRub, testing::Values("rigid", "coulomb"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace rotorub::test
