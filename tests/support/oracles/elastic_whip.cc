#include "tests/support/oracles/elastic_whip.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"

namespace rotorub::oracle {
namespace {

// nu' = mu (nu - high)(nu - low), roots of the Riccati right-hand side.
struct Roots {
  double high, low;
};

Roots roots(const BackwardWhip& w) {
  const double d = w.damping;
  const double root = std::sqrt(d * d + 4.0 * w.friction * w.friction * w.mass * w.stiffness);
  return {(d + root) / (2.0 * w.friction * w.mass), (d - root) / (2.0 * w.friction * w.mass)};
}

using Complex = std::complex<double>;
using Polynomial = Eigen::VectorXd;  // coefficients of nu^0, nu^1, ...
constexpr Complex kI{0.0, 1.0};

// For a whirl at -nu, as in the whip.
Complex backward_stiffness(const Support& s, double nu) {
  return {s.stiffness - s.mass * nu * nu, -s.damping * nu};
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial c = Polynomial::Zero(a.size() + b.size() - 1);
  for (Eigen::Index i = 0; i < a.size(); ++i) c.segment(i, b.size()) += a[i] * b;
  return c;
}

// |D|^2 = (k - m nu^2)^2 + d^2 nu^2, times a.
Polynomial times_square(const Support& s, const Polynomial& a) {
  Polynomial square(5);
  square << s.stiffness * s.stiffness, 0.0, s.damping * s.damping - 2.0 * s.mass * s.stiffness, 0.0,
      s.mass * s.mass;
  return product(square, a);
}

// Im D* + mu Re D*, D* = k - m nu^2 + i d nu.
Polynomial demand(const Support& s, double mu) {
  return Eigen::Vector3d(mu * s.stiffness, s.damping, -mu * s.mass);
}

// By falling real part; of a pair the eigenvalue with Im < 0 first.
std::vector<Complex> eigenvalues_of(const Eigen::MatrixXd& a) {
  const auto values = real_eigenvalues(a);
  if (!values)
    throw std::invalid_argument("ElasticWhip: its numbers lie too many orders of magnitude apart");
  return *values;
}

// Positive real roots, ascending, by the companion matrix in nu / scale.
std::vector<double> positive_roots(Polynomial p, double scale) {
  for (Eigen::Index i = 0; i < p.size(); ++i) p[i] *= std::pow(scale, i);
  const Eigen::Index n = p.size() - 1;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  companion.col(n - 1) = -p.head(n) / p[n];
  std::vector<double> roots;
  for (const Complex& x : eigenvalues_of(companion)) {
    constexpr double kReal = 1e-7;  // round-off separates a double root by its square root
    if (x.real() > 0.0 && std::abs(x.imag()) < kReal * std::abs(x)) {
      roots.push_back(scale * x.real());
    }
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

}  // namespace

double BackwardWhip::natural_frequency() const { return std::sqrt(stiffness / mass); }
double BackwardWhip::growth_threshold() const { return roots(*this).high; }

double BackwardWhip::whirl_speed(double start, double t) const {
  // (nu - high) / (nu - low) = C e^{mu (high - low) t}.
  const auto [high, low] = roots(*this);
  const double c = (start - high) / (start - low) * std::exp(friction * (high - low) * t);
  return (high - low * c) / (1.0 - c);
}

double BackwardWhip::blow_up(double start) const {
  const auto [high, low] = roots(*this);
  if (start <= high) return std::numeric_limits<double>::infinity();
  return std::log((start - low) / (start - high)) / (friction * (high - low));
}

double BackwardWhip::normal_force(double nu) const {
  const double w = natural_frequency();
  return mass * clearance * (nu * nu - w * w);
}

Complex ElasticWhip::compliance(double nu) const {
  return 1.0 / backward_stiffness(rotor, nu) + 1.0 / backward_stiffness(ring, nu);
}

double ElasticWhip::normal_force(double nu) const {
  const Complex h = compliance(nu);
  return -clearance * h.real() / std::norm(h);
}

double ElasticWhip::friction_asked(double nu) const {
  const Complex h = compliance(nu);
  return h.real() < 0.0 ? h.imag() / -h.real() : std::numeric_limits<double>::infinity();
}

bool ElasticWhip::rolls(double nu, double mu) const { return friction_asked(nu) <= mu; }

CircularWhirl ElasticWhip::whirl(double nu) const {
  const Complex force = -clearance / compliance(nu);
  CircularWhirl w;
  w.rotor = -force / backward_stiffness(rotor, nu);
  w.stator = force / backward_stiffness(ring, nu);
  w.rotor_velocity = -kI * nu * w.rotor;
  w.stator_velocity = -kI * nu * w.stator;
  w.force = force.real();
  w.friction = force.imag() / force.real();
  return w;
}

// Multiplied by |D_r|^2 |D_s|^2, Im H + mu Re H = 0 is a polynomial of degree 6. Since Im H > 0,
// its roots satisfy Re H < 0.
std::vector<double> ElasticWhip::slipping_whips(double mu) const {
  const Polynomial p =
      times_square(ring, demand(rotor, mu)) + times_square(rotor, demand(ring, mu));
  const double scale = std::sqrt((rotor.stiffness + ring.stiffness) / (rotor.mass + ring.mass));
  std::vector<double> roots = positive_roots(p, scale);
  // Improves the accuracy of the eigenvalues by Newton's method on the polynomial.
  for (double& nu : roots) {
    for (int k = 0; k < 3; ++k) {
      double value = 0.0, slope = 0.0;
      for (Eigen::Index i = p.size() - 1; i >= 0; --i) {
        slope = slope * nu + value;
        value = value * nu + p[i];
      }
      if (slope != 0.0) nu -= value / slope;
    }
  }
  return roots;
}

// tau - mu changes its sign at the roots. For nu -> 0 both bodies act as springs and there is no
// contact force; for nu -> infinity both act as masses and tau goes to 0.
std::vector<WhirlInterval> ElasticWhip::rolling_intervals(double mu) const {
  std::vector<double> edges = slipping_whips(mu);
  edges.push_back(std::numeric_limits<double>::infinity());
  std::vector<WhirlInterval> out;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double inside =
        std::isfinite(edges[i + 1]) ? 0.5 * (edges[i] + edges[i + 1]) : 2.0 * edges[i];
    if (rolls(inside, mu)) out.push_back({edges[i], edges[i + 1]});
  }
  return out;
}

// In the frame of e^{i psi}: z_s = w e^{i psi}, z_r = (w + delta_0) e^{i psi}, psi' = -nu. With
// w -> w + a, nu -> nu + n, lambda -> lambda + l, and R = w + delta_0:
//
//   m (a'' - 2 i nu a' - i n' R - 2 nu n R) + d (a' - i n R) + D_r a + l (1 + i mu) = 0
//   M (a'' - 2 i nu a' - i n' w - 2 nu n w) + D (a' - i n w) + D_s a - l (1 + i mu) = 0
//
// four real equations for (Re a'', Im a'', n', l) from the state (Re a, Im a, Re a', Im a', n).
std::vector<Complex> ElasticWhip::eigenvalues(double nu) const {
  const CircularWhirl now = whirl(nu);
  const Complex push{1.0, now.friction};
  const auto set = [](auto&& matrix, int row, int column, const Complex& value) {
    matrix(row, column) = value.real();
    matrix(row + 1, column) = value.imag();
  };
  Eigen::Matrix4d unknown;
  Eigen::Matrix<double, 4, 5> known;
  const auto body = [&](int row, const Support& s, const Complex& place, double sign) {
    const Complex d = backward_stiffness(s, nu), rate = s.damping - 2.0 * s.mass * kI * nu;
    const Complex mass = s.mass;
    set(unknown, row, 0, mass);
    set(unknown, row, 1, kI * mass);
    set(unknown, row, 2, -kI * mass * place);
    set(unknown, row, 3, sign * push);
    set(known, row, 0, d);
    set(known, row, 1, kI * d);
    set(known, row, 2, rate);
    set(known, row, 3, kI * rate);
    set(known, row, 4, -(2.0 * nu * mass + kI * s.damping) * place);
  };
  body(0, rotor, now.rotor, 1.0);
  body(2, ring, now.stator, -1.0);
  // Scales forces and accelerations, so that all numbers of the solve have similar magnitudes.
  const double force = rotor.mass * nu * nu;
  unknown.col(3) *= force;
  const Eigen::Matrix<double, 4, 5> rates =
      -lu_solve(Eigen::MatrixXd(unknown), Eigen::MatrixXd(known));
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(5, 5);
  jacobian(0, 2) = jacobian(1, 3) = 1.0;
  jacobian.bottomRows(3) = rates.topRows<3>();
  return eigenvalues_of(jacobian);
}

}  // namespace rotorub::oracle
