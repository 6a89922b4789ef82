// How far an orbit of several frequencies goes from the origin,
//   d(t) = centre + sum_j Re(a_j e^{i nu_j t}),   a_j a complex vector: an ellipse.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rotorub {

struct OrbitPart {
  double frequency;            // rad/s, >= 0; 0: a constant, its real part
  Eigen::Vector2cd amplitude;  // m
};

struct OrbitSize {
  Eigen::Vector2d centre{0.0, 0.0};  // m
  std::vector<OrbitPart> parts;

  // m: the most of |d| over all time, to 1e-6. Frequencies in the ratio of whole numbers up to
  // kHighest come back, and one period is looked through. Others meet in every phase sooner or
  // later: it is the largest over directions u of centre . u + sum |a_j . u|.
  double largest() const;

  static constexpr int kHighest = 24;
};

}  // namespace rotorub
