#include "native_model/numerics/eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace rotorub {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Values = std::vector<std::complex<double>>;

template <class Solver, class Matrix>
std::optional<Values> sorted_values(const Matrix& A) {
  if (A.rows() == 0) return Values();
  if (!A.allFinite()) return {};
  const Solver solver(A, false);
  if (solver.info() != Eigen::Success) return {};
  Values values(solver.eigenvalues().begin(), solver.eigenvalues().end());
  sort_by_growth(values);
  return values;
}

template <class Solver, class Matrix>
std::optional<EigenModes> modes_of(const Matrix& A) {
  if (!A.allFinite()) return {};
  const Solver solver(A);
  if (solver.info() != Eigen::Success) return {};
  return EigenModes{solver.eigenvalues(), solver.eigenvectors()};
}

template <class Solver>
std::optional<VectorXd> symmetric_values(const Solver& solver) {
  if (solver.info() != Eigen::Success || !solver.eigenvalues().allFinite()) return {};
  return solver.eigenvalues();
}

template <class Solver>
std::optional<SymmetricModes> modes_of_symmetric(const Solver& solver) {
  const std::optional<VectorXd> found = symmetric_values(solver);
  if (!found) return {};
  return SymmetricModes{*found, solver.eigenvectors()};
}

using Eigen::Index;

std::optional<EigenModes> all_modes(const Eigen::MatrixXd& A) { return real_modes(A); }
std::optional<EigenModes> all_modes(const Eigen::MatrixXcd& A) { return complex_modes(A); }

// (A - sigma)^-1 applied to states (W q, q'), with one factorisation:
//   (C + sigma B + sigma^2) q = -b - (B + sigma) W^-1 a,   q' = W^-1 a + sigma q.
template <class Matrix>
class ShiftedInverse {
 public:
  using Vector = Eigen::Matrix<typename Matrix::Scalar, Eigen::Dynamic, 1>;

  ShiftedInverse(const Matrix& B, const Matrix& C, const Eigen::VectorXd& W, double shift)
      : rates_(B), W_(W.cast<typename Matrix::Scalar>()), shift_(shift) {
    rates_.diagonal().array() += shift;
    solver_.compute(C + shift * rates_);
  }
  Vector operator()(const Vector& z) const {
    const Index n = W_.size();
    const Vector rate = z.head(n).cwiseQuotient(W_);
    const Vector q = -solver_.solve(z.tail(n) + rates_ * rate);
    Vector y(2 * n);
    y << W_.cwiseProduct(q), rate + shift_ * q;
    return y;
  }

 private:
  Matrix rates_;
  Vector W_;
  double shift_;
  Eigen::PartialPivLU<Matrix> solver_;
};

// Arnoldi iteration: orthonormal V with (A - sigma)^-1 V_m = V_M H, M >= m, where V_m are the first
// m columns.
template <class Matrix>
class Arnoldi {
 public:
  using Vector = typename ShiftedInverse<Matrix>::Vector;

  Arnoldi(ShiftedInverse<Matrix> inverse, Index size, Index most)
      : inverse_(std::move(inverse)),
        V_(size, most + kStarts),
        H_(Matrix::Zero(most + kStarts, most)) {
    // Real equations get one start vector in each half of the coordinates. If the two planes are
    // uncoupled, each then has its own start, and an eigenvalue of both is found twice. No start is
    // orthogonal to a mode by symmetry.
    const Index all = size / 2, part = all / kStarts;
    for (Index start = 0; start < kStarts; ++start) {
      Vector z = Vector::Zero(size);
      for (Index k = 0; k < part; ++k) {
        const Index at = start * part + k;
        z[at] = z[all + at] = 1.0 + 0.7 * static_cast<double>(k) / static_cast<double>(part);
      }
      add(std::move(z), nullptr);
    }
  }

  // Extends H to m columns; false if no new direction is left.
  bool extend(Index m) {
    for (; done_ < m; ++done_) {
      if (done_ == columns_) return false;
      add(inverse_(V_.col(done_)), &H_);
    }
    return true;
  }
  Index done() const { return done_; }
  Matrix square() const { return H_.topLeftCorner(done_, done_); }
  Matrix rest() const { return H_.block(done_, 0, columns_ - done_, done_); }
  auto basis() const { return V_.leftCols(done_); }

 private:
  static constexpr Index kStarts = Eigen::NumTraits<typename Matrix::Scalar>::IsComplex ? 1 : 2;

  // Appends the part of z that is orthogonal to the present columns.
  void add(Vector z, Matrix* products) {
    constexpr double kNothing = 1e-13;  // relative round-off of the projection
    constexpr int kPasses = 2;          // the second removes the round-off of the first
    const double size = z.norm();
    for (int pass = 0; pass < kPasses; ++pass) {
      const Vector share = V_.leftCols(columns_).adjoint() * z;
      z.noalias() -= V_.leftCols(columns_) * share;
      if (products) products->col(done_).head(columns_) += share;
    }
    const double left = z.norm();
    if (!(left > kNothing * size)) return;
    if (products) (*products)(columns_, done_) = left;
    V_.col(columns_++) = z / left;
  }

  ShiftedInverse<Matrix> inverse_;
  Matrix V_, H_;
  Index columns_ = 0, done_ = 0;
};

// The converged eigenvalues, from the nearest to the shift up to the first one that has not
// converged, minus a margin for eigenvalues that appear late.
template <class Matrix>
std::optional<LowestModes> found(const Arnoldi<Matrix>& arnoldi, double shift) {
  constexpr double kAccuracy = 1e-11;
  constexpr std::size_t kMargin = 4;
  const std::optional<EigenModes> modes = all_modes(arnoldi.square());
  if (!modes) return {};
  const Eigen::VectorXcd& theta = modes->values;
  const Eigen::VectorXd missing =
      (arnoldi.rest().template cast<std::complex<double>>() * modes->vectors).colwise().norm();
  std::vector<Index> order(static_cast<std::size_t>(theta.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(theta[a]) > std::abs(theta[b]); });
  const auto bad = std::find_if(order.begin(), order.end(), [&](Index k) {
    return !(missing[k] <= kAccuracy * std::abs(theta[k]));
  });
  const auto known = static_cast<std::size_t>(bad - order.begin());
  order.resize(known - std::min(known, kMargin));

  // All eigenvalues up to the last one's distance from the shift are known, and so are all within
  // this radius of 0.
  LowestModes lowest;
  if (order.empty()) return lowest;
  const double radius = 1.0 / std::abs(theta[order.back()]) - shift;
  const auto value = [&](Index k) { return shift + 1.0 / theta[k]; };
  std::erase_if(order, [&](Index k) { return std::abs(value(k)) > radius; });
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return std::abs(value(a)) < std::abs(value(b)); });
  const auto count = static_cast<Index>(order.size());
  const Index half = arnoldi.basis().rows() / 2;
  lowest.values.resize(count);
  Eigen::MatrixXcd y(arnoldi.done(), count);
  for (Index j = 0; j < count; ++j) {
    const Index k = order[static_cast<std::size_t>(j)];
    lowest.values[j] = value(k);
    y.col(j) = modes->vectors.col(k);
  }
  lowest.rates = arnoldi.basis().bottomRows(half).template cast<std::complex<double>>() * y;
  return lowest;
}

template <class Matrix>
std::optional<LowestModes> search(const Matrix& B, const Matrix& C, const Eigen::VectorXd& W,
                                  double shift, Index guess, const Enough& enough) {
  const Index size = 2 * W.size(), most = size / 2, first = 2 * guess + 12;
  if (first > most || !B.allFinite() || !C.allFinite()) return {};
  Arnoldi<Matrix> arnoldi(ShiftedInverse<Matrix>(B, C, W, shift), size, most);
  for (Index m = first; m <= most; m += m / 4) {
    if (!arnoldi.extend(m) || !arnoldi.square().allFinite()) return {};
    std::optional<LowestModes> lowest = found(arnoldi, shift);
    if (!lowest) return {};
    if (enough(lowest->values)) return lowest;
  }
  return {};
}

}  // namespace

void sort_by_growth(Values& values) {
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() < b.imag();
  });
}

double largest_size(const Values& values) {
  double size = 0.0;
  for (const std::complex<double>& s : values) size = std::max(size, std::abs(s));
  return size;
}
double smallest_size(const Values& values) {
  double size = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& s : values) {
    if (std::abs(s) > 0.0) size = std::min(size, std::abs(s));
  }
  return size;
}

std::optional<Values> real_eigenvalues(const MatrixXd& A) {
  return sorted_values<Eigen::EigenSolver<MatrixXd>>(A);
}
std::optional<Values> complex_eigenvalues(const MatrixXcd& A) {
  return sorted_values<Eigen::ComplexEigenSolver<MatrixXcd>>(A);
}

std::optional<EigenModes> real_modes(const MatrixXd& A) {
  return modes_of<Eigen::EigenSolver<MatrixXd>>(A);
}
std::optional<EigenModes> complex_modes(const MatrixXcd& A) {
  return modes_of<Eigen::ComplexEigenSolver<MatrixXcd>>(A);
}

std::optional<SymmetricModes> symmetric_modes(const MatrixXd& A) {
  return modes_of_symmetric(Eigen::SelfAdjointEigenSolver<MatrixXd>(A));
}
std::optional<VectorXd> symmetric_eigenvalues(const MatrixXd& A) {
  return symmetric_values(Eigen::SelfAdjointEigenSolver<MatrixXd>(A, Eigen::EigenvaluesOnly));
}

std::optional<SymmetricModes> symmetric_modes(const MatrixXd& A, const MatrixXd& B) {
  return modes_of_symmetric(Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B));
}
std::optional<VectorXd> symmetric_eigenvalues(const MatrixXd& A, const MatrixXd& B) {
  return symmetric_values(
      Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B, Eigen::EigenvaluesOnly));
}

std::optional<LowestModes> lowest_modes(const Eigen::MatrixXd& B, const Eigen::MatrixXd& C,
                                        const Eigen::VectorXd& W, double shift, Index guess,
                                        const Enough& enough) {
  return search(B, C, W, shift, guess, enough);
}

std::optional<LowestModes> lowest_modes(const Eigen::MatrixXcd& B, const Eigen::MatrixXcd& C,
                                        const Eigen::VectorXd& W, double shift, Index guess,
                                        const Enough& enough) {
  return search(B, C, W, shift, guess, enough);
}

}  // namespace rotorub
