#include "native_model/event/first_contact.h"

#include <algorithm>

#include "native_model/numerics/root.h"

namespace rotorub {

Path path_from_nested(const std::array<Eigen::Vector2d, kPathDegree>& f) {
  // From the inside out: p <- (p + F_d) theta for even d, (p + F_d)(1 - theta) for odd.
  Path p;
  p.fill(Eigen::Vector2d::Zero());
  for (int d = kPathDegree - 1; d >= 0; --d) {
    p[0] += f[static_cast<std::size_t>(d)];
    for (std::size_t i = kPathDegree; i >= 1; --i) {
      p[i] = d % 2 == 0 ? p[i - 1] : Eigen::Vector2d(p[i] - p[i - 1]);
    }
    if (d % 2 == 0) p[0].setZero();
  }
  return p;
}

std::optional<double> first_contact(const Path& path, const Eigen::Vector2d& d, double clearance,
                                    Departure departure) {
  // F = |d + Delta d|^2 - delta_0^2, the part of the start without cancellation.
  Polynomial f{2 * kPathDegree, {}};
  f.a[0] = (d.norm() - clearance) * (d.norm() + clearance);
  for (std::size_t i = 1; i <= kPathDegree; ++i) {
    f.a[i] += 2.0 * d.dot(path[i]);
    for (std::size_t j = 1; j <= kPathDegree; ++j) f.a[i + j] += path[i].dot(path[j]);
  }
  const int known = static_cast<int>(departure);
  std::copy(f.a.begin() + known, f.a.end(), f.a.begin());
  f.degree -= known;
  return first_crossing(
      f, departure == Departure::kInside ? RootStart::kBelowZero : RootStart::kAnywhere);
}

}  // namespace rotorub
