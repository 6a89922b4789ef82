#include "native_model/numerics/matrix_functions.h"

#include <unsupported/Eigen/MatrixFunctions>

namespace rotorub {

Eigen::MatrixXd matrix_exp(const Eigen::MatrixXd& A) { return A.exp(); }

std::optional<Eigen::MatrixXd> matrix_log(const Eigen::MatrixXd& A) {
  if (!A.allFinite()) return {};
  Eigen::MatrixXd log = A.log();
  if (!log.allFinite()) return {};
  return log;
}

}  // namespace rotorub
