// Friction in both directions of the tangent plane: against closed forms, the planar law, and
// residuals that share no code with the solver.
#include "native_model/contact/disc_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "native_model/contact/coupled_law.h"

namespace rotorub::test {
namespace {

ContactMatrix random_bodies(std::mt19937& random, int contacts, int freedoms) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd w(freedoms, 3 * contacts);
  for (double& x : w.reshaped()) x = normal(random);
  return w.transpose() * w;
}

ContactVector random_motion(std::mt19937& random, int contacts) {
  std::normal_distribution<double> normal;
  ContactVector b(3 * contacts);
  for (double& x : b) x = normal(random);
  for (int i = 0; i < contacts; ++i) b[3 * i] -= 0.5;  // more often closing
  return b;
}

// How far (L, y) of one contact is from the laws, as a rate: complementarity; out of the set; and
// what another friction of the set, of 720 on its border, would dissipate more, per impulse of the
// rim.
double off_the_laws(const DiscSet& set, const Eigen::Vector3d& p, const Eigen::Vector3d& y,
                    double mobility) {
  const double normal = p.x(), rim = set.friction * normal;
  const Eigen::Vector2d l_t = p.tail<2>(), y_t = y.tail<2>();
  double worst =
      std::max({-y.x(), (set.least_normal - normal) * mobility, (l_t.norm() - rim) * mobility,
                (set.floor - l_t.dot(set.side)) * mobility,
                std::min(std::abs(y.x()), std::abs(normal - set.least_normal) * mobility)});
  if (!(rim > 0.0)) return worst;
  for (int k = 0; k < 720; ++k) {
    const double angle = k * std::numbers::pi / 360.0;
    const Eigen::Vector2d other(rim * std::cos(angle), rim * std::sin(angle));
    if (other.dot(set.side) < set.floor) continue;
    worst = std::max(worst, y_t.dot(l_t - other) / rim);
  }
  return worst;
}

double off_the_laws(const ContactMatrix& a, const ContactVector& b,
                    const std::vector<DiscSet>& sets, const ContactVector& p) {
  const ContactVector y = a * p + b;
  double worst = 0.0;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    worst = std::max(worst, off_the_laws(sets[i], p.segment<3>(at), y.segment<3>(at), a.trace()));
  }
  return worst / (b.norm() + a.trace() * p.norm());
}

// Slip along the axis, along the ring, and between: a body of mobility 1 in all directions.
TEST(DiscLaw, ByHand) {
  const ContactMatrix a = Eigen::Matrix3d::Identity();
  std::vector<DiscSet> sets(1);
  sets[0].friction = 0.5;
  const auto impulses = [&](double n, double t, double z) {
    const CoupledSolution s = solve_discs(a, Eigen::Vector3d(n, t, z), sets);
    EXPECT_EQ(s.solutions, 1);
    return Eigen::Vector3d(s.p);
  };
  EXPECT_EQ(impulses(1.0, 3.0, 4.0), Eigen::Vector3d(0.0, 0.0, 0.0));    // open
  EXPECT_EQ(impulses(-1.0, 0.0, 4.0), Eigen::Vector3d(1.0, 0.0, -0.5));  // falls
  EXPECT_EQ(impulses(-1.0, -4.0, 0.0), Eigen::Vector3d(1.0, 0.5, 0.0));
  EXPECT_LT((impulses(-1.0, 3.0, 4.0) - Eigen::Vector3d(1.0, -0.3, -0.4)).norm(), 1e-15);
  EXPECT_LT((impulses(-1.0, 0.3, 0.3) - Eigen::Vector3d(1.0, -0.3, -0.3)).norm(), 1e-15);  // sticks
  sets[0].friction = 0.0;
  EXPECT_EQ(impulses(-1.0, 3.0, 4.0), Eigen::Vector3d(1.0, 0.0, 0.0));
}

TEST(DiscLaw, OneContactMeetsTheLaws) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int sliding = 0, sticking = 0, several = 0, none = 0;
  for (int k = 0; k < 4000; ++k) {
    const ContactMatrix a = random_bodies(random, 1, 4);
    ContactVector b = random_motion(random, 1);
    // Fast slip, slow slip, and no slip in one direction.
    b.tail<2>() *= std::pow(10.0, 6.0 * unit(random) - 3.0);
    if (k % 10 == 0) b[1] = 0.0;
    std::vector<DiscSet> sets(1);
    sets[0].friction = k % 3 == 0 ? 2.0 * unit(random) : 0.3 * unit(random);
    const CoupledSolution s = solve_discs(a, b, sets);
    several += s.solutions > 1 ? 1 : 0;
    none += s.solutions == 0 ? 1 : 0;
    if (s.solutions == 0) continue;
    EXPECT_LT(off_the_laws(a, b, sets, s.p), 1e-11) << k;
    (s.sticks[0] ? sticking : sliding) += s.p[0] > 0.0 ? 1 : 0;
    EXPECT_LE(s.p.tail<2>().norm(), sets[0].friction * s.p[0] * (1.0 + 1e-12)) << k;
  }
  EXPECT_EQ(none, 0);
  EXPECT_LT(several, 200);  // great mu alone
  EXPECT_GT(sliding, 1000);
  EXPECT_GT(sticking, 200);
}

// If mu |G_NT| is far below G_NN, the motion is unique.
TEST(DiscLaw, OneSolutionWhereFrictionIsModerate) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 4000; ++k) {
    const ContactMatrix a = random_bodies(random, 1, 6);
    std::vector<DiscSet> sets(1);
    const double steepest = a(0, 0) / std::hypot(a(0, 1), a(0, 2));
    sets[0].friction = 0.3 * unit(random) * std::min(1.0, steepest);
    ASSERT_EQ(solve_discs(a, random_motion(random, 1), sets).solutions, 1) << k;
  }
}

// Without a motion along the axis the impulses are those of the planar law, also with expansion and
// tangential restitution.
TEST(DiscLaw, WithoutAnAxisItIsThePlanarLaw) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int compared = 0;
  for (int k = 0; k < 2000; ++k) {
    ContactMatrix a = random_bodies(random, 1, 4);
    ContactVector b = random_motion(random, 1);
    a.row(2).setZero();
    a.col(2).setZero();
    b[2] = 0.0;
    const std::vector<ImpactLaw> laws(
        1, ImpactLaw{unit(random), unit(random), k % 2 == 0 ? unit(random) : 0.0});
    const ImpactResult r = solve_impact({a(0, 0), a(0, 1), a(1, 0), a(1, 1)}, b[0], b[1], laws[0]);
    const CoupledSolution s = solve_coupled_impact(a, b, laws);
    if (r.status != Status::kOk) continue;
    ASSERT_EQ(s.solutions, 1) << k;
    ++compared;
    const double size = 1.0 + r.normal();
    EXPECT_NEAR(s.p[0], r.normal(), 1e-10 * size) << k;
    EXPECT_NEAR(s.p[1], r.friction(), 1e-10 * size) << k;
    EXPECT_EQ(s.p[2], 0.0) << k;
  }
  EXPECT_GT(compared, 1800);
}

TEST(DiscLaw, ExpansionMeetsItsSet) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int held = 0;
  for (int k = 0; k < 4000; ++k) {
    const ContactMatrix a = random_bodies(random, 1, 4);
    const std::vector<ImpactLaw> laws(1, ImpactLaw{unit(random), unit(random), unit(random)});
    const CoupledSolution c = solve_coupled_coulomb(a, random_motion(random, 1), laws);
    if (c.solutions != 1 || c.p[0] == 0.0) continue;
    const CoupledSolution e = solve_coupled_expansion(a, c.y, laws, c.p);
    ASSERT_GE(e.solutions, 1) << k;
    const DiscSet set =
        expansion_disc(laws[0], laws[0].friction.coefficient, c.p[0], c.p.segment<2>(1));
    EXPECT_LT(off_the_laws(a, c.y, {set}, e.p), 1e-10) << k;
    held += e.p.segment<2>(1).dot(set.side) < set.floor + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(held, 200);  // on the chord
}

// Impulses on the rotor give work p . (y_before + y_after) / 2. One contact and several, with
// tangential restitution and without.
TEST(DiscLaw, NoImpactGainsEnergy) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const int contacts : {1, 2, 3}) {
    int solved = 0;
    const int runs = contacts == 1 ? 40000 : 1000;
    for (int k = 0; k < runs; ++k) {
      const ContactMatrix a = random_bodies(random, contacts, 3 + 2 * contacts);
      const ContactVector b = random_motion(random, contacts);
      std::vector<ImpactLaw> laws(static_cast<std::size_t>(contacts));
      for (ImpactLaw& law : laws)
        law = {(contacts == 1 ? 1.0 : 0.3) * unit(random), unit(random), unit(random)};
      const CoupledSolution s = solve_coupled_impact(a, b, laws);
      if (s.solutions != 1) continue;
      ++solved;
      EXPECT_LT(0.5 * s.p.dot(b + s.y), 1e-10 * (s.p.norm() * b.norm() + 1e-12))
          << contacts << " " << k;
    }
    EXPECT_GT(solved, 9 * runs / 10) << contacts;
  }
}

// Directions with different mobilities, very different rates, friction far above 1 with a coupled
// normal: hard because the friction nearly jams. There is a solution, and no gain of energy.
TEST(DiscLaw, BadlyScaledContactsAreSolved) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 30000; ++k) {
    Eigen::MatrixXd w(3 + k % 3, 3);
    for (double& x : w.reshaped()) x = normal(random);
    for (int j = 0; j < 3; ++j) w.col(j) *= std::pow(10.0, 4.0 * (unit(random) - 0.5));
    const ContactMatrix a = std::pow(10.0, 12.0 * unit(random) - 6.0) * w.transpose() * w;
    ContactVector b(3);
    for (double& x : b) x = normal(random) * std::pow(10.0, 7.0 * unit(random) - 6.0);
    if (k % 5 != 0) b[0] = -std::abs(b[0]);
    const std::vector<ImpactLaw> laws(
        1, ImpactLaw{(k % 2 == 0 ? 1.0 : 10.0) * unit(random), unit(random), unit(random)});
    const CoupledSolution c = solve_coupled_coulomb(a, b, laws);
    ASSERT_GE(c.solutions, 1) << k;
    if (c.solutions > 1) continue;
    const CoupledSolution e = solve_coupled_expansion(a, c.y, laws, c.p);
    ASSERT_GE(e.solutions, 1) << k;
    if (e.solutions > 1) continue;
    const ContactVector p = c.p + e.p;
    EXPECT_LE(p.dot(b + e.y), 1e-10 * p.cwiseAbs().dot(b.cwiseAbs() + e.y.cwiseAbs())) << k;
  }
}

TEST(DiscLaw, SeveralContactsMeetTheLaws) {
  std::mt19937 random(6);
  int solved = 0;
  for (const int contacts : {2, 3, 8}) {
    for (int k = 0; k < 300; ++k) {
      const ContactMatrix a = random_bodies(random, contacts, 3 * contacts - 1);
      const ContactVector b = random_motion(random, contacts);
      std::vector<DiscSet> sets(static_cast<std::size_t>(contacts));
      for (DiscSet& s : sets) s.friction = 0.2;
      const CoupledSolution s = solve_discs(a, b, sets);
      if (s.solutions == 0) continue;
      ++solved;
      EXPECT_LT(off_the_laws(a, b, sets, s.p), 1e-11) << contacts << " " << k;
    }
  }
  EXPECT_GT(solved, 890);
}

// Two rings of a shaft side by side: one contact's rows, and the same less what the distance
// between makes of them.
TEST(DiscLaw, TwoContactsThatAreNearlyOne) {
  std::mt19937 random(8);
  std::normal_distribution<double> normal;
  for (const double apart : {1.0, 1e-1, 1e-2}) {
    int solved = 0;
    for (int k = 0; k < 200; ++k) {
      Eigen::MatrixXd w(6, 6), beside(6, 3);
      for (double& x : w.reshaped()) x = normal(random);
      for (double& x : beside.reshaped()) x = normal(random);
      w.rightCols(3) = w.leftCols(3) + apart * beside;
      const ContactMatrix a = w.transpose() * w;
      Eigen::VectorXd v(6);
      for (double& x : v) x = normal(random);
      ContactVector b = w.transpose() * v;
      if (b[0] > 0.0) b = -b;
      std::vector<DiscSet> sets(2);
      for (DiscSet& s : sets) s.friction = 0.3;
      const CoupledSolution s = solve_discs(a, b, sets);
      if (s.solutions == 0) continue;
      ++solved;
      EXPECT_LT(off_the_laws(a, b, sets, s.p), 1e-10) << apart << " " << k;
    }
    EXPECT_GT(solved, 190) << apart;
  }
}

// Two rings about a body that cannot tilt: the motion is unique, and each ring takes half, also
// along the axis.
TEST(DiscLaw, ContactsAtOnePlaceShareEqually) {
  ContactMatrix a(6, 6);
  const Eigen::Matrix3d one = Eigen::Vector3d(0.5, 0.7, 0.6).asDiagonal();
  a << one, one, one, one;
  ContactVector b(6);
  b << -0.3, 0.5, 0.4, -0.3, 0.5, 0.4;
  for (const double mu : {0.0, 0.15, 3.0}) {
    const std::vector<ImpactLaw> laws(2, ImpactLaw{mu, 0.5, 0.0});
    const CoupledSolution s = solve_coupled_impact(a, b, laws);
    ASSERT_EQ(s.solutions, 1) << mu;
    EXPECT_NEAR(s.p[0], 0.45, 1e-12);
    EXPECT_LT((s.p.head<3>() - s.p.tail<3>()).norm(), 1e-12);
    EXPECT_NEAR(s.y[0], 0.15, 1e-12);
  }
}

TEST(DiscLaw, AContactThatCannotOpenHasNoSolution) {
  const ContactMatrix a = Eigen::Vector3d(0.0, 1.0, 1.0).asDiagonal();
  EXPECT_EQ(solve_discs(a, Eigen::Vector3d(-1.0, 0.5, 0.5), std::vector<DiscSet>(1)).solutions, 0);
}

}  // namespace
}  // namespace rotorub::test
