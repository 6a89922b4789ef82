// The shaft cut into elements, cylinders and cones, fine enough for a given frequency.
#pragma once

#include <functional>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

// One element, with the number of Legendre functions that carry its curvature (bending) or its
// twist per length (torsion). Two functions of curvature are the Hermite cubic beam element.
struct ShaftElement {
  double from, to;              // m
  scene::ShaftSection section;  // of which it is a part
  int functions = 0;            // >= 1
  double length() const { return to - from; }
  bool tapered() const { return section.tapered(); }
  // At z in [from, to]: m^2, and m^4, I, the second moment of area; the polar one is 2 I.
  double area(double z) const;
  double inertia(double z) const;
};

// Powers of z up to which area and I of a cone go: what a quadrature must be exact for beside them.
inline constexpr int kTaperDegree = 4;

// Elements end at every change of section and at every station given (m, in [0, length]): there the
// solution has a kink in some derivative. wave_number (1/m, of an element): k of the shortest wave
// to be resolved; elements are cut until k h <= 4 and get as many functions as a wave of that
// length needs for frequencies right to round-off.
// Throws scene::SceneError where the mesh would be beyond any sensible size.
std::vector<ShaftElement> shaft_mesh(const scene::RotorGeometry& geometry,
                                     std::vector<double> stations,
                                     const std::function<double(const ShaftElement&)>& wave_number);

// Functions of all elements.
int function_count(const std::vector<ShaftElement>& mesh);

// Element that holds z; at a node the one on the left. z in [0, length].
const ShaftElement& element_at(const std::vector<ShaftElement>& mesh, double z);

// Solves on finer meshes until the highest frequency asked for is below the one that the mesh was
// made for. solve(omega) meshes for omega (rad/s), and returns a result with
// `double highest() const`: the highest frequency asked for; infinite where the mesh has too few
// functions for the number of modes asked for.
template <typename Solve>
auto solve_refined(double omega, const Solve& solve) {
  constexpr double kGrowth = 4.0;   // where nothing is known of the frequency yet
  constexpr double kMargin = 1.05;  // Ritz frequencies fall as the mesh grows finer
  while (true) {
    auto result = solve(omega);
    const double highest = result.highest();
    if (highest <= omega) return result;
    omega = highest < kGrowth * omega ? kMargin * highest : kGrowth * omega;
  }
}

}  // namespace rotorub
