#include "renders/stage.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

constexpr int kSize = 200;  // pixels, showing 2 drawing units
constexpr double kPixelsPerUnit = 100.0;
const Color kRed{1.0F, 0.0F, 0.0F};

bool red(int r, int g, int b) { return r > 100 && g < 80 && b < 80; }

// A picture of what `draw` adds before a camera that looks along -X: Y to the right, Z up.
Picture picture_of(const std::vector<Mesh>& meshes, const std::function<void(Canvas&)>& draw) {
  const MujocoErrors errors;
  Stage stage({kSize, kSize, 0, {1.0F, 1.0F, 1.0F}}, meshes);
  View view;
  view.position = {50.0, 0.0, 0.0};
  view.half_height = 1.0;
  view.depth = 2.0;
  set_view(stage.scene(), view);
  set_lights(stage.scene(), {-1.0, 0.0, 0.0}, 0.4F);
  Canvas canvas = stage.canvas();
  draw(canvas);
  Picture picture(kSize, kSize);
  stage.render(picture, {0, 0, kSize, kSize});
  return picture;
}

TEST(Stage, UpIsUpAndRightIsRight) {
  const Picture shown = picture_of({}, [](Canvas& canvas) {
    canvas.sphere({0.0, 0.5, 0.3}, 0.1, kRed);
  });
  const Found ball = find(shown, red);
  ASSERT_GT(ball.count, 100);
  constexpr double kPixels = 1.5;
  EXPECT_NEAR(ball.column, kSize / 2 + 0.5 * kPixelsPerUnit, kPixels);
  EXPECT_NEAR(ball.row, kSize / 2 - 0.3 * kPixelsPerUnit, kPixels);
}

TEST(Stage, ArrowReachesFromEndToEnd) {
  const Picture shown = picture_of({}, [](Canvas& canvas) {
    canvas.arrow({0.0, -0.6, 0.0}, {0.0, 0.6, 0.0}, 0.05, kRed);
  });
  int first = kSize, last = 0;
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const auto p = shown.pixel(column, row);
      if (!red(p[0], p[1], p[2])) continue;
      first = std::min(first, column);
      last = std::max(last, column);
    }
  }
  EXPECT_NEAR(first, kSize / 2 - 60, 2);
  EXPECT_NEAR(last, kSize / 2 + 60, 3);  // the tip is thin
}

TEST(Stage, MeshIsDrawnAsItWasGiven) {
  // The upper right quarter of a ring: MuJoCo shifts and turns it into its frame of inertia, which
  // must be undone.
  const std::vector<Mesh> meshes{ring_mesh("quarter", {0.4, 0.8, 0.05, 0.0, 1.5707963, 24})};
  const auto drawn = [&](const Eigen::Matrix3d& axes) {
    return picture_of(meshes, [&](Canvas& canvas) { canvas.mesh(0, {0.0, 0.0, 0.0}, axes, kRed); });
  };
  const Picture upright = drawn(Eigen::Matrix3d::Identity());
  const int half = kSize / 2;
  const int inside = find(upright, half, 0, kSize, half, red).count;
  EXPECT_NEAR(inside, 0.25 * 3.14159 * (0.64 - 0.16) * kPixelsPerUnit * kPixelsPerUnit, 120);
  EXPECT_LT(find(upright, red).count - inside, 60);  // nothing beyond the quarter but its rim

  // Turned a quarter about X, from Y towards Z: now the upper left one.
  const Picture turned =
      drawn(Eigen::AngleAxisd(1.5707963, Eigen::Vector3d::UnitX()).toRotationMatrix());
  EXPECT_NEAR(find(turned, 0, 0, half, half, red).count, inside, 120);
}

TEST(Stage, MujocosErrorsAreExceptions) {
  {
    const MujocoErrors errors;
    EXPECT_THROW(mju_error("as said"), std::runtime_error);
  }
  EXPECT_EQ(mju_user_error, nullptr);
}

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

// A whole ring, a part of one with flat ends, and a disc.
TEST(Mesh, RingEnclosesItsVolume) {
  struct Case {
    double bore, from, to;
    int pieces;
  };
  for (const Case& c :
       {Case{0.3, 0.0, 2.0 * kPi, 64}, {0.3, 0.4, 2.4, 20}, {0.0, 0.0, 2.0 * kPi, 48}}) {
    const Mesh mesh = ring_mesh("ring", {c.bore, 0.5, 0.1, c.from, c.to, c.pieces});
    const double angle = c.to - c.from;
    EXPECT_NEAR(volume(mesh), 0.2 * (0.25 - c.bore * c.bore) * angle * polygon(angle / c.pieces),
                1e-12);
  }
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
