#include "renders/canvas.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace rotorub::renders {
namespace {

constexpr double kPi = std::numbers::pi;

// Volume enclosed, by the divergence theorem: right only if every triangle faces outwards and
// none is missing.
double volume(const Mesh& mesh) {
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(i)]; };
    six += at(a).dot(at(b).cross(at(c)));
  }
  return six / 6.0;
}

// Area of the regular polygon that stands for a circle of radius 1, per radian.
double polygon(double step) { return 0.5 * std::sin(step) / step; }

TEST(Mesh, RingEnclosesItsVolume) {
  const Mesh ring = ring_mesh("ring", {0.3, 0.5, 0.1, 0.0, 2.0 * kPi, 64});
  const double expected = 0.2 * (0.25 - 0.09) * 2.0 * kPi * polygon(2.0 * kPi / 64);
  EXPECT_NEAR(volume(ring), expected, 1e-12);
}

TEST(Mesh, PartOfARingIsClosedByFlatEnds) {
  const Mesh part = ring_mesh("part", {0.3, 0.5, 0.1, 0.4, 2.4, 20});
  EXPECT_NEAR(volume(part), 0.2 * (0.25 - 0.09) * 2.0 * polygon(0.1), 1e-12);
}

TEST(Mesh, RingWithoutABoreIsADisc) {
  const Mesh disc = ring_mesh("disc", {0.0, 0.5, 0.1, 0.0, 2.0 * kPi, 48});
  EXPECT_NEAR(volume(disc), 0.2 * 0.25 * 2.0 * kPi * polygon(2.0 * kPi / 48), 1e-12);
}

TEST(Mesh, NormalsPointOutwardsAndHaveLengthOne) {
  for (const double bore : {0.0, 0.3}) {
    const Mesh mesh = ring_mesh("ring", {bore, 0.5, 0.1, 0.3, 4.0, 32});
    ASSERT_EQ(mesh.points.size(), mesh.normals.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto at = [&](int i) { return mesh.points[static_cast<std::size_t>(i)]; };
      const Eigen::Vector3d face = (at(b) - at(a)).cross(at(c) - at(a));
      EXPECT_GT(face.norm(), 0.0);  // MuJoCo refuses triangles without area
      for (const int corner : {a, b, c}) {
        const Eigen::Vector3d normal = mesh.normals[static_cast<std::size_t>(corner)];
        EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
        EXPECT_GT(normal.dot(face.normalized()), 0.9);
      }
    }
  }
}

}  // namespace
}  // namespace rotorub::renders
