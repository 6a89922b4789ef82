#include "renders/mesh.h"

#include <Eigen/Geometry>

#include <cassert>
#include <cmath>

namespace rotorub::renders {

namespace {

using Eigen::Vector3d;

// Unit vector at an angle in the plane across the axis.
Vector3d radial(double angle) { return {0.0, std::cos(angle), std::sin(angle)}; }

// A flat or bent quadrilateral, corners counter-clockwise seen from outside.
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
    // The two faces, the outside and the bore.
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

  // The flat ends of a part of a ring.
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
