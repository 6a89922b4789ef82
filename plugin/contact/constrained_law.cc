#include "plugin/contact/constrained_law.h"

#include <algorithm>
#include <cmath>

#include "native_model/contact/coulomb.h"

namespace rotorub::plugin {
namespace {

constexpr int kIterations = 40;
constexpr int kUndamped = 8;        // of them; then a circle between two pieces is cut by halving
constexpr double kLocal = 1e-4;     // share of the impulse that a later trial is off by
constexpr double kRelative = 1e-9;  // of the rates that are to be changed
constexpr double kFarOff = 1e-2;    // above this error, relative, new slopes are tried

// The law's answer to a line y = a p + b.
struct Answer {
  Eigen::Vector2d p{0.0, 0.0};
  bool solved = true, sticks = false;
};

Eigen::Vector2d on_line(const Delassus& a, const Eigen::Vector2d& p) {
  return {a.nn * p.x() + a.nt * p.y(), a.tn * p.x() + a.tt * p.y()};
}

// Slopes at p. Of a passive system they are symmetric and positive but for round-off.
Delassus slopes(ContactResponse& response, const Eigen::Vector2d& p, const Eigen::Vector2d& y,
                const Delassus& expected, double size, bool frictionless) {
  const Eigen::Vector2d n = (response.at(p + Eigen::Vector2d(size, 0.0)) - y) / size;
  // What a constraint holds still moves by no less than this.
  const double least_n = 1e-9 * expected.nn, least_t = 1e-9 * expected.tt;
  if (frictionless) return {std::max(n.x(), least_n), n.y(), n.y(), expected.tt};
  const Eigen::Vector2d t = (response.at(p + Eigen::Vector2d(0.0, size)) - y) / size;
  const double cross = 0.5 * (n.y() + t.x());
  return {std::max(n.x(), least_n), cross, cross, std::max(t.y(), least_t)};
}

struct Slopes {
  const Delassus& expected;
  bool frictionless;
  Delassus a{};
  bool known = false;
};

// From p, y(p) on.
template <typename Law>
ConstrainedContact iterate(ContactResponse& response, Eigen::Vector2d p, Eigen::Vector2d y,
                           Slopes& line, Law law) {
  const Delassus& expected = line.expected;
  const auto tried = [&](double size) {
    return slopes(response, p, y, expected, size, line.frictionless);
  };
  ConstrainedContact best;
  best.converged = false;
  double least = 1e300;
  const Answer guess = law(expected, y - on_line(expected, p));
  double size = std::max(std::abs(guess.p.x() - p.x()), kLocal * guess.p.x());
  if (!(size > 0.0)) size = std::max(std::abs(y.x()), 1e-12) / expected.nn;
  const double scale = y.norm() + (on_line(expected, guess.p - p)).norm();
  const double tolerance = kRelative * scale + response.accuracy();
  Delassus& a = line.a;
  if (!line.known) a = tried(size);
  line.known = true;
  for (int k = 0; k < kIterations; ++k) {
    const Answer next = law(a, y - on_line(a, p));
    if (!next.solved) {
      best.solved = least < 1e300;
      return best;
    }
    const Eigen::Vector2d found = response.at(next.p);
    const Eigen::Vector2d error = found - y - on_line(a, next.p - p);
    const double off = error.norm();
    if (off < least) {
      least = off;
      best.p = next.p;
      best.y = found;
      best.error = error;
      best.sticks = next.sticks;
    }
    if (off <= tolerance) {
      best.converged = true;
      return best;
    }
    if (k < kUndamped) {
      p = next.p;
      y = found;
    } else {
      p = 0.5 * (p + next.p);
      y = response.at(p);
    }
    if (off > kFarOff * (found - y).norm() + kFarOff * kFarOff * scale || k >= kUndamped) {
      a = tried(kLocal * std::max(p.x(), size));
    }
  }
  return best;
}

ConstrainedContact closed(ContactResponse& response, const Eigen::Vector2d& free, double offset,
                          double friction, Slopes& line) {
  return iterate(response, {0.0, 0.0}, free, line,
                 [&](const Delassus& a, const Eigen::Vector2d& b) {
                   const CoulombSolution s = solve_coulomb(a, b.x() + offset, b.y(), friction);
                   return Answer{{s.normal, s.friction},
                                 s.solutions == 1,
                                 s.contact_case == ContactCase::kStick};
                 });
}

}  // namespace

ConstrainedContact solve_constrained(ContactResponse& response, const Eigen::Vector2d& free,
                                     const Delassus& expected, double offset, double friction) {
  Slopes line{expected, friction == 0.0};
  return closed(response, free, offset, friction, line);
}

ConstrainedContact solve_constrained_impact(ContactResponse& response, const Eigen::Vector2d& free,
                                            const Delassus& expected, const ImpactLaw& law) {
  Slopes line{expected, law.friction == 0.0};
  const ConstrainedContact c = closed(response, free, 0.0, law.friction, line);
  if (!c.solved) return c;
  const auto expansion = [&](const Delassus& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d start = b + on_line(a, c.p);
    ImpactResult r;
    r.normal_compression = c.p.x();
    r.friction_compression = c.p.y();
    expand({a, start.x(), start.y()}, law, r);
    return Answer{{r.normal(), r.friction()}, r.status == ImpactStatus::kOk, false};
  };
  ConstrainedContact e = iterate(response, c.p, c.y, line, expansion);
  e.converged = e.converged && c.converged;
  return e;
}

}  // namespace rotorub::plugin
