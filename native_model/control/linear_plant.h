// Rotor and ring without contact, at a held spin speed, as linear equations for the design of a
// law:
//
//   x' = A x + B u + D d,   y = C x,   x = (x_1..x_n, y_1..y_n, ring x, ring y, and their rates),
//
// u the force on the ring, N, fixed frame; d forces on the rotor at the contact and on the ring, N,
// (x, y) each; y = (rotor x, y at the contact, ring x, y), m. Forces, unbalance, weight and
// magnets' pull are no part of it: they are what disturbs it.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace rotorub {

struct LinearPlant {
  Eigen::MatrixXd a;  // 2 N x 2 N, N = 2 n + 2
  Eigen::MatrixXd b;  // 2 N x 2
  Eigen::MatrixXd d;  // 2 N x 4
  Eigen::MatrixXd c;  // 4 x 2 N
  // Of a model's coordinates those of the states, N: x_i = q[coordinates[i]], x_{N+i} =
  // v[coordinates[i]].
  std::vector<int> coordinates;
};

// Over samples of T (s): x_{k+1} = A x_k + B u_k + D d_k under held u and d.
LinearPlant sampled(const LinearPlant& plant, double sample_time);

}  // namespace rotorub
