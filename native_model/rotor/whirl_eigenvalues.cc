#include "native_model/rotor/whirl_eigenvalues.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>

#include "native_model/numerics/complex_eigenvalues.h"
#include "native_model/numerics/lowest_modes.h"
#include "native_model/numerics/real_eigenvalues.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Velocities and W q as state, W about the frequencies: all entries are then of the size of a
// frequency, whatever the mode. A coordinate without a stiffness is left as it is.
Eigen::VectorXd state_scale(const Eigen::MatrixXd& stiffness) {
  return stiffness.diagonal().unaryExpr([](double k) { return k > 0.0 ? std::sqrt(k) : 1.0; });
}

// v' = -C W^-1 (W q) - B v,  (W q)' = W v
template <typename Matrix>
Matrix state_matrix(const Matrix& B, const Matrix& C, const Eigen::VectorXd& W) {
  const Eigen::Index n = W.size();
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).diagonal() = W.template cast<typename Matrix::Scalar>();
  A.bottomLeftCorner(n, n) =
      -C * W.cwiseInverse().template cast<typename Matrix::Scalar>().asDiagonal();
  A.bottomRightCorner(n, n) = -B;
  return A;
}

[[noreturn]] void fail() { throw RotorNotSolvable("no eigenvalues can be found"); }

// Sense of the orbit x = Re(x^ e^{st}), y = Re(y^ e^{st}), Im s > 0: the sign of its angular
// momentum, sum Im(x^ conj(y^)) in coordinates of unit mass; planar to round-off: forward.
bool forward(const Eigen::VectorXcd& x, const Eigen::VectorXcd& y) {
  constexpr double kPlanar = 1e-10;
  const double momentum = (x.array() * y.array().conjugate()).imag().sum();
  return momentum > -kPlanar * (x.squaredNorm() + y.squaredNorm());
}

void sort_by_frequency(std::vector<Complex>& s) {
  std::sort(s.begin(), s.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a.imag()) < std::abs(b.imag());
  });
  // Whirl at rest comes in pairs that differ by round-off alone: backward first, as it is at speed.
  constexpr double kEqual = 1e-9;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    const double difference = std::abs(s[i + 1].imag()) - std::abs(s[i].imag());
    const bool equal = difference <= kEqual * std::abs(s[i].imag());
    if (equal && s[i].imag() > 0.0 && s[i + 1].imag() < 0.0) std::swap(s[i], s[i + 1]);
  }
}

// Well below the lowest mode, and off a rigid one.
double shift_of(const Eigen::VectorXd& W) { return 0.05 * W.minCoeff(); }

// The lowest by |s|, which overdamping does not make small. Isotropic planes: as many of each
// sense, since the spin lowers backward whirl and lifts the other.
std::vector<Complex> lowest(std::vector<Complex> s, const WhirlSystem& system) {
  constexpr double kReal = 1e-9;  // |Im s| / |s| of an overdamped mode, which has no sense
  const std::size_t kept = static_cast<std::size_t>(system.kept);
  std::stable_sort(s.begin(), s.end(),
                   [](const Complex& a, const Complex& b) { return std::abs(a) < std::abs(b); });
  if (!system.isotropic) {
    s.resize(std::min(s.size(), 2 * kept));
    return s;
  }
  std::vector<Complex> chosen;
  std::size_t forward_count = 0, backward_count = 0;
  for (const Complex& value : s) {
    const bool real = std::abs(value.imag()) <= kReal * std::abs(value);
    const bool is_forward = real ? forward_count <= backward_count : value.imag() > 0.0;
    std::size_t& count = is_forward ? forward_count : backward_count;
    if (count == kept) continue;
    ++count;
    chosen.push_back(value);
  }
  return chosen;
}

// Each eigenvalue is one whirl.
std::vector<Complex> isotropic_eigenvalues(const WhirlSystem& system, double speed) {
  const auto [B, C] = isotropic_matrices(system, speed);
  const Eigen::VectorXd W = state_scale(system.stiffness_x);
  const auto kept = [&](const Eigen::VectorXcd& values) {
    return lowest({values.begin(), values.end()}, system);
  };
  const std::size_t wanted = 2 * static_cast<std::size_t>(system.kept);
  const auto enough = [&](const Eigen::VectorXcd& values) { return kept(values).size() == wanted; };
  if (const auto part = lowest_modes(B, C, W, shift_of(W), 2 * system.kept, enough)) return kept(part->values);
  auto values = complex_eigenvalues(state_matrix(B, C, W));
  if (!values) fail();
  return lowest(*std::move(values), system);
}

// Both planes as real equations. Of each complex pair one eigenvalue stands for the whirl, and of
// the real ones, which also come in twos, every other. rates: q' of each.
std::vector<Complex> whirls_of(const Eigen::VectorXcd& values, const Eigen::MatrixXcd& rates) {
  const Eigen::Index n = rates.rows() / 2;
  std::vector<Complex> whirls;
  std::vector<double> real;
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const Complex s = values[j];
    if (s.imag() == 0.0) real.push_back(s.real());
    if (!(s.imag() > 0.0)) continue;
    const bool sense = forward(rates.col(j).head(n), rates.col(j).tail(n));
    whirls.push_back(sense ? s : std::conj(s));
  }
  std::sort(real.begin(), real.end(), std::greater<>());
  for (std::size_t i = 0; i < real.size(); i += 2) whirls.emplace_back(real[i], 0.0);
  return whirls;
}

std::vector<Complex> anisotropic_eigenvalues(const WhirlSystem& system, double speed) {
  const auto [B, C] = planes_matrices(system, speed);
  Eigen::VectorXd W(2 * system.size());
  W << state_scale(system.stiffness_x), state_scale(system.stiffness_y);
  const auto enough = [&](const Eigen::VectorXcd& values) {
    const auto real = (values.imag().array() == 0.0).count();
    return (values.imag().array() > 0.0).count() + real / 2 >= 2 * system.kept;
  };
  if (const auto part = lowest_modes(B, C, W, shift_of(W), 4 * system.kept, enough)) {
    return lowest(whirls_of(part->values, part->rates), system);
  }
  const std::optional<EigenModes> modes = real_modes(state_matrix(B, C, W));
  if (!modes) fail();
  return lowest(whirls_of(modes->values, modes->vectors.bottomRows(W.size())), system);
}

}  // namespace

std::vector<Complex> whirl_eigenvalues(const WhirlSystem& system, double speed) {
  std::vector<Complex> s =
      system.isotropic ? isotropic_eigenvalues(system, speed) : anisotropic_eigenvalues(system, speed);
  sort_by_frequency(s);
  return s;
}

}  // namespace rotorub
