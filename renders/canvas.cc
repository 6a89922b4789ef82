#include "renders/canvas.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "plugin/model/mujoco_versions.h"

namespace rotorub::renders {

namespace {

using RowMatrix = Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>;

void copy(const Eigen::Vector3d& from, float (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

void set(float (&to)[3], float value) { std::fill(std::begin(to), std::end(to), value); }

}  // namespace

mjvGeom& Canvas::add(int type, const Point& size, const Point& center, const Eigen::Matrix3d& axes,
                     const Color& color) {
  assert(scene_->ngeom < scene_->maxgeom);
  mjvGeom& geom = scene_->geoms[scene_->ngeom++];
  const RowMatrix rows = axes;
  const float rgba[4] = {color.red, color.green, color.blue, color.alpha};
  mjv_initGeom(&geom, type, size.data(), center.data(), rows.data(), rgba);
  geom.category = mjCAT_DECOR;
  geom.emission = finish_.glow;
  geom.specular = finish_.specular;
  geom.shininess = finish_.shininess;
  return geom;
}

void Canvas::connector(int type, const Point& from, const Point& to, double width,
                       const Color& color) {
  mjvGeom& geom = add(type, Point::Zero(), Point::Zero(), Eigen::Matrix3d::Identity(), color);
  plugin::connect(&geom, type, width, from.data(), to.data());
}

void Canvas::cylinder(const Point& from, const Point& to, double radius, const Color& color) {
  connector(mjGEOM_CYLINDER, from, to, radius, color);
}

void Canvas::sphere(const Point& center, double radius, const Color& color) {
  add(mjGEOM_SPHERE, Point::Constant(radius), center, Eigen::Matrix3d::Identity(), color);
}

void Canvas::box(const Point& center, const Point& half_size, const Color& color,
                 const Eigen::Matrix3d& axes) {
  add(mjGEOM_BOX, half_size, center, axes, color);
}

void Canvas::arrow(const Point& from, const Point& to, double width, const Color& color) {
  // MuJoCo draws an arrow with half the length of its connector.
  connector(mjGEOM_ARROW, from, from + 2.0 * (to - from), width, color);
}

void Canvas::mesh(int id, const Point& center, const Eigen::Matrix3d& axes, const Color& color) {
  assert(id >= 0 && id < model_->nmesh);
  // MuJoCo stores a mesh relative to its frame of inertia. This is undone here.
  const Point origin = Point::Map(model_->geom_pos + 3 * id);
  const mjtNum* turn = model_->geom_quat + 4 * id;
  const Eigen::Quaterniond frame(turn[0], turn[1], turn[2], turn[3]);
  // MuJoCo numbers each mesh and its convex hull: 2 id and 2 id + 1.
  add(mjGEOM_MESH, Point::Ones(), center + axes * origin, axes * frame.toRotationMatrix(), color)
      .dataid = 2 * id;
}

void set_view(mjvScene& scene, const View& view) {
  const Eigen::Vector3d ahead = view.target - view.position;
  const double distance = ahead.norm();
  const Eigen::Vector3d forward = ahead / distance;
  const Eigen::Vector3d up = (view.up - view.up.dot(forward) * forward).normalized();
  const double near = std::max(0.02 * distance, distance - view.depth);
  for (mjvGLCamera& camera : scene.camera) {
    copy(view.position, camera.pos);
    copy(forward, camera.forward);
    copy(up, camera.up);
    camera.frustum_center = 0.0F;
    camera.frustum_top = static_cast<float>(view.half_height * near / distance);
    camera.frustum_bottom = -camera.frustum_top;
    camera.frustum_near = static_cast<float>(near);
    camera.frustum_far = static_cast<float>(distance + view.depth);
  }
}

View fitted(View view, std::span<const Eigen::Vector3d> points, double aspect, double margin) {
  const Eigen::Vector3d offset = view.position - view.target;
  const double distance = offset.norm();
  const Eigen::Vector3d forward = -offset / distance;
  const Eigen::Vector3d right = forward.cross(view.up).normalized();
  const Eigen::Vector3d up = right.cross(forward);
  // In perspective the bounding box of the points depends on the target; a few iterations converge.
  for (int round = 0; round < 8; ++round) {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d seen = point - view.position;
      const double scale = distance / seen.dot(forward);  // projects to the plane of the target
      box.extend(Eigen::Vector2d(scale * seen.dot(right), scale * seen.dot(up)));
    }
    view.target += box.center()[0] * right + box.center()[1] * up;
    view.position = view.target + offset;
    view.half_height =
        0.5 * std::max(box.sizes()[0] / aspect, box.sizes()[1]) / (1.0 - 2.0 * margin);
  }
  return view;
}

void set_lights(mjvScene& scene, const Eigen::Vector3d& key_direction, float ambient) {
  scene.nlight = 1;
  mjvLight& light = scene.lights[0];
  light = mjvLight{};
  plugin::make_directional(light);
  copy(key_direction.normalized(), light.dir);
  copy(-10.0 * key_direction.normalized(), light.pos);
  light.attenuation[0] = 1.0F;
  set(light.ambient, ambient);
  set(light.diffuse, 0.95F - ambient);
  set(light.specular, 0.35F);
}

namespace {

using Eigen::Vector3d;

// Unit vector at an angle in the plane perpendicular to the axis.
Vector3d radial(double angle) { return {0.0, std::cos(angle), std::sin(angle)}; }

// A flat or curved quadrilateral, with corners counter-clockwise seen from outside.
void add_quad(Mesh& mesh, const std::array<Vector3d, 4>& corners,
              const std::array<Vector3d, 4>& normals) {
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  mesh.normals.insert(mesh.normals.end(), normals.begin(), normals.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_flat_triangle(Mesh& mesh, const std::array<Vector3d, 3>& corners, const Vector3d& normal) {
  const int first = static_cast<int>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), corners.begin(), corners.end());
  mesh.normals.insert(mesh.normals.end(), 3, normal);
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_flat_quad(Mesh& mesh, const std::array<Vector3d, 4>& corners, const Vector3d& normal) {
  add_quad(mesh, corners, {normal, normal, normal, normal});
}

}  // namespace

Mesh ring_mesh(const std::string& name, const RingShape& shape) {
  assert(shape.inner_radius >= 0.0 && shape.outer_radius > shape.inner_radius);
  assert(shape.half_width > 0.0 && shape.to > shape.from && shape.segments > 0);
  Mesh mesh;
  mesh.name = name;
  const Vector3d axis = Vector3d::UnitX();
  const Vector3d front = shape.half_width * axis;
  const double a = shape.inner_radius;
  const double b = shape.outer_radius;

  for (int i = 0; i < shape.segments; ++i) {
    const double step = (shape.to - shape.from) / shape.segments;
    const Vector3d p = radial(shape.from + i * step);
    const Vector3d q = radial(shape.from + (i + 1) * step);
    // The two faces, the outer surface and the bore.
    if (a > 0.0) {
      add_flat_quad(mesh, {a * p + front, b * p + front, b * q + front, a * q + front}, axis);
      add_flat_quad(mesh, {a * q - front, b * q - front, b * p - front, a * p - front}, -axis);
    } else {
      add_flat_triangle(mesh, {front, b * p + front, b * q + front}, axis);
      add_flat_triangle(mesh, {-front, b * q - front, b * p - front}, -axis);
    }
    add_quad(mesh, {b * p - front, b * q - front, b * q + front, b * p + front}, {p, q, q, p});
    if (a > 0.0) {
      add_quad(mesh, {a * p + front, a * q + front, a * q - front, a * p - front},
               {-p, -q, -q, -p});
    }
  }

  // The flat ends of a partial ring.
  constexpr double kWhole = 6.283185307179586;
  if (shape.to - shape.from < kWhole - 1e-9) {
    const Vector3d p = radial(shape.from);
    const Vector3d q = radial(shape.to);
    add_flat_quad(mesh, {a * p - front, b * p - front, b * p + front, a * p + front},
                  -axis.cross(p));
    add_flat_quad(mesh, {a * q + front, b * q + front, b * q - front, a * q - front},
                  axis.cross(q));
  }
  return mesh;
}

}  // namespace rotorub::renders
