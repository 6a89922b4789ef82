#include "native_model/system/plant_of.h"

#include <cassert>

#include "native_model/dynamics/dynamics.h"

namespace rotorub {

// The loads are linear in what the states hold: a column is what one state changes of them.
LinearPlant plant_of(const Model& given, std::size_t bearing, double speed) {
  const Model model = with_linear_feedback(given);
  const AuxiliaryBearing& at = model.auxiliary[bearing];
  assert(at.moves() && at.contact);
  const Layout& l = model.layout;
  LinearPlant p;
  for (int i = 0; i < 2 * l.modes; ++i) p.coordinates.push_back(i);
  for (int k = 0; k < 2; ++k) p.coordinates.push_back(at.ring + k);
  const auto half = static_cast<Eigen::Index>(p.coordinates.size()), n = 2 * half;
  const int nq = l.nq();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(2 * nq);
  if (l.spin) y[nq + l.phi()] = speed;
  Eigen::VectorXd rest(nq), moved(nq);
  unactuated_force(model, 0.0, y.data(), y.data() + nq, rest.data());
  p.a = Eigen::MatrixXd::Zero(n, n);
  p.a.topRightCorner(half, half).setIdentity();
  for (Eigen::Index j = 0; j < n; ++j) {
    const int state = (j < half ? 0 : nq) + p.coordinates[static_cast<std::size_t>(j % half)];
    y[state] += 1.0;
    unactuated_force(model, 0.0, y.data(), y.data() + nq, moved.data());
    y[state] -= 1.0;
    for (Eigen::Index i = 0; i < half; ++i) {
      const int row = p.coordinates[static_cast<std::size_t>(i)];
      p.a(half + i, j) = (moved[row] - rest[row]) / model.mass[row];
    }
  }
  p.b = Eigen::MatrixXd::Zero(n, 2);
  p.c = Eigen::MatrixXd::Zero(4, n);
  for (int k = 0; k < 2; ++k) {
    p.b(n - 2 + k, k) = 1.0 / model.mass[at.ring + k];
    p.c(2 + k, half - 2 + k) = 1.0;
  }
  p.c.block(0, l.x(), 1, l.modes) = at.shape.x.transpose();
  p.c.block(1, l.y(), 1, l.modes) = at.shape.y.transpose();
  p.d = Eigen::MatrixXd::Zero(n, 4);
  p.d.rightCols(2) = p.b;
  const auto mobility = [&](const Eigen::VectorXd& shape, int first) {
    return shape.cwiseQuotient(model.mass.segment(first, l.modes)).eval();
  };
  p.d.block(half + l.x(), 0, l.modes, 1) = mobility(at.shape.x, l.x());
  p.d.block(half + l.y(), 1, l.modes, 1) = mobility(at.shape.y, l.y());
  return p;
}

}  // namespace rotorub
