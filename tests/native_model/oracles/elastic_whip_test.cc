// The whip's closed form against Runge-Kutta, first on its own equation, then on the polar
// equations of the rotor that it comes from.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "native_model/dynamics/dynamics.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/system/model.h"
#include "tests/support/jeffcott.h"
#include "tests/support/oracles/elastic_whip.h"
#include "tests/support/runge_kutta.h"

namespace rotorub::oracle {
namespace {

constexpr BackwardWhip kWhip{2.0, 40.0, 2e5, 0.3, 0.5e-3};

double integrated(const BackwardWhip& w, double start, double t) {
  const auto rate = [&](double, const Eigen::VectorXd& y) {
    const double nu = y[0];
    Eigen::VectorXd dy(1);
    dy[0] = w.friction * nu * nu - w.damping / w.mass * nu - w.friction * w.stiffness / w.mass;
    return dy;
  };
  return test::runge_kutta(rate, 0.0, t, 20000, Eigen::VectorXd::Constant(1, start))[0];
}

TEST(BackwardWhip, AgreesWithRungeKutta) {
  for (const double start : {100.0, 316.0, 340.0, 360.0, 500.0, 900.0}) {
    const double limit = std::min(0.03, 0.9 * kWhip.blow_up(start));
    for (const double part : {0.1, 0.5, 1.0}) {
      const double t = part * limit, exact = integrated(kWhip, start, t);
      EXPECT_NEAR(kWhip.whirl_speed(start, t), exact, 1e-10 * std::abs(exact)) << start << " " << t;
    }
  }
}

TEST(BackwardWhip, IsTheRotorSlidingRoundTheRing) {
  // Cartesian: m z'' + d z' + k z = N n + T e_t on |z| = delta_0, with N from the constraint and
  // T = -mu N for slip > 0. The orbit's speed after 10 ms is the closed form's.
  const BackwardWhip& w = kWhip;
  const double nu = 500.0;
  const auto rate = [&](double, const Eigen::VectorXd& y) {
    const Eigen::Vector2d z = y.head(2), v = y.tail(2), e = z.normalized(), t{-e.y(), e.x()};
    const Eigen::Vector2d own = -w.damping * v - w.stiffness * z;
    // e . z'' = -v_t^2 / |z| keeps the circle.
    const double whirl = t.dot(v);
    const double normal = own.dot(e) + w.mass * whirl * whirl / z.norm();
    Eigen::VectorXd dy(4);
    dy << v, (own - normal * e - w.friction * normal * t) / w.mass;
    return dy;
  };
  Eigen::VectorXd y(4);
  y << w.clearance, 0.0, 0.0, -nu * w.clearance;
  const double end = 2e-3;
  y = test::runge_kutta(rate, 0.0, end, 20000, y);
  const Eigen::Vector2d z = y.head(2), v = y.tail(2);
  EXPECT_NEAR(z.norm(), w.clearance, 1e-9 * w.clearance);
  const double speed = -(z.x() * v.y() - z.y() * v.x()) / z.squaredNorm();
  EXPECT_NEAR(w.whirl_speed(nu, end), speed, 1e-8 * speed);
  EXPECT_GT(speed, 1.15 * nu) << "the whip grows";
}

TEST(BackwardWhip, GrowsAboveItsThresholdAndDiesBelow) {
  const double threshold = kWhip.growth_threshold();
  EXPECT_GT(threshold, kWhip.natural_frequency());
  EXPECT_GT(integrated(kWhip, 1.001 * threshold, 1e-3), 1.001 * threshold);
  EXPECT_LT(integrated(kWhip, 0.999 * threshold, 1e-3), 0.999 * threshold);
  EXPECT_NEAR(kWhip.whirl_speed(threshold, 0.5), threshold, 1e-9 * threshold) << "stands still";
  EXPECT_TRUE(std::isinf(kWhip.blow_up(0.999 * threshold)));
  const double start = 1.5 * threshold, end = kWhip.blow_up(start);
  EXPECT_GT(kWhip.whirl_speed(start, end * (1.0 - 1e-6)), 1e3 * start);
}

TEST(BackwardWhip, WithoutDampingTheThresholdIsTheNaturalFrequency) {
  const BackwardWhip w{2.0, 0.0, 2e5, 0.3, 0.5e-3};
  EXPECT_DOUBLE_EQ(w.growth_threshold(), w.natural_frequency());
}

TEST(BackwardWhip, PressesFromTheNaturalFrequencyOn) {
  const double w = kWhip.natural_frequency();
  EXPECT_NEAR(kWhip.normal_force(w), 0.0, 1e-9);
  EXPECT_GT(kWhip.normal_force(1.01 * w), 0.0);
  EXPECT_LT(kWhip.normal_force(0.99 * w), 0.0) << "would have to pull: no contact";
  EXPECT_DOUBLE_EQ(kWhip.normal_force(2.0 * w), 3.0 * 2e5 * 0.5e-3);
}

// The whip on an elastic ring: published figures, and the motion put back into the model's own
// right-hand side, which shares nothing with the closed form.

using Complex = std::complex<double>;

// The shipped scene, and the same on the softer ring of `bench_ring`.
constexpr ElasticWhip kStiff{{2.0, 40.0, 2e5}, {1.0, 200.0, 1e6}, 0.5e-3};
constexpr ElasticWhip kSoft{{2.0, 40.0, 2e5}, {1.0, 200.0, 1e5}, 0.5e-3};
constexpr double kDigits = 5e-4;  // figures known to three decimals

TEST(ElasticWhip, RollsWhereItIsKnownTo) {
  const std::vector<WhirlInterval> rolling = kStiff.rolling_intervals(0.2);
  ASSERT_EQ(rolling.size(), 2U);
  EXPECT_NEAR(rolling[0].from, 380.947, kDigits);
  EXPECT_NEAR(rolling[0].to, 501.926, kDigits);
  EXPECT_NEAR(rolling[1].from, 1465.431, kDigits);
  EXPECT_TRUE(std::isinf(rolling[1].to));
  EXPECT_TRUE(kStiff.rolls(450.0, 0.2));
  EXPECT_FALSE(kStiff.rolls(380.9, 0.2));
  EXPECT_FALSE(kStiff.rolls(502.0, 0.2));
  EXPECT_FALSE(kStiff.rolls(100.0, 1e9)) << "slower than both springs: nothing presses";
  const std::vector<WhirlInterval> soft = kSoft.rolling_intervals(0.15);
  ASSERT_EQ(soft.size(), 1U);
  EXPECT_NEAR(soft[0].from, 1019.199, kDigits);
}

TEST(ElasticWhip, SlipsAtTheEdgeOfRolling) {
  const std::vector<double> whips = kStiff.slipping_whips(0.2);
  ASSERT_EQ(whips.size(), 3U);
  EXPECT_NEAR(whips[1], 501.9257, 5e-5);
  EXPECT_NEAR(kStiff.normal_force(whips[1]), 244.8444, 5e-5);
  for (const double nu : whips) EXPECT_NEAR(kStiff.friction_asked(nu), 0.2, 1e-12) << nu;
}

// A scan of tau - mu finds as many edges as the polynomial, for any rotor and ring.
TEST(ElasticWhip, FindsEveryEdgeThatAScanFinds) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 100; ++k) {
    const ElasticWhip w{{0.5 + unit(random), 100.0 * unit(random), 3e5 * unit(random)},
                        {0.5 + unit(random), 400.0 * unit(random), 1e6 * unit(random)},
                        0.5e-3};
    const double mu = 0.05 + 0.5 * unit(random);
    const std::vector<double> edges = w.slipping_whips(mu);
    ASSERT_FALSE(edges.empty()) << "at high speed every whirl rolls";
    const double most = 2.0 * edges.back();
    constexpr int kPoints = 20000;
    std::size_t changes = 0;
    bool last = false;
    for (int i = 1; i <= kPoints; ++i) {
      const bool now = w.rolls(most * i / kPoints, mu);
      if (now != last) ++changes;
      last = now;
    }
    EXPECT_EQ(changes, edges.size()) << k;
  }
}

// ---------------------------------------------------------------- against the model

scene::Scene scene_of(const ElasticWhip& w, double mu) {
  scene::Scene s = test::make_scene({.mass = w.rotor.mass,
                                     .damping = w.rotor.damping,
                                     .stiffness = w.rotor.stiffness,
                                     .clearance = w.clearance,
                                     .friction = mu,
                                     .speed = 100.0 * std::numbers::pi});
  test::add_ring(s, w.ring.mass, w.ring.damping, w.ring.stiffness);
  return s;
}

// x, y of rotor and ring.
Eigen::Vector4d plane(const Complex& rotor, const Complex& stator) {
  return {rotor.real(), rotor.imag(), stator.real(), stator.imag()};
}

TEST(ElasticWhip, MovesAsTheModelSays) {
  const Model model = make_model(scene_of(kStiff, 0.2));
  for (const double nu : {385.0, 450.0, 501.9257, 1500.0, 31415.9}) {
    const CircularWhirl w = kStiff.whirl(nu);
    const Eigen::Vector4d q = plane(w.rotor, w.stator);
    const Eigen::Vector4d v = plane(w.rotor_velocity, w.stator_velocity);
    const ContactPoint p = contact_point(model, q.data(), v.data());
    EXPECT_NEAR(p.gap, 0.0, 1e-12 * q.norm()) << nu;
    EXPECT_NEAR(p.gap_rate, 0.0, 1e-12 * v.norm()) << nu;
    EXPECT_NEAR(p.whirl_speed(), -nu * kStiff.clearance, 1e-11 * v.norm()) << nu;
    // M q'' = f(q, v) + J^T (contact), q'' = -nu^2 q; a slip > 0 drags along -e_t.
    EXPECT_GT(w.force, 0.0);
    EXPECT_DOUBLE_EQ(w.friction, kStiff.friction_asked(nu));
    Eigen::VectorXd f(4);
    unactuated_force(model, 0.0, q.data(), v.data(), f.data());
    add_contact_load(
        model, contact_load(p.e_r, model.first().contact->radius, w.force, -w.friction * w.force),
        f.data());
    const Eigen::VectorXd inertia = -nu * nu * model.mass.cwiseProduct(q);
    EXPECT_LT((inertia - f).norm(), 1e-11 * inertia.norm()) << nu;
  }
}

// The motion with contact kept and slip > 0, in Cartesian coordinates with the model's right-hand
// side: lambda keeps the relative acceleration on the circle. Nothing is linearised.
Eigen::VectorXd kept_in_contact(const Model& m, const Eigen::VectorXd& y) {
  const double mu = m.first().contact->friction.coefficient;
  const Eigen::Vector4d q = y.head(4), v = y.tail(4);
  const ContactPoint p = contact_point(m, q.data(), v.data());
  Eigen::Vector4d free, push = Eigen::Vector4d::Zero();
  unactuated_force(m, 0.0, q.data(), v.data(), free.data());
  add_contact_load(m, contact_load(p.e_r, m.first().contact->radius, 1.0, -mu), push.data());
  const Eigen::Vector4d weight = m.mass.cwiseInverse();
  const auto radial = [&](const Eigen::Vector4d& f) {
    const Eigen::Vector4d a = weight.cwiseProduct(f);
    return p.e_r.dot(a.head<2>() - a.tail<2>());
  };
  const double whirl = p.whirl_speed();
  const double force = -(radial(free) + whirl * whirl / p.delta) / radial(push);
  Eigen::VectorXd dy(8);
  dy << v, weight.cwiseProduct(free + force * push);
  return dy;
}

// The upper edge of slow rolling: friction drives every slower whirl up to it.
double upper_whip(double mu) { return kStiff.slipping_whips(mu).at(1); }

// Each eigenvalue of the closed form is one of the Cartesian motion, seen in the turning frame. Of
// its eight, three are the closed form's no more: the angle, and the two that the kept constraint
// leaves at 0.
TEST(ElasticWhip, PerturbationsGrowAsTheModelSays) {
  for (const double mu : {0.18, 0.2, 0.241, 0.244, 0.26}) {
    const double nu = upper_whip(mu);
    const Model model = make_model(scene_of(kStiff, mu));
    const CircularWhirl w = kStiff.whirl(nu);
    Eigen::VectorXd y(8);
    y << plane(w.rotor, w.stator), plane(w.rotor_velocity, w.stator_velocity);
    // y = R(-nu t) x, R turns each pair: x' = R^-1 y' + nu T x.
    Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(8, 8);
    for (int i = 0; i < 8; i += 2) {
      turn(i, i + 1) = -nu;
      turn(i + 1, i) = nu;
    }
    const auto rate = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      return kept_in_contact(model, x) + turn * x;
    };
    ASSERT_LT(rate(y).norm(), 1e-9 * kept_in_contact(model, y).norm()) << "it stands";
    Eigen::MatrixXd jacobian(8, 8);
    for (int i = 0; i < 8; ++i) {
      const double h = 1e-5 * std::abs(i < 4 ? w.rotor : w.rotor_velocity);
      Eigen::VectorXd up = y, down = y;
      up[i] += h;
      down[i] -= h;
      jacobian.col(i) = (rate(up) - rate(down)) / (2.0 * h);
    }
    const std::vector<Complex> all = real_eigenvalues(jacobian).value();
    const std::vector<Complex> closed = kStiff.eigenvalues(nu);
    ASSERT_EQ(closed.size(), 5U);
    for (const Complex& x : closed) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const Complex& z : all) nearest = std::min(nearest, std::abs(z - x));
      EXPECT_LT(nearest, 1e-4 * std::abs(x) + 1e-2) << mu << ' ' << x;
    }
  }
}

TEST(ElasticWhip, StandsBelowTheHopfBorderAndNotAbove) {
  const Complex below = kStiff.eigenvalues(upper_whip(0.241)).front();
  EXPECT_NEAR(below.real(), -0.640, kDigits);
  EXPECT_NEAR(std::abs(below.imag()), 1327.76, 5e-3);
  const Complex above = kStiff.eigenvalues(upper_whip(0.244)).front();
  EXPECT_NEAR(above.real(), 1.098, kDigits);
  EXPECT_NEAR(std::abs(above.imag()), 1330.81, 5e-3);
  EXPECT_LT(kStiff.eigenvalues(upper_whip(0.2)).front().real(), 0.0);

  double low = 0.241, high = 0.244;
  while (high - low > 1e-12) {
    const double mu = 0.5 * (low + high);
    (kStiff.eigenvalues(upper_whip(mu)).front().real() < 0.0 ? low : high) = mu;
  }
  EXPECT_NEAR(low, 0.242109, 5e-7);
  EXPECT_NEAR(upper_whip(low), 523.362, kDigits);
  EXPECT_NEAR(std::abs(kStiff.eigenvalues(upper_whip(low)).front().imag()), 1328.89, 5e-3);
}

// The lower edge of each interval is a watershed: a real eigenvalue drives the whirl away from it.
TEST(ElasticWhip, LowerEdgesAreUnstable) {
  const std::vector<double> whips = kStiff.slipping_whips(0.2);
  for (const auto& [whip, nu] : {std::pair{kStiff, whips[0]}, std::pair{kStiff, whips[2]},
                                 std::pair{kSoft, kSoft.slipping_whips(0.15)[0]}}) {
    const Complex first = whip.eigenvalues(nu).front();
    EXPECT_GT(first.real(), 0.0) << nu;
    EXPECT_EQ(first.imag(), 0.0) << nu;
  }
}

}  // namespace
}  // namespace rotorub::oracle
