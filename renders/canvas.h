// Drawing into a MuJoCo scene: the few shapes that the pictures are made of.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "renders/palette.h"

namespace rotorub::renders {

// How a surface takes light. `glow` adds its own colour, so that 1 shows the colour itself.
struct Finish {
  float glow = 0.0F;
  float specular = 0.3F;
  float shininess = 0.4F;
};
inline constexpr Finish kMetal{0.0F, 0.45F, 0.5F};
inline constexpr Finish kMatt{0.15F, 0.05F, 0.1F};
inline constexpr Finish kFlat{0.55F, 0.0F, 0.0F};  // diagrams

// Appends shapes to a scene, all in drawing units, axes X along the shaft, Z up. Shapes beyond the
// room of the scene are a programmer's mistake.
class Canvas {
 public:
  using Point = Eigen::Vector3d;

  // `model`: has the meshes, one geom each, in their order.
  Canvas(mjvScene& scene, const mjModel& model) : scene_(&scene), model_(&model) {}

  void finish(const Finish& finish) { finish_ = finish; }

  void cylinder(const Point& from, const Point& to, double radius, const Color& color);
  void sphere(const Point& center, double radius, const Color& color);
  void box(const Point& center, const Point& half_size, const Color& color,
           const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());
  void arrow(const Point& from, const Point& to, double width, const Color& color);
  // A mesh of the model as it was given, at `center`, turned by `axes`.
  void mesh(int id, const Point& center, const Eigen::Matrix3d& axes, const Color& color);

 private:
  mjvGeom& add(int type, const Point& size, const Point& center, const Eigen::Matrix3d& axes,
               const Color& color);
  void connector(int type, const Point& from, const Point& to, double width, const Color& color);

  mjvScene* scene_;
  const mjModel* model_;
  Finish finish_ = kMetal;
};

// An (almost) parallel or a perspective view, for mjvScene::camera.
struct View {
  Eigen::Vector3d position{0.0, 0.0, 0.0};
  Eigen::Vector3d target{0.0, 0.0, 0.0};
  Eigen::Vector3d up{0.0, 0.0, 1.0};
  double half_height = 1.0;  // of what is seen at the target
  double depth = 1.0;        // what is seen reaches this far before and behind the target
};
void set_view(mjvScene& scene, const View& view);

// Moves and widens a view, without turning it, until the points fill the picture (width / height =
// `aspect`) but for a margin, a share of the picture.
View fitted(View view, std::span<const Eigen::Vector3d> points, double aspect, double margin);

// Soft light from above and the viewer's left, for a camera that looks along +Y or -X.
void set_lights(mjvScene& scene, const Eigen::Vector3d& key_direction, float ambient);

// A triangle mesh, of the round parts that MuJoCo has no primitive for: a normal at each corner;
// triangles counter-clockwise seen from outside.
struct Mesh {
  std::string name;
  std::vector<Eigen::Vector3d> points, normals;  // equally long
  std::vector<std::array<int, 3>> triangles;
};

// A ring around the X axis, from X = -half_width to half_width. `from` and `to`: the angles kept,
// rad, counted from Y towards Z, to - from in (0, 2 pi]; a part of a ring has flat ends.
struct RingShape {
  double inner_radius = 0.0;  // >= 0; 0: a disc
  double outer_radius = 0.0;  // > inner_radius
  double half_width = 0.0;    // > 0
  double from = 0.0;
  double to = 6.283185307179586;
  int segments = 96;  // of the part kept
};
Mesh ring_mesh(const std::string& name, const RingShape& shape);

}  // namespace rotorub::renders
