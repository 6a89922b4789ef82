#include "native_model/contact/constrained_law.h"

#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

constexpr int kIterations = 40;
// Iterations with full steps. Half steps then end cycles between two pieces of the map.
constexpr int kUndamped = 8;
constexpr double kLocal = 1e-4;     // size of later trials, relative to the impulse
constexpr double kRelative = 1e-9;  // tolerance, relative to the rates that are to be changed
constexpr double kFarOff = 1e-2;    // relative error above which the slopes are found anew

// The number of rows that each contact has in a vector.
Eigen::Index rows_of(const ContactVector& v, std::span<const ImpactLaw> laws) {
  return v.size() / static_cast<Eigen::Index>(laws.size());
}

class Slopes {
 public:
  Slopes(const ContactMatrix& without, std::span<const ImpactLaw> laws)
      : expected(without), laws_(laws) {}

  // Finds dy/dp at p by trials. The slopes of a passive system are symmetric and positive up to
  // round-off, which is enforced here. A direction that a constraint holds keeps a small positive
  // slope.
  void find(ContactResponse& response, const ContactVector& p, const ContactVector& y,
            double size) {
    const Eigen::Index n = p.size(), rows = rows_of(p, laws_);
    a = expected;
    std::array<bool, 3 * kMaxContacts> tried{};
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool friction = k % rows != 0;
      if (friction && laws_[static_cast<std::size_t>(k / rows)].friction.is_frictionless())
        continue;
      tried[static_cast<std::size_t>(k)] = true;
      ContactVector moved = p;
      moved[k] += size;
      a.col(k) = (response.at(moved) - y) / size;
    }
    const auto known = [&](Eigen::Index k) { return tried[static_cast<std::size_t>(k)]; };
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = 0; i < j; ++i) {
        double& one = a(i, j);
        double& other = a(j, i);
        if (known(i) && known(j)) one = 0.5 * (one + other);
        if (known(i) && !known(j)) one = other;
        other = one;
      }
      a(j, j) = std::max(a(j, j), 1e-9 * expected(j, j));
    }
    known_ = true;
  }
  bool known() const { return known_; }

  const ContactMatrix& expected;
  ContactMatrix a;

 private:
  std::span<const ImpactLaw> laws_;
  bool known_ = false;
};

// The largest difference between the normal impulses of `a` and `b`.
double normal_beyond(const ContactVector& a, const ContactVector& b, Eigen::Index rows) {
  double most = 0.0;
  for (Eigen::Index k = 0; k < a.size(); k += rows) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

// Newton's iteration from p and y(p). law(a, b) solves the laws for the line y = a p + b.
template <typename Law>
ConstrainedContact iterate(ContactResponse& response, ContactVector p, ContactVector y,
                           Eigen::Index rows, Slopes& line, Law law) {
  ConstrainedContact best;
  best.converged = false;
  best.p = ContactVector::Zero(p.size());
  best.y = best.error = best.p;
  double least = 1e300;
  CoupledSolution guess = law(line.expected, y - line.expected * p);
  if (!guess.is_unique()) guess.p = p;
  const ContactVector none = ContactVector::Zero(p.size());
  double size =
      std::max(normal_beyond(guess.p, p, rows), kLocal * normal_beyond(guess.p, none, rows));
  if (!(size > 0.0)) {
    size = std::max(y.cwiseAbs().maxCoeff(), 1e-12) / line.expected.diagonal().maxCoeff();
  }
  const double scale = y.norm() + (line.expected * (guess.p - p)).norm();
  const double tolerance = kRelative * scale + response.accuracy();
  if (!line.known()) line.find(response, p, y, size);
  for (int k = 0; k < kIterations; ++k) {
    const CoupledSolution next = law(line.a, y - line.a * p);
    if (!next.is_unique()) {
      best.solved = least < 1e300;
      return best;
    }
    const ContactVector found = response.at(next.p);
    const ContactVector error = found - y - line.a * (next.p - p);
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
      line.find(response, p, y, kLocal * std::max(normal_beyond(p, none, rows), size));
    }
  }
  return best;
}

// The response of the constraints to impulses alone, added to the rates before them.
class InstantResponse final : public ContactResponse {
 public:
  InstantResponse(ContactResponse& response, const ContactVector& before)
      : response_(response), before_(before) {}
  ContactVector at(const ContactVector& p) override {
    return before_ + response_.instant_change(p);
  }
  double accuracy() const override { return response_.accuracy(); }

 private:
  ContactResponse& response_;
  const ContactVector& before_;
};

ConstrainedContact closed(ContactResponse& response, const ContactVector& free,
                          std::span<const ImpactLaw> laws, Slopes& line) {
  return iterate(response, ContactVector::Zero(free.size()), free, rows_of(free, laws), line,
                 [&](const ContactMatrix& a, const ContactVector& b) {
                   return solve_coupled_coulomb(a, b, laws);
                 });
}

// True if the rest of the step closes a gap by more than round-off.
bool closes_again(const ContactVector& y, const ContactVector& free, double accuracy,
                  Eigen::Index rows) {
  const double tolerance = kRelative * free.norm() + accuracy;
  for (Eigen::Index k = 0; k < y.size(); k += rows) {
    if (y[k] < -tolerance) return true;
  }
  return false;
}

// The impact, followed by the contact that lasts over the rest of the step.
ConstrainedContact closed_again(ContactResponse& response, const ConstrainedContact& impact,
                                const ContactMatrix& expected, std::span<const ImpactLaw> laws) {
  const auto beyond = [&](const ContactMatrix& a, const ContactVector& b) {
    CoupledSolution s = solve_coupled_coulomb(a, b + a * impact.p, laws);
    if (s.is_unique()) s.p += impact.p;
    return s;
  };
  Slopes line(expected, laws);
  const Eigen::Index rows = rows_of(impact.p, laws);
  ConstrainedContact c = iterate(response, impact.p, impact.y, rows, line, beyond);
  c.converged = c.converged && impact.converged;
  c.after = impact.after;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const Eigen::Index normal = rows * static_cast<Eigen::Index>(k);
    c.lasts[k] = c.p[normal] > impact.p[normal];
  }
  return c;
}

}  // namespace

ConstrainedContact solve_constrained(ContactResponse& response, const ContactVector& free,
                                     const ContactMatrix& expected,
                                     std::span<const ImpactLaw> laws) {
  Slopes line(expected, laws);
  return closed(response, free, laws, line);
}

ConstrainedContact solve_constrained_impact(ContactResponse& response, const ContactVector& free,
                                            const ContactMatrix& expected,
                                            std::span<const ImpactLaw> laws) {
  Slopes line(expected, laws);
  InstantResponse instant(response, free);
  const ConstrainedContact c = closed(instant, free, laws, line);
  if (!c.solved) return c;
  const auto expansion = [&](const ContactMatrix& a, const ContactVector& b) {
    CoupledSolution s = solve_coupled_expansion(a, b + a * c.p, laws, c.p);
    if (s.is_unique()) s.p += c.p;
    s.sticks = {};  // an impact does not report sticking
    return s;
  };
  const Eigen::Index rows = rows_of(free, laws);
  ConstrainedContact e = iterate(instant, c.p, c.y, rows, line, expansion);
  e.converged = e.converged && c.converged;
  if (!e.solved) return e;
  e.after = e.y;
  e.y = response.at(e.p);
  if (!closes_again(e.y, free, response.accuracy(), rows)) return e;
  return closed_again(response, e, expected, laws);
}

}  // namespace rotorub
