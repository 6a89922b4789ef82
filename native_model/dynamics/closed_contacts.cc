#include "native_model/dynamics/closed_contacts.h"

#include "native_model/dynamics/dynamics.h"

namespace rotorub {

ContactMatrix delassus(const Model& m, double t, const double* q,
                       std::span<const ClosedContact> closed) {
  const auto n = static_cast<Eigen::Index>(closed.size());
  // W_N and W_T in contact space, as in kinematics.h.
  Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 2 * kMaxContacts> w(3, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ClosedContact& c = closed[static_cast<std::size_t>(i)];
    const Eigen::Vector2d &e = c.point.e_r, e_t = c.point.e_t();
    w.col(2 * i) << -e.x(), -e.y(), 0.0;
    w.col(2 * i + 1) << e_t.x(), e_t.y(), m.auxiliary[c.index].contact->radius;
  }
  ContactMatrix g(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Eigen::Matrix3d a =
          contact_admittance(m, m.mass.data(), t, q, closed[static_cast<std::size_t>(i)].index,
                             closed[static_cast<std::size_t>(j)].index);
      const Eigen::Matrix2d block = w.middleCols<2>(2 * i).transpose() * a * w.middleCols<2>(2 * j);
      g.block<2, 2>(2 * i, 2 * j) = block;
      g.block<2, 2>(2 * j, 2 * i) = block.transpose();
    }
  }
  return g;
}

}  // namespace rotorub
