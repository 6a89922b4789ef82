// Several contacts that act on the same bodies: against closed forms, an enumeration without the
// solver's cases, and a residual that shares no code with the solver.
#include "native_model/contact/coupled_law.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace rotorub::test {
namespace {

// Bodies at random, seen by n contacts: G = W^T M^-1 W, positive semidefinite of the given rank.
ContactMatrix random_system(std::mt19937& random, int contacts, int freedoms) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd w(freedoms, 2 * contacts);
  for (double& x : w.reshaped()) x = normal(random);
  return w.transpose() * w;
}

ContactVector random_rates(std::mt19937& random, int contacts) {
  std::normal_distribution<double> normal;
  ContactVector b(2 * contacts);
  for (double& x : b) x = normal(random);
  for (int i = 0; i < contacts; ++i) b[2 * i] -= 0.5;  // more often closing
  return b;
}

// Distance of (L, y) from the laws: the projection equations of the sets, in units of `impulse`.
double residual(const ContactMatrix& a, const ContactVector& b, const std::vector<ContactSet>& sets,
                const ContactVector& p) {
  const ContactVector y = a * p + b;
  double worst = 0.0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto n = static_cast<Eigen::Index>(2 * i), t = n + 1;
    const double r = 1.0 / a.trace();
    const double normal = std::max(p[n] - r * y[n], sets[i].least_normal);
    const double low = sets[i].low(p[n]), high = std::max(low, sets[i].high(p[n]));
    const double friction = std::clamp(p[t] - r * y[t], low, high);
    worst = std::max({worst, std::abs(normal - p[n]), std::abs(friction - p[t])});
  }
  return worst / (p.cwiseAbs().maxCoeff() + b.cwiseAbs().maxCoeff() / a.trace());
}

// The classical linear complementarity problem of two contacts with friction (Glocker), by brute
// force: y_T = y_T^+ - y_T^-, z = (L_N, mu L_N + L_T, y_T^-) >= 0, w = (y_N, y_T^+, mu L_N - L_T)
// >= 0, z w = 0: of each pair one is zero; all 2^6 choices.
std::vector<ContactVector> by_lcp(const ContactMatrix& a, const ContactVector& b, double mu) {
  const int n = static_cast<int>(b.size()) / 2;
  Eigen::MatrixXd nn(n, n), nt(n, n), tn(n, n), tt(n, n);
  Eigen::VectorXd bn(n), bt(n);
  for (int i = 0; i < n; ++i) {
    bn[i] = b[2 * i];
    bt[i] = b[2 * i + 1];
    for (int j = 0; j < n; ++j) {
      nn(i, j) = a(2 * i, 2 * j);
      nt(i, j) = a(2 * i, 2 * j + 1);
      tn(i, j) = a(2 * i + 1, 2 * j);
      tt(i, j) = a(2 * i + 1, 2 * j + 1);
    }
  }
  Eigen::MatrixXd m(3 * n, 3 * n);
  m.setZero();
  m.block(0, 0, n, n) = nn - mu * nt;
  m.block(0, n, n, n) = nt;
  m.block(n, 0, n, n) = tn - mu * tt;
  m.block(n, n, n, n) = tt;
  m.block(n, 2 * n, n, n).setIdentity();
  m.block(2 * n, 0, n, n) = 2.0 * mu * Eigen::MatrixXd::Identity(n, n);
  m.block(2 * n, n, n, n) = -Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd q(3 * n);
  q << bn, bt, Eigen::VectorXd::Zero(n);
  std::vector<ContactVector> found;
  for (unsigned choice = 0; choice < (1u << (3 * n)); ++choice) {
    // w - m z = q with z_i = 0 or w_i = 0.
    Eigen::MatrixXd system(3 * n, 3 * n);
    for (int i = 0; i < 3 * n; ++i) {
      if (choice >> i & 1u) {
        system.col(i) = -m.col(i);
      } else {
        system.col(i) = Eigen::VectorXd::Unit(3 * n, i);
      }
    }
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(system);
    if (!lu.isInvertible()) continue;
    const Eigen::VectorXd x = lu.solve(q);
    if (x.minCoeff() < -1e-9) continue;
    ContactVector p(2 * n);
    for (int i = 0; i < n; ++i) {
      const double normal = choice >> i & 1u ? x[i] : 0.0;
      const double s = choice >> (n + i) & 1u ? x[n + i] : 0.0;
      p[2 * i] = normal;
      p[2 * i + 1] = s - mu * normal;
    }
    const bool known = std::any_of(found.begin(), found.end(), [&](const ContactVector& other) {
      return (other - p).norm() < 1e-7 * (1.0 + p.norm());
    });
    if (!known) found.push_back(p);
  }
  return found;
}

TEST(CoupledLaw, TwoContactsAreTheLinearComplementarityProblem) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int several = 0, pressed = 0;
  for (int k = 0; k < 3000; ++k) {
    const ContactMatrix a = random_system(random, 2, 5);
    const ContactVector b = random_rates(random, 2);
    const double mu = k % 3 == 0 ? 2.0 * unit(random) : 0.5 * unit(random);
    const std::vector<ContactVector> all = by_lcp(a, b, mu);
    std::vector<ContactSet> sets(2);
    for (ContactSet& s : sets) s.friction = mu;
    const CoupledSolution s = solve_coupled(a, b, sets);
    ASSERT_EQ(s.solutions, static_cast<int>(all.size())) << k;
    several += s.solutions != 1 ? 1 : 0;
    if (all.empty()) continue;
    pressed += s.p[0] > 0.0 && s.p[2] > 0.0 ? 1 : 0;
    const double nearest = (*std::min_element(all.begin(), all.end(),
                                              [&](const auto& x, const auto& y) {
                                                return (x - s.p).norm() < (y - s.p).norm();
                                              }) -
                            s.p)
                               .norm();
    EXPECT_LT(nearest, 1e-8 * (1.0 + s.p.norm())) << k;
    EXPECT_LT(residual(a, b, sets, s.p), 1e-12) << k;
  }
  EXPECT_GT(pressed, 300);
  EXPECT_LT(several, 600);  // large mu: none or several, as of one contact
}

TEST(CoupledLaw, AMatrixInBlocksIsOneContactAfterTheOther) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    ContactMatrix a = ContactMatrix::Zero(4, 4);
    ContactVector b = random_rates(random, 2);
    std::vector<ImpactLaw> laws(2);
    for (Eigen::Index i = 0; i < 2; ++i) {
      a.block(2 * i, 2 * i, 2, 2) = random_system(random, 1, 3);
      laws[static_cast<std::size_t>(i)] = {0.4 * unit(random), unit(random), unit(random)};
    }
    const CoupledSolution s = solve_coupled_impact(a, b, laws);
    if (s.solutions != 1) continue;
    for (Eigen::Index i = 0; i < 2; ++i) {
      const ContactMatrix g = a.block(2 * i, 2 * i, 2, 2);
      const ImpactResult r = solve_impact({g(0, 0), g(0, 1), g(1, 0), g(1, 1)}, b[2 * i],
                                          b[2 * i + 1], laws[static_cast<std::size_t>(i)]);
      ASSERT_EQ(r.status, Status::kOk);
      EXPECT_NEAR(s.p[2 * i], r.normal(), 1e-11) << k;
      EXPECT_NEAR(s.p[2 * i + 1], r.friction(), 1e-11) << k;
      EXPECT_NEAR(s.y[2 * i], r.gap_rate, 1e-11) << k;
    }
  }
}

// Impulses on the rotor give work p . (y_before + y_after) / 2.
TEST(CoupledLaw, NoImpactGainsEnergy) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int contacts : {2, 3, 5}) {
    for (int k = 0; k < (contacts == 5 ? 40 : 400); ++k) {
      const ContactMatrix a = random_system(random, contacts, 3 + contacts);
      const ContactVector b = random_rates(random, contacts);
      std::vector<ImpactLaw> laws(static_cast<std::size_t>(contacts));
      for (ImpactLaw& law : laws) law = {0.3 * unit(random), unit(random), unit(random)};
      const CoupledSolution s = solve_coupled_impact(a, b, laws);
      if (s.solutions != 1) continue;
      const double work = 0.5 * s.p.dot(b + s.y);
      EXPECT_LT(work, 1e-10 * (s.p.norm() * b.norm() + 1e-12)) << contacts << " " << k;
      for (Eigen::Index i = 0; i < contacts; ++i) EXPECT_GE(s.y[2 * i], 0.0);
    }
  }
}

// More than three contacts are solved by sweeps, and as exactly.
TEST(CoupledLaw, EightContactsMeetTheLaws) {
  std::mt19937 random(4);
  for (int k = 0; k < 30; ++k) {
    const ContactMatrix a = random_system(random, 8, 20);
    const ContactVector b = random_rates(random, 8);
    std::vector<ContactSet> sets(8);
    for (ContactSet& s : sets) s.friction = 0.2;
    const CoupledSolution s = solve_coupled(a, b, sets);
    ASSERT_EQ(s.solutions, 1) << k;
    EXPECT_LT(residual(a, b, sets, s.p), 1e-11) << k;
  }
}

// Rings of different friction and restitution at one place: their impulses, and so the friction,
// could be shared in many ways. They share the normal impulse equally, in any order.
TEST(CoupledLaw, WhatIsSharedDoesNotDependOnTheOrder) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int contacts : {2, 3, 4, 5, 6, 7, 8}) {
    for (int k = 0; k < 50; ++k) {
      const auto rows = static_cast<Eigen::Index>(2 * contacts);
      const double slip = (unit(random) - 0.5) * (k % 2 == 0 ? 1.0 : 1e3);
      ContactMatrix a = ContactMatrix::Zero(rows, rows);
      ContactVector b(rows);
      for (Eigen::Index i = 0; i < rows; ++i) {
        b[i] = i % 2 == 0 ? -0.1 : slip;
        for (Eigen::Index j = i % 2; j < rows; j += 2) a(i, j) = i % 2 == 0 ? 0.5 : 0.7;
      }
      std::vector<ImpactLaw> laws(static_cast<std::size_t>(contacts));
      double friction = 0.0, restitution = 0.0;
      for (ImpactLaw& law : laws) {
        law = {0.5 * unit(random), unit(random), 0.0};
        friction += law.friction.coefficient / contacts;
        restitution += law.restitution / contacts;
      }
      const CoupledSolution s = solve_coupled_impact(a, b, laws);
      std::reverse(laws.begin(), laws.end());
      const CoupledSolution back = solve_coupled_impact(a, b, laws);
      ASSERT_EQ(s.solutions, 1) << contacts << " " << k;
      ASSERT_EQ(back.solutions, 1) << contacts << " " << k;
      EXPECT_LT((s.y - back.y).norm(), 1e-12 * b.norm()) << contacts << " " << k;
      const double rubbed = 0.7 * 0.2 * friction;
      if (std::abs(slip) < rubbed) continue;  // they stick, and least friction counts too
      EXPECT_NEAR(s.y[0], 0.1 * restitution, 1e-12) << contacts << " " << k;
      const CoupledSolution compressed = solve_coupled_coulomb(a, b, laws);
      EXPECT_NEAR(compressed.y[1], slip - std::copysign(rubbed, slip), 1e-10 * std::abs(slip));
      for (int i = 0; i < contacts; ++i)
        EXPECT_NEAR(compressed.p[2 * i], 0.2 / contacts, 1e-12) << contacts << " " << k;
    }
  }
}

// Two rings at one place jam as one does: a rule for sharing does not remove one of two motions.
TEST(CoupledLaw, JammingIsAmbiguousForAnyNumberOfContacts) {
  for (const int contacts : {1, 2, 3}) {
    const auto rows = static_cast<Eigen::Index>(2 * contacts);
    ContactMatrix a(rows, rows);
    ContactVector b(rows);
    for (Eigen::Index i = 0; i < rows; ++i) {
      b[i] = i % 2 == 0 ? 0.1 : 1.0;
      for (Eigen::Index j = 0; j < rows; ++j)
        a(i, j) = (i + j) % 2 == 1 ? 3.0 : i % 2 == 0 ? 1.0 : 10.0;
    }
    std::vector<ContactSet> sets(static_cast<std::size_t>(contacts));
    for (ContactSet& s : sets) s.friction = 0.5, s.slides = 1.0;
    EXPECT_GT(solve_coupled(a, b, sets).solutions, 1) << contacts;
  }
}

// Contacts of a mode that is 1 at one and nearly 1 at the other: which of them sticks is
// undetermined, the motion of the mode is not.
TEST(CoupledLaw, ContactsThatAreNearlyAlikeHaveOneMotion) {
  for (const double other : {1.0, 1.0 + 1e-12, 1.0 + 1e-9, 1.0 - 1e-7}) {
    for (const double slip : {-0.3, -0.01, 0.01, 0.3}) {
      const double shape[] = {1.0, other};
      ContactMatrix a = ContactMatrix::Zero(4, 4);
      ContactVector b(4);
      for (const int i : {0, 1}) {
        b.segment<2>(2 * i) << -0.1 * shape[i], slip * shape[i] + 0.02;
        for (const int j : {0, 1}) {
          a(2 * i, 2 * j) = 0.5 * shape[i] * shape[j];
          a(2 * i + 1, 2 * j + 1) = 0.5 * shape[i] * shape[j] + 0.4;
        }
      }
      ImpactLaw law;
      law.friction = {0.4};
      law.restitution = 0.3;
      const std::array<ImpactLaw, 2> laws{law, law};
      const CoupledSolution s = solve_coupled_impact(a, b, laws);
      ASSERT_EQ(s.solutions, 1) << other << " " << slip;
      EXPECT_NEAR(s.y[0], 0.03, 1e-6);
      EXPECT_NEAR(s.y[2], 0.03, 1e-6);
    }
  }
}

// A body that cannot move gets no impulse, and this is reported.
TEST(CoupledLaw, ABodyThatCannotMoveHasNoSolution) {
  const ContactMatrix a = ContactMatrix::Zero(4, 4);
  ContactVector b(4);
  b << -1.0, 0.5, -1.0, 0.5;
  const std::vector<ContactSet> sets(2);
  EXPECT_EQ(solve_coupled(a, b, sets).solutions, 0);
}

}  // namespace
}  // namespace rotorub::test
