// The classes BendingBasis and TorsionBasis of shaft_basis.h.

#include <algorithm>
#include <cassert>
#include <utility>

#include "native_model/rotor/shaft_basis.h"

namespace rotorub {
namespace {

// Local coordinate of z in the element, in [-1, 1].
double local(const ShaftElement& element, double z) {
  return std::clamp(2.0 * (z - element.from) / element.length() - 1.0, -1.0, 1.0);
}

// sum(at + m, at + n) += int weight(z) P_m P_n dz of the first n Legendre polynomials of an
// element.
template <typename Weight>
void add_integral(const ShaftElement& element, int at, int n, const Weight& weight,
                  Eigen::MatrixXd& sum) {
  if (element.tapered()) {
    for_each_point(element, n, [&](double z, double node, double share) {
      const Eigen::VectorXd p = integrated_legendre(n, node).value;
      const double weight_dz = weight(z) * 0.5 * element.length() * share;
      sum.block(at, at, n, n) += weight_dz * p * p.transpose();
    });
  } else {
    for (int k = 0; k < n; ++k) {
      sum(at + k, at + k) = weight(element.from) * element.length() / (2 * k + 1);
    }
  }
}

// int factor I P_m P_n dz of the curvatures or twists; the first `first` rows and columns are zero.
Eigen::MatrixXd inertia_integral(const std::vector<ShaftElement>& mesh, int first, double factor) {
  const int size = first + function_count(mesh);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  int at = first;
  for (const ShaftElement& element : mesh) {
    add_integral(
        element, at, element.functions, [&](double z) { return factor * element.inertia(z); }, sum);
    at += element.all_functions();
  }
  return sum;
}

// The curvatures or twists integrated once, from the left end of the shaft to z, as a row of `size`
// functions of which those of the elements begin at `first`.
Eigen::RowVectorXd integrated_once(const std::vector<ShaftElement>& mesh, int first, int size,
                                   double z) {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size);
  int at = first;
  for (const ShaftElement& element : mesh) {
    const double h = element.length();
    if (z > element.to) {
      row[at] = h;
    } else if (z > element.from) {
      row.segment(at, element.functions) =
          0.5 * h * integrated_legendre(element.functions, local(element, z)).first.transpose();
    }
    at += element.all_functions();
  }
  return row;
}

}  // namespace

BendingBasis::BendingBasis(std::vector<ShaftElement> mesh, double first_anchor,
                           double second_anchor, int others)
    : mesh_(std::move(mesh)), first_(first_anchor), second_(second_anchor), others_(others) {
  assert(first_ < second_);
  raw_at_first_ = raw_deflection(first_);
  raw_at_second_ = raw_deflection(second_);
}

// Curvature integrated twice and shear strain integrated once, from the left end of the shaft. A
// function is 0 to the left of its element. To the right a curvature continues as a straight line
// with the slope h (n = 0) or 0; its value at the element's end is h^2/2 (n = 0), -h^2/6 (n = 1) or
// 0. A shear strain continues as a constant h (n = 0) or 0.
Eigen::RowVectorXd BendingBasis::raw_deflection(double z) const {
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(size());
  int at = 2;
  for (const ShaftElement& element : mesh_) {
    const double h = element.length();
    const int m = element.functions, s = element.shear_functions;
    if (z > element.to) {
      row[at] = h * (0.5 * h + (z - element.to));
      if (m > 1) row[at + 1] = -h * h / 6.0;
      if (s > 0) row[at + m] = h;
    } else if (z > element.from) {
      const double xi = local(element, z);
      row.segment(at, m) = 0.25 * h * h * integrated_legendre(m, xi).second.transpose();
      if (s > 0) row.segment(at + m, s) = 0.5 * h * integrated_legendre(s, xi).first.transpose();
    }
    at += element.all_functions();
  }
  return row;
}

Eigen::RowVectorXd BendingBasis::raw_tilt(double z) const {
  return integrated_once(mesh_, 2, size(), z);
}

Eigen::RowVectorXd BendingBasis::deflection(double z) const {
  const double t = (z - first_) / (second_ - first_);
  Eigen::RowVectorXd row = raw_deflection(z) - (1.0 - t) * raw_at_first_ - t * raw_at_second_;
  row[0] = 1.0 - t;
  row[1] = t;
  return row;
}

Eigen::RowVectorXd BendingBasis::tilt(double z) const {
  const double rate = 1.0 / (second_ - first_);
  Eigen::RowVectorXd row = raw_tilt(z) - rate * (raw_at_second_ - raw_at_first_);
  row[0] = -rate;
  row[1] = rate;
  return row;
}

Eigen::RowVectorXd BendingBasis::slope(double z) const {
  Eigen::RowVectorXd row = tilt(z);
  int at = 2;
  for (const ShaftElement& element : mesh_) {
    const int s = element.shear_functions;
    if (s > 0 && z > element.from && z <= element.to) {
      row.segment(at + element.functions, s) +=
          integrated_legendre(s, local(element, z)).value.transpose();
    }
    at += element.all_functions();
  }
  return row;
}

Eigen::RowVectorXd BendingBasis::other(int index) const {
  return Eigen::RowVectorXd::Unit(size(), size() - others_ + index);
}

Eigen::MatrixXd BendingBasis::curvature_integral() const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size(), size());
  const Eigen::Index n = size() - others_;
  sum.topLeftCorner(n, n) = inertia_integral(mesh_, 2, 1.0);
  return sum;
}

Eigen::MatrixXd BendingBasis::shear_integral(
    const std::function<double(const ShaftElement&, double)>& shear_area) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size(), size());
  int at = 2;
  for (const ShaftElement& element : mesh_) {
    add_integral(
        element, at + element.functions, element.shear_functions,
        [&](double z) { return shear_area(element, z); }, sum);
    at += element.all_functions();
  }
  return sum;
}

TorsionBasis::TorsionBasis(std::vector<ShaftElement> mesh)
    : mesh_(std::move(mesh)), offset_(Eigen::RowVectorXd::Zero(function_count(mesh_))) {}

Eigen::RowVectorXd TorsionBasis::angle(double z) const {
  return integrated_once(mesh_, 0, size(), z) - offset_;
}

Eigen::MatrixXd TorsionBasis::twist_integral() const { return inertia_integral(mesh_, 0, 2.0); }

}  // namespace rotorub
