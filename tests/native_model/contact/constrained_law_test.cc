// Newton's iteration on a response that is known only by evaluation, against closed forms.
#include "native_model/contact/constrained_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace rotorub::test {
namespace {

class Given final : public ContactResponse {
 public:
  explicit Given(std::function<Eigen::Vector2d(const Eigen::Vector2d&)> y) : y_(std::move(y)) {}
  ContactVector at(const ContactVector& p) override { return y_(Eigen::Vector2d(p)); }
  double accuracy() const override { return 1e-12; }

 private:
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> y_;
};

ContactMatrix matrix(double nn, double nt, double tn, double tt) {
  ContactMatrix a(2, 2);
  a << nn, nt, tn, tt;
  return a;
}

ConstrainedContact solve_frictionless(Given& response, const Eigen::Vector2d& free,
                                      const ContactMatrix& expected) {
  const ImpactLaw none;
  return solve_constrained(response, free, expected, {&none, 1});
}

// A linear response is the 2x2 problem of the law itself.
TEST(ConstrainedLaw, ALineGivesTheClosedForm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    Delassus g{0.2 + unit(random), 0.0, 0.0, 0.2 + unit(random)};
    g.nt = g.tn = 0.5 * (2.0 * unit(random) - 1.0) * std::sqrt(g.nn * g.tt);
    const ImpactLaw law{0.3 * unit(random), unit(random), 0.0};
    const Eigen::Vector2d before(-unit(random), 2.0 * unit(random) - 1.0);
    Given response([&](const Eigen::Vector2d& p) {
      return Eigen::Vector2d(before.x() + g.nn * p.x() + g.nt * p.y(),
                             before.y() + g.tn * p.x() + g.tt * p.y());
    });
    // The matrix that the solver expects differs from the true one.
    const ContactMatrix expected = matrix(2.0 * g.nn, 0.0, 0.0, 3.0 * g.tt);
    const ConstrainedContact c = solve_constrained_impact(response, before, expected, {&law, 1});
    const ImpactResult r = solve_impact(g, before.x(), before.y(), law);
    ASSERT_TRUE(c.solved && c.converged) << k;
    EXPECT_NEAR(c.p[0], r.normal(), 1e-7) << k;
    EXPECT_NEAR(c.p[1], r.friction(), 1e-7) << k;
    EXPECT_NEAR(c.y[0], r.gap_rate, 1e-7) << k;
  }
}

// A stop that takes hold at p = 1, with slope 1 before and 1e-3 behind, from -2: y(p) = 0 at
// 1 + 1 / 1e-3. The other way, what held gives way.
TEST(ConstrainedLaw, AStopAndAnAnchorThatSlipsAreFollowed) {
  struct Case {
    double before, behind, exact, tolerance;
  };
  for (const Case& c : {Case{1.0, 1e-3, 1001.0, 1e-5}, Case{1e-4, 1.0, 3.0 - 1e-4, 1e-7}}) {
    Given response([&](const Eigen::Vector2d& p) {
      const double n = c.before * std::min(p.x(), 1.0) + c.behind * std::max(p.x() - 1.0, 0.0);
      return Eigen::Vector2d(n - 2.0, 1.0 + p.y());
    });
    const ConstrainedContact found =
        solve_frictionless(response, {-2.0, 1.0}, matrix(1.0, 0.0, 0.0, 1.0));
    EXPECT_TRUE(found.solved && found.converged);
    EXPECT_NEAR(found.p[0], c.exact, c.tolerance);
  }
}

// A response that jumps over the solution: the failure is reported, and all values are finite.
TEST(ConstrainedLaw, ReportsThatThereIsNoSolution) {
  Given response([](const Eigen::Vector2d& p) {
    return Eigen::Vector2d((p.x() < 1.0 ? -1.0 : 1.0) + 0.1 * p.x(), 0.0 + p.y());
  });
  const ConstrainedContact c =
      solve_frictionless(response, {-1.0, 0.0}, matrix(0.1, 0.0, 0.0, 1.0));
  EXPECT_FALSE(c.solved && c.converged);
  EXPECT_TRUE(std::isfinite(c.p[0]) && std::isfinite(c.p[1]));
}

}  // namespace
}  // namespace rotorub::test
