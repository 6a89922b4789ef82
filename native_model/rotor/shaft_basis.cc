#include "native_model/rotor/shaft_basis.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "native_model/rotor/legendre.h"

namespace rotorub {
namespace {

// Coordinate of z in the element, in [-1, 1].
double local(const ShaftElement& element, double z) {
  return std::clamp(2.0 * (z - element.from) / element.length() - 1.0, -1.0, 1.0);
}

// int factor I P_m P_n dz of each element's Legendre polynomials, after `first` rows of zeros.
Eigen::MatrixXd inertia_integral(const std::vector<ShaftElement>& mesh, int first, double factor) {
  const int size = first + function_count(mesh);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  int at = first;
  for (const ShaftElement& element : mesh) {
    const int n = element.functions;
    if (element.tapered()) {
      const GaussRule rule = gauss_legendre(n + kTaperDegree / 2);
      for (int i = 0; i < rule.node.size(); ++i) {
        const double z = element.from + 0.5 * element.length() * (1.0 + rule.node[i]);
        const double weight = factor * element.inertia(z) * 0.5 * element.length() * rule.weight[i];
        const Eigen::VectorXd p = integrated_legendre(n, rule.node[i]).value;
        sum.block(at, at, n, n) += weight * p * p.transpose();
      }
    } else {
      for (int k = 0; k < n; ++k) {
        sum(at + k, at + k) =
            factor * element.inertia(element.from) * element.length() / (2 * k + 1);
      }
    }
    at += n;
  }
  return sum;
}

}  // namespace

BendingBasis::BendingBasis(std::vector<ShaftElement> mesh, double first_anchor,
                           double second_anchor)
    : mesh_(std::move(mesh)), first_(first_anchor), second_(second_anchor) {
  assert(first_ < second_);
  raw_at_first_ = raw(first_, 0);
  raw_at_second_ = raw(second_, 0);
}

// Twice integrated curvature from the shaft's left end. Left of its element a function is 0; to the
// right it goes on straight: its slope is h (n = 0) or 0, and it has moved by h^2/2 (n = 0),
// -h^2/6 (n = 1) or 0.
Eigen::RowVectorXd BendingBasis::raw(double z, int derivative) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size());
  int at = 2;
  for (const ShaftElement& element : mesh_) {
    const double h = element.length();
    if (z > element.to) {
      const double after = z - element.to;
      row[at] = derivative == 0 ? h * (0.5 * h + after) : h;
      if (derivative == 0 && element.functions > 1) row[at + 1] = -h * h / 6.0;
    } else if (z > element.from) {
      const LegendreValues values = integrated_legendre(element.functions, local(element, z));
      row.segment(at, element.functions) = derivative == 0
                                               ? 0.25 * h * h * values.second.transpose()
                                               : 0.5 * h * values.first.transpose();
    }
    at += element.functions;
  }
  return row;
}

Eigen::RowVectorXd BendingBasis::deflection(double z) const {
  const double t = (z - first_) / (second_ - first_);
  Eigen::RowVectorXd row = raw(z, 0) - (1.0 - t) * raw_at_first_ - t * raw_at_second_;
  row[0] = 1.0 - t;
  row[1] = t;
  return row;
}

Eigen::RowVectorXd BendingBasis::slope(double z) const {
  const double rate = 1.0 / (second_ - first_);
  Eigen::RowVectorXd row = raw(z, 1) - rate * (raw_at_second_ - raw_at_first_);
  row[0] = -rate;
  row[1] = rate;
  return row;
}

Eigen::MatrixXd BendingBasis::curvature_integral() const { return inertia_integral(mesh_, 2, 1.0); }

TorsionBasis::TorsionBasis(std::vector<ShaftElement> mesh)
    : mesh_(std::move(mesh)), offset_(Eigen::RowVectorXd::Zero(function_count(mesh_))) {}

Eigen::RowVectorXd TorsionBasis::angle(double z) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size());
  int at = 0;
  for (const ShaftElement& element : mesh_) {
    const double h = element.length();
    if (z > element.to) {
      row[at] = h;
    } else if (z > element.from) {
      row.segment(at, element.functions) =
          0.5 * h * integrated_legendre(element.functions, local(element, z)).first.transpose();
    }
    at += element.functions;
  }
  return row - offset_;
}

Eigen::MatrixXd TorsionBasis::twist_integral() const { return inertia_integral(mesh_, 0, 2.0); }

}  // namespace rotorub
