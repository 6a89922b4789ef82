#include "native_model/model/linear_parts.h"

#include <complex>

#include "native_model/model/loads.h"

namespace rotorub {

LinearParts linear_parts(const Model& given, double speed) {
  const Model m = without_offsets(with_linear_feedback(given));
  const int nq = m.nq(), size = 2 * m.layout.modes;
  const auto works = equations::working_at(m, 0.0);
  LinearParts parts{m.mass.head(size), m.damping.head(size).asDiagonal(),
                    m.stiffness.head(size).asDiagonal()};
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(nq);
  Eigen::VectorXd f(nq);
  for (int j = 0; j < size; ++j) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(nq, j);
    f.setZero();
    equations::add_linear_loads(m, speed, works.data(), unit.data(), rest.data(), f.data());
    parts.stiffness.col(j) -= f.head(size);
    f.setZero();
    equations::add_linear_loads(m, speed, works.data(), rest.data(), unit.data(), f.data());
    equations::add_gyroscopic(m, speed, unit.data(), f.data());
    parts.damping.col(j) -= f.head(size);
  }
  return parts;
}

Eigen::MatrixXcd dynamic_stiffness(const LinearParts& parts, double w) {
  using Complex = std::complex<double>;
  Eigen::MatrixXcd z = parts.stiffness.cast<Complex>();
  z += Complex(0.0, w) * parts.damping.cast<Complex>();
  z.diagonal() -= (w * w * parts.mass).cast<Complex>();
  return z;
}

}  // namespace rotorub
