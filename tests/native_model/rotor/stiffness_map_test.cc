#include "native_model/rotor/stiffness_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "native_model/rotor/campbell.h"
#include "tests/native_model/rotor/rotors.h"

namespace rotorub {
namespace {

// A slender shaft of 1 m on a bearing at either end, softer by far than itself.
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
  const auto map = stiffness_map(on_two_bearings(1e5));
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

TEST(StiffnessMap, HasTheScenesCriticalSpeedsAtItsOwnStiffness) {
  const scene::Scene s = on_two_bearings(1e6);
  const auto map = stiffness_map(s);
  ASSERT_TRUE(map);
  const std::size_t middle = map->stiffness.size() / 2;
  EXPECT_EQ(map->stiffness[middle], 1e6);
  EXPECT_EQ(map->critical[middle], critical_speeds(whirl_system(s)));
}

TEST(StiffnessMap, NeedsSpringsThatDoNotFollowTheSpeed) {
  EXPECT_FALSE(stiffness_map(on_two_bearings(0.0))) << "no springs";
  scene::Scene s = on_two_bearings(1e6);
  s.rotor.geometry->bearings[0].table_speed = {0.0, 100.0};
  s.rotor.geometry->bearings[0].table_kxx = {1e6, 2e6};
  EXPECT_FALSE(stiffness_map(s));
}

}  // namespace
}  // namespace rotorub
