#include "native_model/linear/stiffness_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "native_model/linear/campbell.h"
#include "tests/native_model/rotor/rotors.h"
#include "tests/support/jeffcott.h"
#include "tests/support/oracles/shafts.h"

namespace rotorub {
namespace {

using Of = StiffnessMap::Of;

// The only map of this kind.
std::optional<StiffnessMap> map_of(Of of, const scene::Scene& scene) {
  std::optional<StiffnessMap> found;
  for (const StiffnessMap& map : stiffness_maps(scene)) {
    if (map.of != of) continue;
    EXPECT_FALSE(found);
    found = map;
  }
  return found;
}

// A slender shaft of 1 m on a bearing at either end that is far softer than the shaft.
scene::Scene on_two_bearings(double stiffness) {
  scene::RotorGeometry g;
  g.length = 1.0;
  g.E = 210e9;
  g.rho = 7850.0;
  g.modes = 3;
  g.sections = {{0.0, 1.0, 20e-3}};
  scene::ShaftBearing bearing;
  bearing.stiffness = {stiffness, stiffness};
  g.bearings = {bearing, bearing};
  g.bearings[1].z = 1.0;
  return test::scene_of(g);
}

TEST(StiffnessMap, GoesFromTheRigidRotorToTheShaftOnPins) {
  const auto map = map_of(Of::kBearings, on_two_bearings(1e5));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->own, 1e5);
  ASSERT_EQ(map->stiffness.size(), map->critical.size());
  // Soft: it bounces, m w^2 = 2 k, and what it bends by is of the order of k over its stiffness.
  const double area = std::numbers::pi * 1e-4, mass = 7850.0 * area,
               inertia = std::numbers::pi / 4.0 * 1e-8;
  const double bounce = std::sqrt(2.0 * map->stiffness.front() / mass);
  EXPECT_NEAR(map->critical.front()[0] / bounce, 1.0, 1e-3);
  // Stiff: the first mode between pins, but for rotary inertia and gyroscopic moments, which take
  // each other's effect away in forward whirl of a cylinder: (1 + r^2 l^2) - 2 r^2 l^2.
  const double l = std::numbers::pi, r2 = inertia / area;
  const double pinned = l * l * std::sqrt(210e9 * inertia / (7850.0 * area) / (1.0 - r2 * l * l));
  EXPECT_NEAR(map->critical.back()[0] / pinned, 1.0, 1e-3);
  for (std::size_t k = 1; k < map->critical.size(); ++k)
    EXPECT_GT(map->critical[k][0], map->critical[k - 1][0]) << "a stiffer spring";
}

TEST(StiffnessMap, NeedsSpringsThatDoNotFollowTheSpeed) {
  EXPECT_FALSE(map_of(Of::kBearings, on_two_bearings(0.0))) << "no springs";
  scene::Scene s = on_two_bearings(1e6);
  s.rotor.geometry->bearings[0].table_speed = {0.0, 100.0};
  s.rotor.geometry->bearings[0].table_kxx = {1e6, 2e6};
  EXPECT_FALSE(map_of(Of::kBearings, s));
}

// One mode on its spring, and the ring on its own: apart sqrt(k / m), held together
// sqrt((K + k) / (M + m)).
TEST(StiffnessMap, OfARingOnItsSpringHasTheClosedForms) {
  constexpr double kRotor = 2e5, kMass = 2.0, kRing = 1e6, kRingMass = 0.7;
  scene::Scene s = test::make_scene({.mass = kMass, .stiffness = kRotor, .speed = 150.0});
  EXPECT_TRUE(stiffness_maps(s).empty()) << "the ring is fixed";
  test::add_ring(s, kRingMass, 30.0, kRing);
  const auto map = map_of(Of::kRing, s);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->own, kRing);
  EXPECT_NEAR(map->stiffness.front(), 1e-3 * kRing, 1e-9 * kRing);
  ASSERT_EQ(map->critical.size(), map->stiffness.size());
  for (std::size_t i = 0; i < map->stiffness.size(); ++i) {
    const double k = map->stiffness[i], held = std::sqrt((kRotor + k) / (kMass + kRingMass));
    ASSERT_EQ(map->ring.at(i).size(), 1u);
    EXPECT_NEAR(map->ring[i][0] / std::sqrt(k / kRingMass), 1.0, 1e-12);
    ASSERT_EQ(map->critical[i].size(), 1u);
    EXPECT_NEAR(map->critical[i][0] / held, 1.0, 1e-12);
  }
  // A passive controller's spring carries it, too; planes that differ are critical each.
  s.first().controller.emplace().stiffness = 5e5;
  s.first().stator->stiffness = {kRing, 2.0 * kRing};
  const auto both = map_of(Of::kRing, s);
  ASSERT_TRUE(both);
  EXPECT_EQ(both->own, 1.5e6);
  const std::vector<double>& at_own = both->ring[both->ring.size() / 2];
  ASSERT_EQ(at_own.size(), 2u);
  EXPECT_NEAR(at_own[0] / std::sqrt(1.5e6 / kRingMass), 1.0, 1e-12);
  EXPECT_NEAR(at_own[1] / std::sqrt(2.5e6 / kRingMass), 1.0, 1e-12);
}

// m_1 m_2 w^4 - (m_1 (k_1 + k_2) + m_2 k_1) w^2 + k_1 k_2 = 0 of a ring m_1 on a spring k_1 on its
// housing m_2 on k_2; with the rotor held to the ring, M and K join m_1 and the row of the ring.
TEST(StiffnessMap, OfAMountHasTheClosedForms) {
  constexpr double kRotor = 2e5, kMass = 2.0, k1 = 1e6, m1 = 0.7, m2 = 3.0;
  scene::Scene s = test::make_scene({.mass = kMass, .stiffness = kRotor, .speed = 150.0});
  test::add_ring(s, m1, 30.0, k1);
  s.first().stator->mount = scene::Housing{{m2, m2}, {4e6, 4e6}, {0.0, 0.0}};
  const auto map = map_of(Of::kMount, s);
  ASSERT_TRUE(map && map_of(Of::kRing, s));
  EXPECT_EQ(map->own, 4e6);
  const auto roots = [](double m, double beside, double k2) {
    // m w^2 = k1 + beside - k1^2 / (k1 + k2 - m2 w^2).
    const double b = m * (k1 + k2) + m2 * (k1 + beside), a = m * m2,
                 c = (k1 + beside) * (k1 + k2) - k1 * k1;
    const double high = (b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    return std::vector<double>{std::sqrt(c / a / high), std::sqrt(high)};
  };
  for (std::size_t i = 0; i < map->stiffness.size(); ++i) {
    const auto alone = roots(m1, 0.0, map->stiffness[i]),
               held = roots(m1 + kMass, kRotor, map->stiffness[i]);
    ASSERT_EQ(map->ring.at(i).size(), 2u);
    ASSERT_EQ(map->critical.at(i).size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(map->ring[i][k] / alone[k], 1.0, 1e-10);
      EXPECT_NEAR(map->critical[i][k] / held[k], 1.0, 1e-10);
    }
  }
}

// A ring that is held to a shaft at a station acts as a disc there, without moments of inertia, on
// a bearing.
TEST(StiffnessMap, OfARingIsThatOfAShaftWithADiscOnABearing) {
  scene::Scene s;
  s.rotor.speed = 100.0;
  s.rotor.geometry = oracle::friswell_rotor();
  s.rotor.geometry->bearings[0].stiffness.y() *= 1.7;
  s.first().contact.emplace().station = 0.7;
  scene::Stator& ring = s.first().stator.emplace();
  ring.mass = {8.0, 8.0};
  ring.stiffness = {3e6, 5e6};
  const auto map = map_of(Of::kRing, s);
  ASSERT_TRUE(map);
  scene::Scene same = s;
  scene::Disc disc;
  disc.z = 0.7;
  disc.mass = 8.0;
  same.rotor.geometry->discs.push_back(disc);
  scene::ShaftBearing bearing;
  bearing.z = 0.7;
  bearing.stiffness = ring.stiffness;
  same.rotor.geometry->bearings.push_back(bearing);
  const std::vector<double> exact = critical_speeds(whirl_system(same));
  const std::vector<double>& found = map->critical[map->critical.size() / 2];
  ASSERT_GE(found.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k] / exact[k], 1.0, 1e-9) << k;
}

TEST(StiffnessMap, OfARingNeedsALinearSpring) {
  scene::Scene s = test::make_scene({.mass = 2.0});
  test::add_ring(s, 1.0, 0.0, 0.0);
  EXPECT_FALSE(map_of(Of::kRing, s)) << "no spring";
  s.first().stator->stiffness = {1e6, 1e6};
  s.first().stator->ball_bearing = scene::BallSupport{.balls = 8, .stiffness = 1e9};
  EXPECT_FALSE(map_of(Of::kRing, s)) << "balls that bear from their play on";
}

// sqrt((K + k_i P - k_s) / M).
TEST(StiffnessMap, OfMagnetsGoesOverTheSpringThatTheirControlsLeave) {
  scene::Scene s = test::make_scene({.mass = 2.0, .stiffness = 4e4});
  EXPECT_FALSE(map_of(Of::kMagnets, s));
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, 1e5}};
  s.magnetic_bearings[0].control =
      scene::BearingControl{.force_per_current = 80.0, .proportional = 4000.0};
  const auto map = map_of(Of::kMagnets, s);
  ASSERT_TRUE(map);
  EXPECT_NEAR(map->own, 2.2e5, 1e-9);
  for (std::size_t i = 0; i < map->stiffness.size(); ++i) {
    ASSERT_EQ(map->critical.at(i).size(), 1u);
    EXPECT_NEAR(map->critical[i][0] / std::sqrt((4e4 + map->stiffness[i]) / 2.0), 1.0, 1e-9);
  }
  // Seen where the mode is 0.8 of what it is at the magnets: K + 0.8 (k + k_s) - k_s, of either
  // sign.
  s.magnetic_bearings[0].sensor_shape = {0.8};
  s.rotor.modal->stiffness = {1e4};
  const auto beside = map_of(Of::kMagnets, s);
  ASSERT_TRUE(beside);
  int held = 0;
  for (std::size_t i = 0; i < beside->stiffness.size(); ++i) {
    const double spring = 1e4 + 0.8 * (beside->stiffness[i] + 1e5) - 1e5;
    ASSERT_EQ(beside->critical.at(i).size(), spring > 0.0 ? 1u : 0u) << spring;
    if (!(spring > 0.0)) continue;
    ++held;
    EXPECT_NEAR(beside->critical[i][0] / std::sqrt(spring / 2.0), 1.0, 1e-9);
  }
  EXPECT_GT(held, 0);
  EXPECT_LT(held, 49);
}

}  // namespace
}  // namespace rotorub
