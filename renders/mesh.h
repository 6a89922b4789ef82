// Triangle meshes of the round parts that MuJoCo has no primitive for: rings, cut or whole.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace rotorub::renders {

// Surfaces with a normal at each corner; triangles counter-clockwise seen from outside.
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
