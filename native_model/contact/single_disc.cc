#include "native_model/contact/single_disc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/LU>

namespace rotorub {
namespace {

// Relative to the terms of which a rate or an impulse is the sum.
constexpr double kDiscRoundOff = 1e-11;
constexpr double kDiscTrace = 1e-12;  // relative to the normal mobility; less counts as immobile
constexpr double kOneMotion = 1e-8;  // relative to the terms; solutions that differ by less are one

Eigen::Vector2d turned(const Eigen::Vector2d& v) { return {-v.y(), v.x()}; }

struct Roots {
  std::array<double, 4> at{};
  std::size_t count = 0;
};

// c[0] + c[1] t + ... + c[degree] t^degree
double value(const double* c, int degree, double t) {
  double sum = c[degree];
  for (int k = degree; k-- > 0;) sum = sum * t + c[k];
  return sum;
}

// The root between low and high, where the signs differ, by Newton's method with bisection where a
// step leaves the bracket.
double bracketed(const double* c, const double* slope, int degree, double low, double high) {
  const bool rises = value(c, degree, low) < 0.0;
  double t = 0.5 * (low + high);
  for (int k = 0; k < 200; ++k) {
    const double f = value(c, degree, t);
    if (f == 0.0) return t;
    ((f < 0.0) == rises ? low : high) = t;
    double next = t - f / value(slope, degree - 1, t);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t || next == low || next == high) return next;
    t = next;
  }
  return t;
}

// The real roots in [-1, 1). The polynomial is monotone between the roots of its derivative.
Roots roots(const double* c, int degree) {
  Roots all;
  if (degree == 0) return all;
  double slope[4] = {};
  for (int k = 0; k < degree; ++k) slope[k] = (k + 1) * c[k + 1];
  const Roots turns = roots(slope, degree - 1);
  double low = -1.0, f_low = value(c, degree, low);
  for (std::size_t i = 0; i <= turns.count; ++i) {
    const double high = i < turns.count ? turns.at[i] : 1.0;
    const double f_high = value(c, degree, high);
    const bool zero = f_low == 0.0,
               crosses = (f_low < 0.0 && f_high > 0.0) || (f_low > 0.0 && f_high < 0.0);
    if ((zero || crosses) && all.count < all.at.size()) {
      all.at[all.count++] = zero ? low : bracketed(c, slope, degree, low, high);
    }
    low = high;
    f_low = f_high;
  }
  return all;
}

// Calls action(d) for each unit vector d with d x (v + K d) = 0. The unknown is t = tan(angle / 2),
// first for the half circle about v, then for the one about -v.
// It ends when action(d) returns false.
template <typename Action>
void for_each_parallel(const Eigen::Vector2d& v, const Eigen::Matrix2d& k, Action action) {
  const double size = v.norm();
  const Eigen::Vector2d along = size > 0.0 ? Eigen::Vector2d(v / size) : Eigen::Vector2d(1.0, 0.0);
  const Eigen::Vector2d across = turned(along);
  const double k12 = along.dot(k * across), k21 = across.dot(k * along);
  const double more = across.dot(k * across) - along.dot(k * along);
  for (const double sense : {1.0, -1.0}) {
    const double v1 = sense * size;
    const double c[5] = {k21, 2.0 * (more - v1), -2.0 * k21 - 4.0 * k12, -2.0 * (more + v1), k21};
    const Roots found = roots(c, 4);
    for (std::size_t i = 0; i < found.count; ++i) {
      const double t = found.at[i], r = 1.0 + t * t;
      const Eigen::Vector2d d = sense / r * ((1.0 - t * t) * along + 2.0 * t * across);
      if (!action(d)) return;
    }
  }
}

class DiscProblem {
 public:
  DiscProblem(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, const DiscSet& set,
              Solutions wanted)
      : a_(a), b_(b), set_(set), wanted_(wanted) {
    for (int k = 1; k < 3; ++k) {
      if (a_(k, k) <= kDiscTrace * a_(0, 0)) a_(k, k) += kDiscTrace * a_(0, 0);
    }
  }

  SingleDisc solve() {
    const Eigen::Vector2d a_tn = a_.block<2, 1>(1, 0), b_t = b_.tail<2>();
    const Eigen::Matrix2d a_tt = a_.block<2, 2>(1, 1);
    const double n = set_.least_normal;
    if (n == 0.0) {
      if (b_.x() >= 0.0) take({true, DiscFriction::kRim, {1.0, 0.0}}, Eigen::Vector3d::Zero());
    } else {
      try_line({true, n, {0.0, 0.0}, b_t + a_tn * n, a_tt});
    }
    if (!found() && a_(0, 0) > kDiscTrace * a_tt.trace()) {
      const Eigen::Vector2d beta = -a_tn / a_(0, 0);
      const double alpha = -b_.x() / a_(0, 0);
      try_line({false, alpha, beta, b_t + a_tn * alpha, a_tt + a_tn * beta.transpose()});
    }
    return best_;
  }

 private:
  struct Line {
    bool at_bound;
    double alpha;
    Eigen::Vector2d beta, c;
    Eigen::Matrix2d s;
  };

  // True if nothing more is to be tried.
  bool found() const { return wanted_ == Solutions::kFirst && best_.solutions > 0; }

  void try_line(const Line& line) {
    const double mu = set_.friction;
    const auto put = [&](DiscFriction friction, const Eigen::Vector2d& l_t,
                         const Eigen::Vector2d& d) {
      const double normal = line.alpha + line.beta.dot(l_t);
      take({line.at_bound, friction, d}, {normal, l_t.x(), l_t.y()});
    };
    put(DiscFriction::kStick, -stuck(line.s, line.c), {1.0, 0.0});
    if (found()) return;
    const Eigen::Matrix2d k = mu * (line.c * line.beta.transpose() - line.alpha * line.s);
    for_each_parallel(line.c, k, [&](const Eigen::Vector2d& d) {
      const double normal = line.alpha / (1.0 + mu * line.beta.dot(d));
      const Eigen::Vector3d p(normal, -mu * normal * d.x(), -mu * normal * d.y());
      take({line.at_bound, DiscFriction::kRim, d}, polished(p, line.at_bound));
      return !found();
    });
    if (found() || set_.side.isZero(0.0)) return;
    const Eigen::Vector2d begun = set_.floor * set_.side, along = turned(set_.side);
    const double chord = -along.dot(line.c + line.s * begun) / along.dot(line.s * along);
    put(DiscFriction::kChord, begun + chord * along, {1.0, 0.0});
    // L_T on the chord and |L_T| = mu L_N: floor^2 + z^2 = mu^2 (e + f z)^2
    const double e = line.alpha + line.beta.dot(begun), f = line.beta.dot(along);
    const double x2 = 1.0 - mu * mu * f * f, x1 = -mu * mu * e * f;
    const double x0 = set_.floor * set_.floor - mu * mu * e * e;
    const double root = std::sqrt(std::max(0.0, x1 * x1 - x2 * x0));
    for (const double sense : {1.0, -1.0}) {
      put(DiscFriction::kCorner, begun + (-x1 + sense * root) / x2 * along, {1.0, 0.0});
    }
  }

  // One Newton step for y_N = 0 (or the given L_N), L_T x y_T = 0, |L_T| = mu L_N. The angle alone
  // is not accurate enough if 1 + mu beta . d is small or if one direction is far stiffer than the
  // other.
  Eigen::Vector3d polished(const Eigen::Vector3d& p, bool at_bound) const {
    const Eigen::Vector3d y = a_ * p + b_;
    const double mu2 = set_.friction * set_.friction;
    const Eigen::Vector3d left(at_bound ? 0.0 : y.x(), p.y() * y.z() - p.z() * y.y(),
                               p.tail<2>().squaredNorm() - mu2 * p.x() * p.x());
    Eigen::Matrix3d slope;
    slope.row(0) = at_bound ? Eigen::RowVector3d(1.0, 0.0, 0.0) : Eigen::RowVector3d(a_.row(0));
    slope.row(1) = p.y() * a_.row(2) - p.z() * a_.row(1) + Eigen::RowVector3d(0.0, y.z(), -y.y());
    slope.row(2) << -2.0 * mu2 * p.x(), 2.0 * p.y(), 2.0 * p.z();
    Eigen::Vector3d better = p - slope.inverse() * left;
    if (at_bound) better.x() = p.x();
    return better.allFinite() ? better : p;
  }

  // S^-1 c; the least-norm solution if the two directions are one motion.
  static Eigen::Vector2d stuck(const Eigen::Matrix2d& s, const Eigen::Vector2d& c) {
    const double det = s(0, 0) * s(1, 1) - s(0, 1) * s(1, 0);
    if (det > kDiscTrace * s(0, 0) * s(1, 1)) {
      return Eigen::Vector2d(s(1, 1) * c.x() - s(0, 1) * c.y(), s(0, 0) * c.y() - s(1, 0) * c.x()) /
             det;
    }
    return s * c / (s.trace() * s.trace());
  }

  // Counts the candidates that satisfy the laws and keeps the first.
  void take(const DiscCase& c, Eigen::Vector3d p) {
    if (!p.allFinite()) return;
    Eigen::Vector3d y = a_ * p + b_;
    const Eigen::Vector3d terms = b_.cwiseAbs() + a_.cwiseAbs() * p.cwiseAbs();
    const double gap = kDiscRoundOff * terms.x(),
                 rates = kDiscRoundOff * terms.tail<2>().maxCoeff();
    const double impulses = kDiscRoundOff * set_.friction * std::max(p.x(), set_.least_normal);
    if (c.at_bound ? y.x() < -gap : p.x() < set_.least_normal || std::abs(y.x()) > gap) return;
    const Eigen::Vector2d l_t = p.tail<2>(), y_t = y.tail<2>();
    if (l_t.norm() > set_.friction * p.x() + impulses) return;
    if (l_t.dot(set_.side) < set_.floor - impulses) return;
    if (!opposes(c, l_t, y_t, rates)) return;
    y.x() = c.at_bound ? std::max(0.0, y.x()) : 0.0;  // removes round-off
    if (c.friction == DiscFriction::kStick) y.tail<2>().setZero();
    if (best_.solutions > 0) {
      const Eigen::Vector3d apart = (y - best_.y).cwiseAbs();
      const double same = kOneMotion * terms.tail<2>().maxCoeff();
      if (apart.x() > kOneMotion * terms.x() || apart.tail<2>().maxCoeff() > same)
        ++best_.solutions;
      return;
    }
    best_ = {1, c, p, y};
  }

  // True if -y_T lies in the normal cone of the set at L_T.
  bool opposes(const DiscCase& c, const Eigen::Vector2d& l_t, const Eigen::Vector2d& y_t,
               double rates) const {
    switch (c.friction) {
      case DiscFriction::kStick:
        return y_t.norm() <= rates;
      case DiscFriction::kRim:
        return set_.friction * set_.least_normal == 0.0 && l_t.isZero(0.0)
                   ? true
                   : y_t.dot(c.direction) >= -rates &&
                         std::abs(y_t.dot(turned(c.direction))) <= rates;
      case DiscFriction::kChord:
        return std::abs(y_t.dot(turned(set_.side))) <= rates && y_t.dot(set_.side) >= -rates;
      case DiscFriction::kCorner: {
        // y_T = -a L_T + b side, a and b >= 0.
        const Eigen::Vector2d along = turned(set_.side);
        const double z = l_t.dot(along);
        if (std::abs(z) <= kDiscRoundOff * l_t.norm()) return false;
        const double outward = -y_t.dot(along) / z;
        return outward * l_t.norm() >= -rates &&
               y_t.dot(set_.side) + outward * l_t.dot(set_.side) >= -rates;
      }
    }
    return false;
  }

  Eigen::Matrix3d a_;
  Eigen::Vector3d b_;
  const DiscSet& set_;
  Solutions wanted_;
  SingleDisc best_;
};

}  // namespace

SingleDisc solve_disc(const Eigen::Matrix3d& a, const Eigen::Vector3d& b, const DiscSet& set,
                      Solutions wanted) {
  return DiscProblem(a, b, set, wanted).solve();
}

}  // namespace rotorub
