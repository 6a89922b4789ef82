#include "native_model/rotor/complex_eigenvalues.h"

namespace rotorub {

Eigen::ComplexEigenSolver<Eigen::MatrixXcd> complex_eigenvalues(const Eigen::MatrixXcd& A) {
  return Eigen::ComplexEigenSolver<Eigen::MatrixXcd>(A, false);
}

}  // namespace rotorub
