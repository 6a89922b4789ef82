#include "native_model/rotor/planar_modes.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {

PlanarModes planar_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  const std::optional<SymmetricModes> found = symmetric_modes(mass, stiffness);
  if (!found) throw RotorNotSolvable("no eigenmodes of the shaft can be found");
  // Ascending omega^-2, so the modes come in reverse. Those that round-off leaves without a
  // frequency of their own are given the highest one that can be distinguished from zero.
  const Eigen::VectorXd compliance = found->values.reverse();
  const double least = std::numeric_limits<double>::epsilon() * compliance[0];
  if (!(least > 0.0))
    throw RotorNotSolvable("mass or stiffness of the shaft is not positive to working precision");

  PlanarModes modes;
  modes.frequency = compliance.cwiseMax(least).cwiseSqrt().cwiseInverse();
  modes.shape = found->vectors.rowwise().reverse();
  for (Eigen::Index j = 0; j < modes.shape.cols(); ++j) {
    const double norm = modes.shape.col(j).dot(mass * modes.shape.col(j));
    modes.shape.col(j) /= std::sqrt(norm);
  }
  return modes;
}

PlanarModes free_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                       double reference) {
  constexpr double kFree = 1e-9;  // of the square of the reference: what round-off leaves
  const double shift = reference * reference;
  PlanarModes modes = planar_modes(mass, stiffness + shift * mass);
  for (double& omega : modes.frequency) {
    const double square = omega * omega - shift;
    omega = square > kFree * shift ? std::sqrt(square) : 0.0;
  }
  return modes;
}

ModalSums modal_sums(const PlanarModes& modes, const Eigen::RowVectorXd& u) {
  const Eigen::VectorXd square = (u * modes.shape).cwiseAbs2().transpose();
  ModalSums sums{square, square.cwiseQuotient(modes.frequency.cwiseAbs2())};
  for (auto* sum : {&sums.mobility, &sums.flexibility}) {
    std::partial_sum(sum->begin(), sum->end(), sum->begin());
  }
  return sums;
}

}  // namespace rotorub
