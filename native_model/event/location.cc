#include "native_model/event/location.h"

#include <algorithm>
#include <array>
#include <limits>

#include <boost/math/tools/roots.hpp>

#include "native_model/model/dynamics.h"
#include "native_model/numerics/root.h"
#include "native_model/trajectory/range_check.h"

namespace rotorub {
namespace {

// The displacement over a step, Delta d(theta) = sum c_i theta^i, i from 1 (c_0 = 0).
constexpr int kPathDegree = 7;
using Path = std::array<Eigen::Vector2d, kPathDegree + 1>;

// Expands the nested form theta (F_0 + (1 - theta)(F_1 + theta (F_2 + ...))), see Dop853.
Path path_from_nested(const std::array<Eigen::Vector2d, kPathDegree>& f) {
  // From the inside out: p <- (p + F_d) theta for even d, (p + F_d)(1 - theta) for odd d.
  Path p;
  p.fill(Eigen::Vector2d::Zero());
  for (int d = kPathDegree - 1; d >= 0; --d) {
    p[0] += f[static_cast<std::size_t>(d)];
    for (std::size_t i = kPathDegree; i >= 1; --i) {
      p[i] = d % 2 == 0 ? p[i - 1] : Eigen::Vector2d(p[i] - p[i - 1]);
    }
    if (d % 2 == 0) p[0].setZero();
  }
  return p;
}

// With the dense output d(theta) is a polynomial, and so is F(theta) = |d + Delta d|^2 - delta_0^2,
// whose value at the start is computed without cancellation. d: centre at the start.
Polynomial outside(const Path& path, const Eigen::Vector2d& d, double clearance) {
  Polynomial f{2 * kPathDegree, {}};
  f.a[0] = (d.norm() - clearance) * (d.norm() + clearance);
  for (std::size_t i = 1; i <= kPathDegree; ++i) {
    f.a[i] += 2.0 * d.dot(path[i]);
    for (std::size_t j = 1; j <= kPathDegree; ++j) f.a[i + j] += path[i].dot(path[j]);
  }
  return f;
}

// The first theta in (0, 1] with F >= 0, to round-off. Known roots at the start are divided out.
std::optional<double> first_contact(Polynomial f, Departure departure) {
  const int known = static_cast<int>(departure);
  std::copy(f.a.begin() + known, f.a.end(), f.a.begin());
  f.degree -= known;
  return first_crossing(
      f, departure == Departure::kInside ? RootStart::kBelowZero : RootStart::kAnywhere);
}

// The relative centre; also for velocities, and for the change of the coordinates in a step.
Eigen::Vector2d centre(const Model& m, std::size_t contact, const double* at) {
  return rotor_point(m, at, contact) - stator_point(m, at, contact);
}

Path path_of(const Model& m, std::size_t contact, SmoothStep& step) {
  std::array<Eigen::Vector2d, kPathDegree> nested;
  for (int k = 0; k < kPathDegree; ++k)
    nested[static_cast<std::size_t>(k)] = centre(m, contact, step.term(k));
  return path_from_nested(nested);
}

}  // namespace

std::optional<double> locate_contact(const Model& m, std::size_t contact, SmoothStep& step,
                                     const Motion& start, Departure departure) {
  const double clearance = m.auxiliary[contact].contact->clearance;
  const Eigen::Vector2d d0 = separation(m, start.q(), contact),
                        d1 = separation(m, step.end(), contact);
  // Out of reach: at twice the larger speed the centre gets no further than from one end of the
  // step outwards and back to the other end.
  const double speed = std::max(centre(m, contact, start.v()).norm(),
                                centre(m, contact, step.end() + m.nq()).norm());
  const double reach = 0.5 * (d0.norm() + d1.norm()) + speed * step.length();
  if (reach < clearance) return {};

  return first_contact(outside(path_of(m, contact, step), d0, clearance), departure);
}

std::optional<RedundantEnd> locate_redundant_end(const Model& m, std::size_t contact,
                                                 SmoothStep& step, const Motion& start,
                                                 double redundant_gap) {
  const double clearance = m.auxiliary[contact].contact->clearance;
  const Eigen::Vector2d d = separation(m, start.q(), contact);
  const Polynomial f = outside(path_of(m, contact, step), d, clearance);
  const double round_off = 2.0 * kRedundantGap * clearance * clearance;
  Polynomial closed = f, open = f;
  closed.a[0] -= round_off - redundant_gap * (2.0 * clearance - redundant_gap);
  for (double& a : open.a) a = -a;
  open.a[0] -= round_off;
  const auto closes = first_crossing(closed, RootStart::kBelowZero);
  if (!closes) return {};
  const auto opens = first_crossing(open, RootStart::kBelowZero);
  return RedundantEnd{*closes, opens && *opens < *closes};
}

std::optional<double> locate_margin(std::size_t contact, SmoothStep& step, ContactMode mode,
                                    const MarginScales& scales, const EventParameters& parameters) {
  // The stages of the step tell whether a margin was crossed, and the dense output tells when. A
  // value below 0 by round-off is not a crossing, because a phase may begin on its margin.
  const Margins& lowest = step.lowest(contact);
  const double none = -parameters.margin_round_off;
  if (lowest.force > -parameters.no_force * scales.force &&
      lowest.tangential > none * scales.tangential(mode)) {
    return {};
  }
  const auto margin = [&](double theta) {
    const Margins& m = step.margins(contact, theta);
    return std::min(m.force / scales.force, m.tangential / scales.tangential(mode));
  };
  constexpr int kSamples = 16;
  constexpr double kInstant = 1e-12;  // relative to the step
  double lo = 0.0, f_lo = margin(0.0);
  for (int k = 1; k <= kSamples; ++k) {
    const double hi = static_cast<double>(k) / kSamples, f_hi = margin(hi);
    if (f_hi >= none) {
      lo = hi;
      f_lo = f_hi;
      continue;
    }
    constexpr double kNow = std::numeric_limits<double>::min();
    if (f_lo > 0.0) return std::max(root(margin, lo, hi, f_lo, f_hi).first, kNow);
    // The step began on a margin, which need not be the one that is crossed.
    const auto force = [&](double theta) { return step.margins(contact, theta).force; };
    const auto tangential = [&](double theta) { return step.margins(contact, theta).tangential; };
    const auto crossing = [&](const auto& one, double scale) {
      const double one_lo = one(lo), one_hi = one(hi);
      if (one_hi >= none * scale) return kInfinity;
      if (one_lo > 0.0) return root(one, lo, hi, one_lo, one_hi).first;
      // The margin may rise from there before it falls, if only for an instant.
      double later = hi, f_later = one_hi;
      for (double theta = 0.5 * (lo + hi); theta - lo > kInstant; theta = 0.5 * (lo + theta)) {
        const double f = one(theta);
        if (f > 0.0) return root(one, theta, later, f, f_later).first;
        later = theta;
        f_later = f;
      }
      return lo;
    };
    const double first =
        std::min(crossing(force, scales.force), crossing(tangential, scales.tangential(mode)));
    return std::max(std::isfinite(first) ? first : lo, kNow);
  }
  return {};
}

double locate_largest_force(std::size_t contact, SmoothStep& step, double last, double known) {
  constexpr double kBetweenStages = 1.1;  // possible rise between the stages
  if (kBetweenStages * step.largest_normal(contact) <= known) return known;
  const auto falls = [&](double theta) { return -step.normal_force(contact, theta); };
  constexpr int kBits = std::numeric_limits<double>::digits / 2;
  std::uintmax_t evaluations = 60;
  const double inside =
      -boost::math::tools::brent_find_minima(falls, 0.0, last, kBits, evaluations).second;
  return std::max({known, inside, -falls(0.0), -falls(last)});
}

double locate_least_gap(const Model& m, std::size_t contact, SmoothStep& step, double last) {
  const auto at = [&](double theta) {
    const double* y = step.at(theta);
    return contact_point(m, y, y + m.nq(), contact);
  };
  const auto rate = [&](double theta) { return at(theta).gap_rate; };
  const double first_rate = rate(0.0), last_rate = rate(last);
  const double gap = std::min(at(0.0).gap, at(last).gap);
  if (!(first_rate < 0.0 && last_rate > 0.0)) return gap;
  return std::min(gap, at(root(rate, 0.0, last, first_rate, last_rate).first).gap);
}

std::optional<double> locate_loss(const Model& m, SmoothStep& step, double last) {
  const auto inside = [&](double theta) {
    const double* y = step.at(theta);
    return out_of_range(m, y, y + m.nq()) ? -1.0 : 1.0;
  };
  if (inside(last) > 0.0) return {};
  if (inside(0.0) < 0.0) return 0.0;  // an impact made the rotor too fast
  const auto close = [](double a, double b) { return b - a < 1e-12; };
  std::uintmax_t evaluations = 60;
  return boost::math::tools::bisect(inside, 0.0, last, close, evaluations).second;
}

}  // namespace rotorub
