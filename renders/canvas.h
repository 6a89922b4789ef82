// Draws the few shapes of the pictures into a MuJoCo scene.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "renders/palette.h"

namespace rotorub::renders {

// Reaction of a surface to light. `glow` adds its own colour; 1 shows exactly that colour.
struct Finish {
  float glow = 0.0F;
  float specular = 0.3F;
  float shininess = 0.4F;
};
inline constexpr Finish kMetal{0.0F, 0.45F, 0.5F};
inline constexpr Finish kMatt{0.15F, 0.05F, 0.1F};
inline constexpr Finish kFlat{0.55F, 0.0F, 0.0F};  // diagrams

// Appends shapes to a scene, all in drawing units, with the axes X along the shaft and Z up. More
// shapes than the scene has room for are a programming error.
class Canvas {
 public:
  using Point = Eigen::Vector3d;

  // `model`: contains the meshes, with one geom each, in their order.
  Canvas(mjvScene& scene, const mjModel& model) : scene_(&scene), model_(&model) {}

  void finish(const Finish& finish) { finish_ = finish; }

  void cylinder(const Point& from, const Point& to, double radius, const Color& color);
  void sphere(const Point& center, double radius, const Color& color);
  void box(const Point& center, const Point& half_size, const Color& color,
           const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());
  void arrow(const Point& from, const Point& to, double width, const Color& color);
  // A mesh of the model in its original shape, at `center`, rotated by `axes`.
  void mesh(int id, const Point& center, const Eigen::Matrix3d& axes, const Color& color);

 private:
  mjvGeom& add(int type, const Point& size, const Point& center, const Eigen::Matrix3d& axes,
               const Color& color);
  void connector(int type, const Point& from, const Point& to, double width, const Color& color);

  mjvScene* scene_;
  const mjModel* model_;
  Finish finish_ = kMetal;
};

// A perspective view for mjvScene::camera; from far away it is almost parallel.
struct View {
  Eigen::Vector3d position{0.0, 0.0, 0.0};
  Eigen::Vector3d target{0.0, 0.0, 0.0};
  Eigen::Vector3d up{0.0, 0.0, 1.0};
  double half_height = 1.0;  // of the visible region at the target
  double depth = 1.0;        // visible range before and behind the target
};
void set_view(mjvScene& scene, const View& view);

// Moves and widens a view, without turning it, until the points fill the picture (width / height =
// `aspect`) up to a margin, given as a fraction of the picture.
View fitted(View view, std::span<const Eigen::Vector3d> points, double aspect, double margin);

// Soft light from above and from the viewer's left, for a camera that looks along +Y or -X.
void set_lights(mjvScene& scene, const Eigen::Vector3d& key_direction, float ambient);

// A triangle mesh for the round parts that MuJoCo has no primitive for. Each corner has a normal,
// and triangles are counter-clockwise seen from outside.
struct Mesh {
  std::string name;
  std::vector<Eigen::Vector3d> points, normals;  // of the same length
  std::vector<std::array<int, 3>> triangles;
};

// A ring around the X axis, from X = -half_width to half_width. `from` and `to`: range of the
// angles, rad, counted from Y towards Z, with to - from in (0, 2 pi]. A partial ring has flat ends.
struct RingShape {
  double inner_radius = 0.0;  // >= 0; 0: a disc
  double outer_radius = 0.0;  // > inner_radius
  double half_width = 0.0;    // > 0
  double from = 0.0;
  double to = 6.283185307179586;
  int segments = 96;  // in this range
};
Mesh ring_mesh(const std::string& name, const RingShape& shape);

}  // namespace rotorub::renders
