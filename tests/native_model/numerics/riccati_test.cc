// The Riccati equation against closed forms, its own residual, and the poles that it places.
#include "native_model/numerics/matrix_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "native_model/numerics/eigenvalues.h"

namespace rotorub {
namespace {

using Eigen::MatrixXd;

MatrixXd random(int rows, int columns, std::mt19937& engine) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(engine); });
}

// The equation in another form than the solver's, without the inverse of P + ...
double residual(const MatrixXd& a, const MatrixXd& b, const MatrixXd& q, const MatrixXd& r,
                const MatrixXd& p) {
  const MatrixXd k = riccati_gain(a, b, r, p), closed = a - b * k;
  return (closed.transpose() * p * closed + k.transpose() * r * k + q - p).norm() / p.norm();
}

TEST(Riccati, ScalarClosedForm) {
  for (const double a : {0.5, 1.0, 1.7}) {
    const double b = 0.3, q = 2.0, r = 0.7;
    // b^2 p^2 + (r (1 - a^2) - q b^2) p - q r = 0
    const double linear = r * (1.0 - a * a) - q * b * b;
    const double wanted =
        (-linear + std::sqrt(linear * linear + 4.0 * b * b * q * r)) / (2.0 * b * b);
    const auto one = [](double x) { return MatrixXd::Constant(1, 1, x); };
    const auto p = solve_riccati(one(a), one(b), one(q), one(r));
    ASSERT_TRUE(p);
    EXPECT_NEAR((*p)(0, 0), wanted, 1e-13 * wanted) << a;
  }
}

TEST(Riccati, RandomSystemsHaveNoResidualAndDecay) {
  std::mt19937 engine(5);
  for (int n = 1; n <= 12; ++n) {
    const MatrixXd a = 1.3 * random(n, n, engine) / std::sqrt(n), b = random(n, 2, engine);
    const MatrixXd c = random(3, n, engine), q = c.transpose() * c;
    const MatrixXd s = random(2, 2, engine), r = s * s.transpose() + 0.1 * MatrixXd::Identity(2, 2);
    const auto p = solve_riccati(a, b, q, r);
    ASSERT_TRUE(p) << n;
    EXPECT_LT(residual(a, b, q, r, *p), 1e-10) << n;
    EXPECT_LT((*p - p->transpose()).norm(), 1e-14 * p->norm());
    const auto values = real_eigenvalues(a - b * riccati_gain(a, b, r, *p));
    ASSERT_TRUE(values);
    for (const auto& value : *values) EXPECT_LT(std::abs(value), 1.0) << n;
  }
}

TEST(Riccati, AnUnreachableModeThatGrowsHasNoSolution) {
  MatrixXd a = MatrixXd::Identity(2, 2), b(2, 1);
  a(1, 1) = 1.1;
  b << 1.0, 0.0;
  EXPECT_FALSE(solve_riccati(a, b, MatrixXd::Identity(2, 2), MatrixXd::Identity(1, 1)));
}

}  // namespace
}  // namespace rotorub
