#include "native_model/contact/several_on_circles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "native_model/contact/coupled_problem.h"
#include "native_model/contact/kinematics.h"

namespace rotorub {
namespace {

constexpr std::size_t kMostRows = 2 * static_cast<std::size_t>(kMaxContacts);

// Solves the n equations a x = b by elimination with pivoting; x replaces b. False if a is
// singular.
bool eliminate(std::size_t n, double (&a)[kMostRows][kMostRows], double (&b)[kMostRows]) {
  constexpr double kLeastPivot = 1e-12;  // relative to the largest element
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, std::abs(a[i][j]));
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    }
    if (!(std::abs(a[pivot][k]) > kLeastPivot * largest)) return false;
    if (pivot != k) {
      std::swap(a[k], a[pivot]);
      std::swap(b[k], b[pivot]);
    }
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k + 1; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return true;
}

class SeveralOnCircles {
 public:
  SeveralOnCircles(double h, std::span<LastingContact> contacts, const ContactAdmittance& a)
      : h_(h), c_(contacts) {
    for (std::size_t j = 0; j < c_.size(); ++j) {
      const Eigen::Vector3d normal = contact_load(c_[j].e_r, c_[j].radius, 1.0, 0.0);
      const Eigen::Vector3d friction = contact_load(c_[j].e_r, c_[j].radius, 0.0, 1.0);
      for (std::size_t i = 0; i < c_.size(); ++i) {
        effect_[i][2 * j].noalias() = a(i, j) * normal;
        effect_[i][2 * j + 1].noalias() = a(i, j) * friction;
      }
    }
  }

  bool go_on_as_before();
  Status solve();

 private:
  // The friction of a contact: it follows from the slip (Coulomb's set), or it is a given ratio to
  // the normal impulse.
  struct Friction {
    double bound = 0.0;  // mu
    bool given = false;
    double ratio = 0.0;
  };
  CoupledSolution solve_with(std::span<const Friction> friction) const;
  bool whirls_too_far() const;

  double h_;
  std::span<LastingContact> c_;
  // Element [i][j]: the rates of contact i per unit of impulse j (normal and friction of each
  // contact in turn).
  std::array<std::array<Eigen::Vector3d, kMostRows>, kMaxContacts> effect_;
};

// Tries whether each contact slides on in the same direction, with a constant mu, or continues to
// stick. The unknowns are the normal impulses and the friction impulses of sticking contacts. If
// this does not hold or has no unique solution, it returns false and changes nothing.
bool SeveralOnCircles::go_on_as_before() {
  const std::size_t n = c_.size();
  struct Unknown {
    std::size_t contact;
    bool friction;
  };
  std::array<Unknown, kMostRows> unknown;
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const LastingContact& c = c_[i];
    const bool slid = c.slip_sign != 0.0;
    if (slid && !(c.friction.is_constant() && slip_before(c) * c.slip_sign > 0.0)) return false;
    unknown[count++] = {i, false};
    if (c.slip_sign == 0.0) unknown[count++] = {i, true};
  }
  // Element [i][u]: the rates of contact i per unit of unknown u.
  std::array<std::array<Eigen::Vector3d, kMostRows>, kMaxContacts> by;
  for (std::size_t u = 0; u < count; ++u) {
    const std::size_t j = unknown[u].contact;
    const double ratio = -c_[j].friction.coefficient * c_[j].slip_sign;
    for (std::size_t i = 0; i < n; ++i) {
      const auto& e = effect_[i];
      by[i][u] =
          unknown[u].friction ? e[2 * j + 1] : Eigen::Vector3d(e[2 * j] + ratio * e[2 * j + 1]);
    }
  }
  double p[kMostRows], matrix[kMostRows][kMostRows], rest[kMostRows];
  for (std::size_t u = 0; u < count; ++u) {
    const LastingContact& c = c_[unknown[u].contact];
    p[u] = unknown[u].friction ? c.friction_impulse : c.normal_impulse;
  }
  std::array<Eigen::Vector3d, kMaxContacts> rates;
  constexpr int kRounds = 8;
  // Relative to the largest impulse. After a change of kDone the next change would be of the order
  // of its square, below round-off. After a change of kNear, a round without further progress shows
  // only round-off, which is large in gaps divided by a small h.
  constexpr double kDone = 1e-8, kNear = 1e-6;
  double last = std::numeric_limits<double>::infinity();
  for (int round = 0;; ++round) {
    if (round == kRounds) return false;
    for (std::size_t i = 0; i < n; ++i) {
      rates[i] = c_[i].free;
      for (std::size_t u = 0; u < count; ++u) rates[i] += p[u] * by[i][u];
    }
    for (std::size_t row = 0; row < count; ++row) {
      const LastingContact& c = c_[unknown[row].contact];
      const auto& effects = by[unknown[row].contact];
      const Eigen::Vector3d& now = rates[unknown[row].contact];
      if (unknown[row].friction) {
        for (std::size_t u = 0; u < count; ++u) matrix[row][u] = slip_of(c, effects[u]);
        rest[row] = -slip_of(c, now);
        continue;
      }
      const Eigen::Vector2d end = c.d + h_ * now.head<2>();
      const double distance = end.norm();
      for (std::size_t u = 0; u < count; ++u) {
        matrix[row][u] = end.dot(effects[u].head<2>()) / distance;
      }
      rest[row] = (c.clearance - distance) / h_;
    }
    if (!eliminate(count, matrix, rest)) return false;
    double moved = 0.0, largest = 0.0;
    for (std::size_t u = 0; u < count; ++u) {
      p[u] += rest[u];
      moved = std::max(moved, std::abs(rest[u]));
      largest = std::max(largest, std::abs(p[u]));
    }
    if (!std::isfinite(largest)) return false;
    if (moved <= kDone * largest || (moved <= kNear * largest && moved > 0.25 * last)) break;
    last = moved;
  }
  std::array<double, kMaxContacts> normal{}, friction{};
  for (std::size_t u = 0; u < count; ++u) {
    (unknown[u].friction ? friction : normal)[unknown[u].contact] = p[u];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const LastingContact& c = c_[i];
    if (!(normal[i] > 0.0)) return false;
    if (c.slip_sign == 0.0) {
      if (!(std::abs(friction[i]) <= c.friction.sticking() * normal[i])) return false;
      continue;
    }
    if (!(slip_of(c, rates[i]) * c.slip_sign > 0.0)) return false;
    friction[i] = -c.friction.coefficient * c.slip_sign * normal[i];
  }
  for (std::size_t i = 0; i < n; ++i) {
    c_[i].normal_impulse = normal[i];
    c_[i].friction_impulse = friction[i];
  }
  return true;
}

// The step impulses for which each centre ends on its circle, for the given friction: Newton's
// method, whose linear problem is solve_coupled().
CoupledSolution SeveralOnCircles::solve_with(std::span<const Friction> friction) const {
  const auto n = static_cast<Eigen::Index>(c_.size());
  std::array<ContactSet, kMaxContacts> sets{};
  for (std::size_t i = 0; i < c_.size(); ++i) {
    sets[i].friction = friction[i].given ? std::abs(friction[i].ratio) : friction[i].bound;
    if (friction[i].given) sets[i].slides = friction[i].ratio > 0.0 ? -1.0 : 1.0;
  }
  CoupledSolution s;
  ContactVector p = ContactVector::Zero(2 * n);
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    ContactMatrix a(2 * n, 2 * n);
    ContactVector b(2 * n);
    for (std::size_t i = 0; i < c_.size(); ++i) {
      const LastingContact& c = c_[i];
      const auto row = static_cast<Eigen::Index>(2 * i);
      Eigen::Vector3d rates = c.free;
      for (Eigen::Index j = 0; j < 2 * n; ++j) {
        rates += p[j] * effect_[i][static_cast<std::size_t>(j)];
      }
      const Eigen::Vector2d end = c.d + h_ * rates.head<2>();
      const double distance = end.norm();
      const Eigen::Vector2d out = end / distance;
      for (Eigen::Index j = 0; j < 2 * n; ++j) {
        const Eigen::Vector3d& by = effect_[i][static_cast<std::size_t>(j)];
        a(row, j) = -out.dot(by.head<2>());
        a(row + 1, j) = slip_of(c, by);
      }
      b[row] = (c.clearance - distance) / h_ - a.row(row).dot(p);
      b[row + 1] = slip_of(c, c.free);
    }
    s = solve_coupled(a, b, std::span(sets).first(c_.size()));
    if (!s.is_unique()) return s;
    const double moved = (s.p - p).cwiseAbs().maxCoeff();
    p = s.p;
    if (moved <= 1e-14 * p.cwiseAbs().maxCoeff()) break;
  }
  return s;
}

bool SeveralOnCircles::whirls_too_far() const {
  constexpr double kMostTurn = 0.5;  // rad
  return std::ranges::any_of(c_, [&](const LastingContact& c) {
    const Eigen::Vector2d &e = c.e_r, w = c.start.head<2>();
    return h_ * std::abs(e.x() * w.y() - e.y() * w.x()) > kMostTurn * c.clearance;
  });
}

Status SeveralOnCircles::solve() {
  std::array<Friction, kMaxContacts> friction{};
  std::array<SlipFriction, kMaxContacts> of_slip;
  std::array<double, kMaxContacts> before{}, until{};
  const std::size_t n = c_.size();
  for (std::size_t i = 0; i < n; ++i) {
    before[i] = slip_before(c_[i]);
    friction[i].bound = c_[i].friction.sticking();
    if (before[i] != 0.0) {
      of_slip[i] = {c_[i].friction, before[i]};
      friction[i].bound = of_slip[i].mu();
      friction[i].given = true;
      friction[i].ratio = before[i] > 0.0 ? -friction[i].bound : friction[i].bound;
    }
  }
  CoupledSolution s;
  std::array<bool, kMaxContacts> turns{}, turned{};
  for (bool settled = false; !settled;) {
    s = solve_with(std::span(friction).first(n));
    if (!s.is_unique()) {
      return whirls_too_far() ? Status::kStepTooLarge : status_of(s.solutions);
    }
    settled = true;
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = static_cast<Eigen::Index>(2 * i);
      const double sign = before[i] > 0.0 ? 1.0 : -1.0;
      if (!turns[i] && friction[i].given && s.y[at + 1] * sign <= 0.0 && s.p[at] > 0.0) {
        // Under sliding friction the slip would reach 0. The next solution shows whether friction
        // holds it there.
        turns[i] = true;
        until[i] = before[i] / (before[i] - s.y[at + 1]);  // share of the step
        friction[i].given = false;
        friction[i].bound = c_[i].friction.sticking();
        settled = false;
      } else if (turns[i] && !turned[i] && !s.sticks[i] && s.p[at] > 0.0) {
        turned[i] = true;
        friction[i].given = true;
        friction[i].ratio = friction[i].bound * sign * (1.0 - 2.0 * until[i]);
        settled = false;
      } else if (friction[i].given && !turns[i] && s.p[at] > 0.0 &&
                 of_slip[i].improve(0.5 * (before[i] + s.y[at + 1]))) {
        friction[i].bound = of_slip[i].mu();
        friction[i].ratio = -sign * friction[i].bound;
        settled = false;
      }
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    const bool sticks = !friction[i].given && s.sticks[i];
    c_[i].normal_impulse = s.p[at];
    c_[i].friction_impulse = s.p[at + 1];
    c_[i].slip_sign = sticks               ? 0.0
                      : turned[i]          ? (before[i] > 0.0 ? -1.0 : 1.0)
                      : s.y[at + 1] >= 0.0 ? 1.0
                                           : -1.0;
  }
  return Status::kOk;
}

}  // namespace

Status solve_several_on_circles(double h, std::span<LastingContact> contacts,
                                const ContactAdmittance& admittance) {
  SeveralOnCircles several(h, contacts, admittance);
  return several.go_on_as_before() ? Status::kOk : several.solve();
}

}  // namespace rotorub
