// Eigenvalues of lasting rubs: against the closed form of one mode, against differences of the
// model's own right-hand side for several, and against the decay and growth of whole runs.
#include "native_model/linear/rub_stability.h"
#include "native_model/prepare/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "native_model/linear/rub_map.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/differences.h"
#include "tests/native_model/linear/rubs.h"
#include "tests/support/whip.h"

namespace rotorub::rub {
namespace {

// ---------------------------------------------------------------- one mode
SteadyRub upper_whip(const scene::Scene& scene, double mu) {
  return BackwardCompliance(rub_system(scene)).whips(mu).at(1);
}

TEST(RubStability, WhipOfOneModeIsTheClosedForm) {
  scene::Scene scene = test::shipped("bench_whip");
  for (const double mu : {0.18, 0.2, 0.241, 0.244}) {
    scene.first().contact->friction = mu;
    const SteadyRub whip = upper_whip(scene, mu);
    const std::vector<Complex> found = rub_eigenvalues(rub_system(scene), whip);
    const std::vector<Complex> exact = test::whip_of(scene).eigenvalues(-whip.whirl);
    ASSERT_EQ(found.size(), exact.size());
    double largest = 0.0;
    for (const Complex& s : found) largest = std::max(largest, std::abs(s));
    // The round-off of an eigenvalue is that of the largest, times its condition: a slow one is
    // near the 0 of the free direction.
    for (const Complex& s : exact) {
      EXPECT_LT(test::nearest_to(s, found), 1e-9 * largest) << mu << ' ' << s;
    }
  }
}

TEST(RubStability, HopfBorderOfTheWhip) {
  const scene::Scene scene = test::shipped("bench_whip");
  const RubStudy study(rub_system(scene));
  const auto at = [&](double mu) { return study.at(mu).rubs.at(1); };
  EXPECT_NEAR(at(0.241).stability.growth, -0.640, 5e-4);
  EXPECT_NEAR(at(0.241).stability.frequency, 1327.76, 5e-3);
  EXPECT_NEAR(at(0.244).stability.growth, 1.098, 5e-4);
  EXPECT_NEAR(at(0.244).stability.frequency, 1330.81, 5e-3);
  EXPECT_TRUE(at(0.2).stability.stable);
  double low = 0.241, high = 0.244;
  while (high - low > 1e-10) {
    const double mu = 0.5 * (low + high);
    (at(mu).stability.growth < 0.0 ? low : high) = mu;
  }
  EXPECT_NEAR(low, 0.242109, 5e-7);
  EXPECT_NEAR(at(low).rub.whirl, -523.362, 5e-4);
  EXPECT_NEAR(at(low).stability.frequency, 1328.89, 5e-3);
  // The lower edges are watersheds.
  EXPECT_FALSE(study.at(0.2).rubs.at(0).stability.stable);
  EXPECT_EQ(study.at(0.2).rubs.at(0).stability.frequency, 0.0);
  EXPECT_EQ(study.at(0.2).attractors() & (kBackwardWhip | kRollingRub),
            kBackwardWhip | kRollingRub);
  EXPECT_EQ(study.at(0.244).attractors() & kBackwardWhip, 0U);
}

// ---------------------------------------------------------------- several modes
void expect_as_differences(const scene::Scene& scene, const RubSystem& system, const SteadyRub& rub,
                           std::size_t count) {
  const std::vector<Complex> found = rub_eigenvalues(system, rub);
  EXPECT_EQ(found.size(), count);
  const std::vector<Complex> all = test::by_differences(prepare(test::started_on(scene, rub)), rub);
  for (const Complex& s : found) {
    EXPECT_LT(test::nearest_to(s, all), 1e-4 * std::abs(s) + 1e-2)
        << to_string(rub.kind) << ' ' << s;
  }
}

TEST(RubStability, OfThreeModesGrowsAsTheModelSays) {
  for (const FrictionLaw& friction : {FrictionLaw(0.2), test::falling(), test::falling(0.02)}) {
    for (const auto& [elastic, turn] : {std::pair{true, 1.0}, std::pair{true, -1.0},
                                        std::pair{false, 1.0}, std::pair{false, -1.0}}) {
      SCOPED_TRACE(elastic ? "elastic ring" : "rigid ring");
      SCOPED_TRACE(turn);
      scene::Scene scene = test::three_modes(elastic);
      scene.first().contact->friction = friction;
      scene.rotor.speed *= turn;
      scene.forces[0].frequency *= turn;
      const RubSystem system = rub_system(scene);
      const std::size_t all = elastic ? 14 : 10;
      for (const SteadyRub& rub : forced_rubs(system, rotating_loads(system).front())) {
        expect_as_differences(scene, system, rub, all);
      }
      scene.forces.clear();
      for (const SteadyRub& whip : BackwardCompliance(system).whips(friction)) {
        expect_as_differences(scene, system, whip, all - 1);
      }
    }
  }
}

// ---------------------------------------------------------------- apart and joined
TEST(RubStability, JoinedBodiesAddUp) {
  const scene::Scene scene = test::shipped("bench_whip");
  const RubSystem system = rub_system(scene);
  const auto roots = [](double m, double d, double k) {
    return std::pair{-0.5 * d / m, std::sqrt(k / m - 0.25 * d * d / (m * m))};
  };
  const auto expect_pair = [&](const std::vector<Complex>& found, double m, double d, double k) {
    const auto [re, im] = roots(m, d, k);
    ASSERT_EQ(found.size(), 2U);
    for (const Complex& s : found) {
      EXPECT_NEAR(s.real(), re, 1e-9 * im);
      EXPECT_NEAR(std::abs(s.imag()), im, 1e-9 * im);
    }
  };
  expect_pair(free_eigenvalues(system), 2.0, 40.0, 2e5);
  expect_pair(ring_eigenvalues(system), 1.0, 200.0, 1e6);
  expect_pair(joined_eigenvalues(system), 3.0, 240.0, 1.2e6);
}

TEST(RubStability, AFixedRingHoldsTheContactStation) {
  scene::Scene s = test::make_scene({.mass = 1.0, .speed = 100.0});
  s.rotor.modal->mass = {2.0, 2.0};
  s.rotor.modal->stiffness = {2e5, 6e5};
  s.rotor.modal->damping = {0.0, 0.0};
  s.rotor.modal->internal_damping = {0.0, 0.0};
  s.rotor.modal->gyroscopic = {0.0, 0.0};
  // x_1 = -x_2: 4 kg on 8e5 N/m.
  const std::vector<Complex> joined = joined_eigenvalues(rub_system(s));
  ASSERT_EQ(joined.size(), 2U);
  for (const Complex& z : joined) EXPECT_NEAR(std::abs(z.imag()), std::sqrt(2e5), 1e-9 * 447.0);
}

}  // namespace
}  // namespace rotorub::rub
