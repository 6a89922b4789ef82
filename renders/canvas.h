// Drawing into a MuJoCo scene: the few shapes that the pictures are made of.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <span>

namespace rotorub::renders {

struct Color {
  float red, green, blue;
  float alpha = 1.0F;

  Color with_alpha(double value) const { return {red, green, blue, static_cast<float>(value)}; }
};

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

  explicit Canvas(mjvScene& scene) : scene_(&scene) {}

  void clear() { scene_->ngeom = 0; }
  void finish(const Finish& finish) { finish_ = finish; }

  void cylinder(const Point& from, const Point& to, double radius, const Color& color);
  void capsule(const Point& from, const Point& to, double radius, const Color& color);
  void sphere(const Point& center, double radius, const Color& color);
  void box(const Point& center, const Point& half_size, const Color& color,
           const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity());
  void arrow(const Point& from, const Point& to, double width, const Color& color);
  void line(const Point& from, const Point& to, double pixels, const Color& color);
  // A mesh of the stage, by its number there; `axes`: its turn.
  void mesh(int id, const Point& center, const Eigen::Matrix3d& axes, const Color& color);

 private:
  mjvGeom& add(int type, const Point& size, const Point& center, const Eigen::Matrix3d& axes,
               const Color& color);
  void connector(int type, const Point& from, const Point& to, double width, const Color& color);

  mjvScene* scene_;
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

}  // namespace rotorub::renders
