#include "native_model/control/linear_plant.h"

#include "native_model/numerics/matrix_functions.h"

namespace rotorub {

// exp(T [A B; 0 0]) = [A_d B_d; 0 1] (Van Loan 1978).
LinearPlant sampled(const LinearPlant& plant, double sample_time) {
  const Eigen::Index n = plant.a.rows(), u = plant.b.cols(), m = u + plant.d.cols();
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n + m, n + m);
  block.topLeftCorner(n, n) = sample_time * plant.a;
  block.topRightCorner(n, m) << sample_time * plant.b, sample_time * plant.d;
  const Eigen::MatrixXd over = matrix_exp(block);
  return {over.topLeftCorner(n, n), over.block(0, n, n, u), over.topRightCorner(n, m - u), plant.c,
          plant.coordinates};
}

}  // namespace rotorub
