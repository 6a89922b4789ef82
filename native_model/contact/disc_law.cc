#include "native_model/contact/disc_law.h"

#include <algorithm>
#include <cassert>

namespace rotorub {
namespace {

constexpr int kDiscSweeps = 4000;
constexpr int kPolished = 8;        // number of sweeps between two trials of the linear system
constexpr int kTurns = 20;          // number of updates of the slips' directions in it
constexpr double kSettled = 1e-13;  // largest change in the last sweep, relative to the rates
using DiscCases = std::array<DiscCase, kMaxContacts>;

class DiscSystem {
 public:
  DiscSystem(const ContactMatrix& a, const ContactVector& b, std::span<const DiscSet> sets)
      : a_(a), b_(b), sets_(sets), n_(static_cast<Eigen::Index>(sets.size())) {
    for (const DiscSet& set : sets) impulse_ = std::max(impulse_, set.least_normal);
  }

  CoupledSolution solve() const {
    ContactVector p = ContactVector::Zero(b_.size());
    DiscCases cases{};
    for (int k = 0; k < kDiscSweeps; ++k) {
      const double change = sweep(p, cases);
      if (change < 0.0) return {};
      const bool settled = change <= kSettled * scale(p);
      if (!settled && k % kPolished != kPolished - 1) continue;
      ContactVector shared = p;
      DiscCases same = all_closed(cases, p);
      if (polish(same, shared)) {
        ContactVector again = shared;
        const double left = sweep(again, same);
        if (left >= 0.0 && left <= kSettled * scale(shared)) return found(same, shared);
      }
      if (settled) return found(cases, p);
    }
    return {};
  }

 private:
  double scale(const ContactVector& p) const {
    return b_.cwiseAbs().maxCoeff() +
           std::max(p.cwiseAbs().maxCoeff(), impulse_) * a_.cwiseAbs().maxCoeff();
  }

  // Solves each contact by itself with the impulses of the others. Returns the largest change of a
  // rate, or a negative number if a contact has no solution.
  double sweep(ContactVector& p, DiscCases& cases) const {
    double change = 0.0;
    for (Eigen::Index i = 0; i < n_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const Eigen::Matrix3d own = a_.block<3, 3>(3 * i, 3 * i);
      const Eigen::Vector3d before = p.segment<3>(3 * i);
      const Eigen::Vector3d rest =
          b_.segment<3>(3 * i) + a_.middleRows<3>(3 * i) * p - own * before;
      const SingleDisc s = solve_disc(own, rest, sets_[at], Solutions::kFirst);
      if (s.solutions == 0) return -1.0;
      p.segment<3>(3 * i) = s.p;
      cases[at] = s.found;
      change = std::max(change, (own * (s.p - before)).cwiseAbs().maxCoeff());
    }
    return change;
  }

  // The same cases, but with every contact closed that the solution leaves on its circle: a contact
  // that neither opens nor has a force may take a share of the load of the others.
  DiscCases all_closed(DiscCases cases, const ContactVector& p) const {
    const ContactVector y = a_ * p + b_;
    const double none = kSettled * scale(p);
    for (Eigen::Index i = 0; i < n_; ++i) {
      DiscCase& c = cases[static_cast<std::size_t>(i)];
      if (!c.at_bound || y[3 * i] > none) continue;
      c.at_bound = false;
      if (y.segment<2>(3 * i + 1).norm() <= none) c.friction = DiscFriction::kStick;
    }
    return cases;
  }

  // Finds the impulses of these cases; the directions of sliding contacts follow their slips. False
  // if a case is not linear or the impulses are not finite.
  bool polish(DiscCases& cases, ContactVector& p) const {
    for (int k = 0; k < kTurns; ++k) {
      CaseSystem system(3 * n_);
      for (Eigen::Index i = 0; i < n_; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (!add_case(cases[at], sets_[at], 3 * i, system)) return false;
      }
      p = system.solve(a_, b_);
      if (!p.allFinite()) return false;
      if (!turn(cases, a_ * p + b_)) return true;
    }
    return true;
  }

  static bool add_case(const DiscCase& c, const DiscSet& set, Eigen::Index row, CaseSystem& s) {
    if (c.friction == DiscFriction::kCorner) return false;
    Eigen::Vector2d by_normal(0.0, 0.0), given(0.0, 0.0);
    if (c.friction == DiscFriction::kRim) by_normal = -set.friction * c.direction;
    if (c.friction == DiscFriction::kChord) given = set.floor * set.side;
    if (c.at_bound) {
      s.given[row] = set.least_normal;
      given += set.least_normal * by_normal;
    } else {
      s.set_unknown(row);
      for (const Eigen::Index k : {0, 1}) s.tie(row + 1 + k, by_normal[k]);
    }
    s.given.segment<2>(row + 1) = given;
    if (c.friction == DiscFriction::kStick) {
      s.set_unknown(row + 1);
      s.set_unknown(row + 2);
    } else if (c.friction == DiscFriction::kChord) {
      const Eigen::Vector2d along(-set.side.y(), set.side.x());
      s.columns.col(s.count).segment<2>(row + 1) = along;
      s.rows.col(s.count++).segment<2>(row + 1) = along;
    }
    return true;
  }

  // Turns the directions of sliding contacts to their slips. False if they agree already.
  bool turn(DiscCases& cases, const ContactVector& y) const {
    bool turned = false;
    for (Eigen::Index i = 0; i < n_; ++i) {
      DiscCase& c = cases[static_cast<std::size_t>(i)];
      const Eigen::Vector2d slip = y.segment<2>(3 * i + 1);
      if (c.friction != DiscFriction::kRim || slip.isZero(0.0)) continue;
      const Eigen::Vector2d direction = slip.normalized();
      turned = turned || (direction - c.direction).norm() > 1e-15;
      c.direction = direction;
    }
    return turned;
  }

  CoupledSolution found(const DiscCases& cases, const ContactVector& p) const {
    CoupledSolution out;
    out.solutions = 1;
    out.p = p;
    out.y = a_ * p + b_;
    for (Eigen::Index i = 0; i < n_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      out.sticks[at] = cases[at].friction == DiscFriction::kStick;
      out.y[3 * i] = cases[at].at_bound ? std::max(0.0, out.y[3 * i]) : 0.0;  // removes round-off
      if (out.sticks[at]) out.y.segment<2>(3 * i + 1).setZero();
    }
    return out;
  }

  const ContactMatrix& a_;
  const ContactVector& b_;
  std::span<const DiscSet> sets_;
  Eigen::Index n_;
  double impulse_ = 0.0;
};

}  // namespace

DiscSet expansion_disc(const ImpactLaw& law, double mu, double normal,
                       const Eigen::Vector2d& friction) {
  DiscSet set;
  set.friction = mu;
  set.least_normal = law.restitution * normal;
  const double size = friction.norm();
  if (size > 0.0) set.side = friction / size;
  set.floor = law.restitution * law.tangential_restitution * size;
  return set;
}

CoupledSolution solve_discs(const ContactMatrix& a, const ContactVector& b,
                            std::span<const DiscSet> sets) {
  assert(a.rows() == b.size() && b.size() == 3 * static_cast<Eigen::Index>(sets.size()));
  if (sets.size() > 1) return DiscSystem(a, b, sets).solve();
  const SingleDisc s = solve_disc(a, b, sets[0]);
  CoupledSolution out;
  out.solutions = s.solutions;
  out.p = s.p;
  out.y = s.y;
  out.sticks[0] = s.found.friction == DiscFriction::kStick;
  return out;
}

}  // namespace rotorub
